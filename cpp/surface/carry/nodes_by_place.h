// SPDX-License-Identifier: BSD-3-Clause
// Images of nodes under maps, found by their places.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
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
    for (const std::int32_t v : nodes) cells_[cell_of(position(v))].push_back(v);
  }

  /// Calls `use` for each node of the kind of node `like`, vertex or inside an edge, within the gap of `place`.
  template <typename Use>
  void for_near(const Vec3& place, std::int32_t like, const Use& use) const {
    std::set<Cell> cells;
    for (int corner = 0; corner < 8; ++corner)
      cells.insert(cell_of(place + gap_ * Vec3((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1)));
    for (const Cell& cell : cells)
      if (const auto found = cells_.find(cell); found != cells_.end())
        for (const std::int32_t w : found->second)
          if (norm(position_(w) - place) <= gap_ && (w < first_mid_) == (like < first_mid_)) use(w);
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  [[nodiscard]] Cell cell_of(const Vec3& p) const {
    const double width = 4 * gap_;
    return {std::llround(p.x() / width), std::llround(p.y() / width), std::llround(p.z() / width)};
  }

  const Positions& position_;
  std::int32_t first_mid_;
  double gap_;
  std::map<Cell, std::vector<std::int32_t>> cells_;
};

/// Returns, by map, {image, node} where the node is the first of its orbit under the maps, each image once. `images`: by map, each
/// node with its image.
std::vector<NodeImages> pairs_of_orbits(const std::vector<NodeImages>& images);

}  // namespace carreau
