// SPDX-License-Identifier: BSD-3-Clause
// The nearest point of a triangle mesh, in logarithmic time.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "support/box_tree.h"
#include "support/monitor.h"
#include "support/vec.h"

namespace carreau {

/// A point of a mesh.
struct NearestOnMesh {
  std::int32_t triangle = -1;
  std::array<double, 3> weight{1, 0, 0};  ///< barycentric: none negative, sum 1
  Vec3 point;
  double distance = infinity;
};

/// The nearest point of one triangle, which may be flat: then of its sides. `triangle` of the result is -1.
NearestOnMesh nearest_on_triangle(const Vec3& p, const std::array<Vec3, 3>& corners) noexcept;

/// The triangles of space in a BoxTree. Plane meshes have z = 0: a point of one lies in the
/// triangle that is nearest. Copies its arguments. nearest() is safe from several threads.
class TriangleSearch {
 public:
  TriangleSearch() = default;
  /// Indices lie in range, coordinates are finite. Flat triangles are segments or points. Throws Cancelled soon after
  /// `monitor` received a request to stop; it may be null. The tree does not depend on the number of threads.
  TriangleSearch(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                 Monitor* monitor = nullptr, int threads = 1);

  [[nodiscard]] bool empty() const noexcept { return tree_.empty(); }
  /// The nearest point; of equally near triangles, the lowest index is returned. `guess`, any triangle (one found
  /// nearby), saves time and changes nothing. Requires a tree that is not empty.
  [[nodiscard]] NearestOnMesh nearest(const Vec3& p, std::int32_t guess = 0) const noexcept;
  /// Adds the triangles that a segment may meet: all triangles whose boxes it meets, and some others beside.
  void beside_segment(Vec3 p, Vec3 q, std::vector<std::int32_t>& triangles) const;
  /// Adds triangles whose boxes have a point in common with the closed box from `low` to `high`, each once. May omit
  /// long triangles that have no point in it themselves.
  void beside_box(const Vec3& low, const Vec3& high, std::vector<std::int32_t>& triangles) const;
  /// Longest edge of a triangle.
  [[nodiscard]] double longest_edge(std::int32_t triangle) const noexcept;

 private:
  void look_at(std::int32_t triangle, Vec3 p, NearestOnMesh& best) const noexcept;
  /// Triangles of the things of a leaf, some more than once.
  template <typename Look>
  void each_of(const BoxTree::Node& leaf, const Look& look) const {
    for (const std::int32_t thing : tree_.things(leaf))
      look(triangle_.empty() ? thing : triangle_[static_cast<std::size_t>(thing)]);
  }

  std::vector<std::array<Vec3, 3>> corners_;
  std::vector<std::int32_t> triangle_;  // by thing of the tree; empty: things are triangles
  BoxTree tree_;
};

}  // namespace carreau
