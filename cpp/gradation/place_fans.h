// SPDX-License-Identifier: BSD-3-Clause
// Places of a gradation's graph that belong to one vertex, and vectors carried between them. Private to the gradations.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "gradation/gradation.h"

namespace carreau::detail {

/// Rolls v, tangent where the normal is n, to a place with normal m: the rotation about n x m, which at a crease is the
/// curve's tangent. n . m > -1.
Vec3 roll(const Vec3& v, const Vec3& n, const Vec3& m) noexcept;

/// Keeps a reference to the graph.
class PlaceFans {
 public:
  explicit PlaceFans(const GradationGraph& graph);

  [[nodiscard]] int first(int vertex) const noexcept { return first_[vertex]; }  ///< -1: none
  [[nodiscard]] int next(int place) const noexcept { return next_[place]; }      ///< -1: none
  /// Carries a tangent vector from one place of a vertex to another. Returns false when the surface cannot be unfolded
  /// there: three places or more that are not one smooth surface.
  bool carry(int from, int to, Vec3& v) const noexcept;
  /// The other two places of each triangle at a place, in the triangle's order.
  [[nodiscard]] std::span<const std::pair<int, int>> triangles(int place) const noexcept {
    return std::span(others_).subspan(static_cast<std::size_t>(start_[place]),
                                      static_cast<std::size_t>(start_[place + 1] - start_[place]));
  }

 private:
  const GradationGraph& graph_;
  std::vector<int> first_, next_;
  std::vector<Vec3> inward_;  // by place: towards the middle of its triangles
  std::vector<int> start_;    // by place, in others_
  std::vector<std::pair<int, int>> others_;
};

}  // namespace carreau::detail
