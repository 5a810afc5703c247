// SPDX-License-Identifier: BSD-3-Clause
// Curvature by direction of surfaces given as triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/discrete/surface.h"
#include "metric/metric3.h"

namespace carreau {

/// Curvature tensor in an orthonormal basis of a tangent plane: signed, one sign on the side of the normal. Values are
/// 1 / model length.
using PlaneCurvature = Metric2;

/// The derivative of the normals of regions. A triangle has the tensor that fits the normals at its corners best. A corner has the mean of
/// the tensors of its region, weighted by angles (S. Rusinkiewicz, Estimating curvatures and their derivatives on triangle meshes, 3DPVT
/// 2004, sec. 3). No tensor is larger than the normals turn along an edge of its triangle.
class CurvatureTensors {
 public:
  explicit CurvatureTensors(const discrete::DiscreteSurface& surface);

  /// The tensor on the patch of a triangle at (u, v), in the plane of the orthonormal vectors p and q.
  [[nodiscard]] PlaneCurvature at(std::int32_t triangle, const Vec2& uv, const Vec3& p, const Vec3& q) const;

 private:
  std::vector<Metric3> tensor_;  // by corner 3 t + k
};

}  // namespace carreau
