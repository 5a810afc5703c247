// SPDX-License-Identifier: BSD-3-Clause
// Images of nodes under maps, found by their places.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "support/vec.h"

namespace carreau {

/// Nodes and their images.
using NodeImages = std::vector<std::array<std::int32_t, 2>>;

/// Finds nodes by their places. Nodes from `first_mid` on lie inside edges, and are no images of vertices. Keeps a reference.
class NodesByPlace {
 public:
  using Positions = std::function<Vec3(std::int32_t)>;
  NodesByPlace(const std::vector<std::int32_t>& nodes, const Positions& position, std::int32_t first_mid, double gap)
      : position_(position), first_mid_(first_mid), gap_(gap) {
    for (const std::int32_t v : nodes) nodes_.emplace_back(cell_of(position(v)), v);
    std::stable_sort(nodes_.begin(), nodes_.end(), [](const Entry& a, const Entry& b) { return a.first < b.first; });
  }

  /// Calls `use` for each node of the kind of node `like`, vertex or inside an edge, within the gap of `place`.
  template <typename Use>
  void for_near(const Vec3& place, std::int32_t like, const Use& use) const {
    const Vec3 reach(gap_, gap_, gap_);
    const Cell low = cell_of(place - reach), high = cell_of(place + reach);  // mostly one cell
    for (std::int64_t x = low[0]; x <= high[0]; ++x)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
          const Cell cell{x, y, z};
          const auto first = std::lower_bound(nodes_.begin(), nodes_.end(), cell, [](const Entry& entry, const Cell& c) { return entry.first < c; });
          for (auto near = first; near != nodes_.end() && near->first == cell; ++near)
            if (norm(position_(near->second) - place) <= gap_ && (near->second < first_mid_) == (like < first_mid_)) use(near->second);
        }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  using Entry = std::pair<Cell, std::int32_t>;
  [[nodiscard]] Cell cell_of(const Vec3& p) const {
    const double width = 4 * gap_;
    return {std::llround(p.x() / width), std::llround(p.y() / width), std::llround(p.z() / width)};
  }

  const Positions& position_;
  std::int32_t first_mid_;
  double gap_;
  std::vector<Entry> nodes_;  // by cell
};

/// Returns, by map, {image, node} where the node is the first of its orbit under the maps, each image once. `images`: by map, each
/// node with its image.
inline std::vector<NodeImages> pairs_of_orbits(const std::vector<NodeImages>& images) {
  std::map<std::int32_t, std::int32_t> first;  // of the orbit, by node
  for (const NodeImages& of_map : images)
    for (const auto& [v, w] : of_map) {
      std::int32_t& least = first.try_emplace(v, v).first->second;
      least = std::min(least, w);
    }
  std::set<std::int32_t> placed;
  std::vector<NodeImages> pairs(images.size());
  for (std::size_t m = 0; m < images.size(); ++m)
    for (const auto& [v, w] : images[m])
      if (first.at(v) == v && w != v && placed.insert(w).second) pairs[m].push_back({w, v});
  return pairs;
}

}  // namespace carreau
