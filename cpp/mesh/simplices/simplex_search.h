// SPDX-License-Identifier: BSD-3-Clause
// The nearest point of a mesh of tetrahedra, triangles and edges together, in logarithmic time.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/simplices/simplices.h"
#include "support/box_tree.h"
#include "support/vec.h"

namespace carreau {

/// A place of a mesh of simplices.
struct NearestOnSimplices {
  std::int32_t simplex = -1;
  std::array<double, 4> weight{1, 0, 0, 0};  ///< barycentric, by corner: none negative, sum 1
  Vec3 point{0, 0, 0};
  double distance = infinity;  ///< 0 inside a tetrahedron
};

/// The nearest point of one simplex of these corners; if the simplex is flat, the nearest point of its faces, sides or
/// corners. `simplex` of the result is -1.
NearestOnSimplices nearest_on_simplex(const Vec3& p, std::span<const Vec3> corners) noexcept;

/// Simplices of space in a BoxTree; plane simplices have z = 0. Copies its arguments. nearest() is safe from several
/// threads.
class SimplexSearch {
 public:
  SimplexSearch() = default;
  /// Indices lie in range, coordinates are finite.
  SimplexSearch(std::span<const Vec3> vertices, std::span<const Simplex> simplices);

  /// The nearest point; of equally near simplices, the lowest index is returned. `guess`, any simplex (one found
  /// nearby), saves time and changes nothing. Requires a tree that is not empty.
  [[nodiscard]] NearestOnSimplices nearest(const Vec3& p, std::int32_t guess = 0) const noexcept;
  /// Longest edge of a simplex.
  [[nodiscard]] double longest_edge(std::int32_t simplex) const noexcept;

 private:
  struct Corners {
    std::array<Vec3, 4> at;
    std::size_t count = 0;
    [[nodiscard]] std::span<const Vec3> all() const noexcept { return std::span(at).first(count); }
  };
  void look_at(std::int32_t simplex, const Vec3& p, NearestOnSimplices& best) const noexcept;

  std::vector<Corners> corners_;
  BoxTree tree_;
};

}  // namespace carreau
