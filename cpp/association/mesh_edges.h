// SPDX-License-Identifier: BSD-3-Clause
// Numbered edges of a mesh that is refined.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/surface_mesh.h"

namespace carreau::refining {

using Key = std::array<std::int32_t, 2>;
using Triangle = std::array<std::int32_t, 3>;

inline Key ordered(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// Edges by the lesser of their vertices, numbered in ascending order.
class EdgeList {
 public:
  EdgeList(std::vector<Key> edges, std::size_t vertices) : edges_(std::move(edges)), first_(vertices + 1, 0) {
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    for (const Key& edge : edges_) ++first_[edge[0] + 1];
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  }
  [[nodiscard]] std::size_t size() const noexcept { return edges_.size(); }
  [[nodiscard]] const Key& operator[](std::size_t e) const { return edges_[e]; }
  /// -1: there is no such edge.
  [[nodiscard]] std::int32_t find(std::int32_t a, std::int32_t b) const {
    const Key key = ordered(a, b);
    if (key[0] < 0 || static_cast<std::size_t>(key[0]) + 1 >= first_.size()) return -1;
    const auto begin = edges_.begin() + first_[key[0]], end = edges_.begin() + first_[key[0] + 1];
    const auto found = std::lower_bound(begin, end, key);
    return found != end && *found == key ? static_cast<std::int32_t>(found - edges_.begin()) : -1;
  }

 private:
  std::vector<Key> edges_;
  std::vector<std::int32_t> first_;
};

/// Sides of the elements of a face, by local vertices; diagonals of quadrilaterals are none.
template <typename Use>
void for_sides(const FaceMesh& face, const Use& use) {
  for (std::size_t t = 0; t < face.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      if (t < 2 * static_cast<std::size_t>(face.quads) && i == (t % 2 == 0 ? 2U : 0U)) continue;
      use(face.triangles[t][i], face.triangles[t][(i + 1) % 3]);
    }
  for (const Triangle& t : face.flattened)
    for (std::size_t i = 0; i < 3; ++i)
      if (face.vertex[t[i]] != face.vertex[t[(i + 1) % 3]]) use(t[i], t[(i + 1) % 3]);
}

}  // namespace carreau::refining
