// SPDX-License-Identifier: BSD-3-Clause
// Places where the shapes of triangles in space need improvement, after the lift.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/plane_mesh.h"
#include "mesh/quality.h"
#include "support/monitor.h"
#include "support/ranks/executor.h"

namespace carreau {

/// Q2 in space; 1 for triangles with two corners at one place. An apex of space is a side of the parameter plane, and
/// the flat triangles there will be removed.
inline double quality_in_space(const std::array<std::int32_t, 3>& triangle, const std::vector<Vec3>& xyz) noexcept {
  const Vec3 &a = xyz[triangle[0]], &b = xyz[triangle[1]], &c = xyz[triangle[2]];
  const double quality = quality_q2(a, b, c);
  if (quality > 0) return quality;
  return a == b || b == c || c == a ? 1 : quality;
}

/// The normal of unit length; zero for triangles without area.
Vec3 unit_normal_in_space(const std::array<std::int32_t, 3>& triangle, const std::vector<Vec3>& xyz) noexcept;

/// Returns whether the triangle's shape in space is below the bound.
bool is_below(double bound, const std::array<std::int32_t, 3>& triangle, const std::vector<Vec3>& xyz);
/// Returns the triangles of a patch below the bound, increasing.
std::vector<std::int32_t> triangles_below(const PlaneMesh& mesh, const std::vector<Vec3>& xyz, double bound,
                                          const Executor& executor, Monitor& monitor);

/// The triangles of a patch near its bad triangles. Only these triangles may change when shapes improve.
class BadRegion {
 public:
  /// Selects two rings of triangles around the `bad` triangles. Keeps references to the mesh and its positions, whose
  /// numbers of vertices and triangles stay.
  BadRegion(const PlaneDomain& domain, const PlaneMesh& mesh, const std::vector<Vec3>& xyz,
            std::vector<std::int32_t> bad, int threads, Monitor& monitor);

  /// Indices, increasing.
  [[nodiscard]] const std::vector<std::int32_t>& triangles() const noexcept { return triangles_; }
  /// Triangles above their goals, by triangle of the mesh, are not bad, whatever the bound.
  void aim_at(std::vector<float> goals) { goals_ = std::move(goals); }
  /// Returns the triangles below `bound` now, increasing.
  [[nodiscard]] std::vector<std::int32_t> below(double bound) const;
  /// Returns whether the vertex is not imposed and all triangles around are in the region.
  [[nodiscard]] bool may_move(std::int32_t vertex) const { return movable_[vertex] != 0; }

 private:
  using Triangle = std::array<std::int32_t, 3>;

  void mark_corners(const std::vector<std::int32_t>& triangles, std::vector<char>& marked) const;

  const PlaneMesh& mesh_;
  const std::vector<Vec3>& xyz_;
  std::vector<std::int32_t> triangles_;
  std::vector<char> movable_;  // by vertex
  std::vector<float> goals_;   // by triangle; empty: none
};

}  // namespace carreau
