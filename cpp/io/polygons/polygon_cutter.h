// SPDX-License-Identifier: BSD-3-Clause
// Polygons of files become triangles.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesh/flat_mesh.h"

namespace carreau {

/// Appends triangles to a mesh whose vertices are known.
class PolygonCutter {
 public:
  explicit PolygonCutter(FlatMesh& mesh) : mesh_(mesh) {}

  /// A polygon in space, perhaps not convex and not quite plane. Cuts off ears, the best shaped first when there are
  /// few corners, in the plane of the normal of its area. A polygon that crosses itself gives triangles that do.
  /// Returns the defect of the polygon, "" if it is sound: fewer than three corners, too many corners, an invalid
  /// vertex.
  std::string add(std::span<const std::int32_t> corners, std::int32_t ref);

 private:
  void cut(std::span<const std::int32_t> corners, std::int32_t ref);

  FlatMesh& mesh_;
  std::vector<std::int32_t> left_;  ///< indices in `plane_` of corners that are left
  std::vector<Vec2> plane_;
};

}  // namespace carreau
