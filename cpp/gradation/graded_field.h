// SPDX-License-Identifier: BSD-3-Clause
// A graded size field over a composite surface, evaluated anywhere.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gradation/edge_sizes.h"
#include "gradation/gradation.h"
#include "gradation/metric_grading.h"
#include "gradation/triangle_tree.h"
#include "support/infinity.h"
#include "support/monitor.h"
#include "support/vec.h"

namespace carreau {

/// Input of the grading on one face: triangles of its parameter domain, and the fronts at their corners.
struct GradedFace {
  std::vector<Vec2> uv;
  std::vector<Vec3> xyz, normal;  ///< normal: unit, either side
  std::vector<double> h;          ///< graded size
  std::vector<GradationFront> front;
  std::vector<TangentMetric> metric;  ///< graded, where sizes differ by direction: then h and front are empty
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< counterclockwise in (u, v)
  /// For each triangle: bit i is set when the side from corner i to the next one lies on a curve. Sizes between the
  /// corners of such a side are interpolated.
  std::vector<std::uint8_t> on_curve;
  /// For each triangle: true if the prescribed sizes inside agree with its corners, and count. Otherwise the corners
  /// alone count, because sizes that jump between samples obey no gradation.
  std::vector<std::uint8_t> smooth;
  std::vector<Vec2>
      size_minima;  ///< vertices whose size is smaller than all around allow: points that control spaces miss
  TriangleTree tree;
  /// For each triangle: the third corners of its neighbours across its sides, in their order; -1: no neighbour. Filled
  /// by GradedField.
  std::vector<std::array<std::int32_t, 3>> beyond;
};

/// Step from `origin`, where the unit normal is given, to a point nearby: in the tangent plane and as long as the arc.
Vec3 step_on_surface(const Vec3& normal, const Vec3& chord) noexcept;

/// Sizes h(x) = min over sources y of h(y) + slope |x - y| (HDR sec. 1.1.2; Borouchaki, Hecht, Frey). The sources are
/// the fronts at the corners of the triangle around x, and the parts of curves between corners. Safe from several
/// threads.
class GradedField {
 public:
  /// `faces` by index in Model::faces; a face without triangles bounds nothing.
  GradedField(double slope, std::vector<GradedFace> faces);

  [[nodiscard]] double slope() const noexcept { return slope_; }
  [[nodiscard]] const std::vector<Vec2>& size_minima(int face) const {
    return faces_.at(static_cast<std::size_t>(face)).size_minima;
  }
  /// The size at (u, v) in a face, whose image is `xyz` and where the size is `prescribed` (+infinity: any size).
  /// Logarithmic in the number of triangles. Outside the triangles, the nearest one.
  [[nodiscard]] double size(int face, const Vec2& uv, const Vec3& xyz, double prescribed) const noexcept;

  /// Sizes by direction: `prescribed`, bounded, with its directions.
  [[nodiscard]] TangentMetric sizes(int face, const Vec2& uv, const Vec3& xyz, TangentMetric prescribed) const noexcept;
  /// The smaller of both, interpolated: for places without a tangent plane. +infinity without a bound.
  [[nodiscard]] double smaller_size(int face, const Vec2& uv) const noexcept;

 private:
  double slope_;
  std::vector<GradedFace> faces_;
};

/// Changes of a prescribed size before meshing: bounded by a graded field and by the edges around, multiplied, bounded
/// by a constant.
struct SizeLimits {
  const GradedField* field = nullptr;  ///< null: no bound
  double factor = 1;
  double largest = infinity;
  const EdgeSizes* edges = nullptr;  ///< of one face; null: no bound
  /// Sizes by direction alone: largest tangent of the angle between triangles and the surface (bound_lean).
  double lean = infinity;

  [[nodiscard]] bool idle() const noexcept {
    return field == nullptr && edges == nullptr && factor == 1 && largest == infinity && lean == infinity;
  }
  [[nodiscard]] bool want_places() const noexcept { return field != nullptr || edges != nullptr; }
  /// The isotropic size at (u, v) in a face, whose image is xyz, where h is prescribed: bounded by field and edges.
  [[nodiscard]] double bounded(int face, const Vec2& uv, const Vec3& xyz, double h) const noexcept {
    if (field != nullptr) h = field->size(face, uv, xyz, h);
    return edges != nullptr ? edges->at(xyz, h) : h;
  }
};

}  // namespace carreau
