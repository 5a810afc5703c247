// SPDX-License-Identifier: BSD-3-Clause
// The plane of a cluster.
#pragma once

#include "atlas/covering/triangulation.h"

namespace carreau::atlas {

/// Orthonormal, right-handed.
struct Frame {
  Vec3 origin{0, 0, 0}, u{1, 0, 0}, v{0, 1, 0}, normal{0, 0, 1};
  /// The smallest cosine between the normal and the normal of a triangle of the region; below 0 the region folds in
  /// projection.
  double min_cosine = 0;
  std::int32_t steepest = 0;  ///< a vertex of that triangle

  [[nodiscard]] Vec2 project(const Vec3& p) const { return {dot(u, p - origin), dot(v, p - origin)}; }
  [[nodiscard]] double height(const Vec3& p) const { return dot(normal, p - origin); }
};

/// The frame of all triangles that touch the members: the normal of their area, corrected until the steepest triangle
/// cannot become much less steep.
Frame frame_of(const Triangulation& surface, const Fans& fans, const std::vector<std::int32_t>& members);

/// Area vector of the triangle.
Vec3 area_vector(const Triangulation& surface, std::int32_t a, std::int32_t b, std::int32_t c);

}  // namespace carreau::atlas
