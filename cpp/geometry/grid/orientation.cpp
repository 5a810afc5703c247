// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/grid/orientation.h"

#include <algorithm>

namespace carreau::grid {

namespace {

struct Neighbour {
  int block;
  bool opposite;  ///< normals are, as the blocks are given
};

std::vector<std::vector<Neighbour>> neighbours_of(const std::vector<Block>& blocks, const Borders& borders) {
  std::vector<std::vector<Neighbour>> around(blocks.size());
  for (const auto& [ends, uses] : borders.edges) {
    if (uses.size() != 2) continue;
    const int a = borders.faces[static_cast<std::size_t>(uses[0].face)].block;
    const int b = borders.faces[static_cast<std::size_t>(uses[1].face)].block;
    if (a == b) continue;
    const auto start = [&](const EdgeUse& use, int block) {
      return borders.point(block, blocks[static_cast<std::size_t>(block)], use.edge.start());
    };
    // Both run with their region on the left: in opposite directions where normals agree.
    const bool opposite = start(uses[0], a) == start(uses[1], b);
    around[static_cast<std::size_t>(a)].push_back({b, opposite});
    around[static_cast<std::size_t>(b)].push_back({a, opposite});
  }
  return around;
}

/// Six times the volume between the cells of a block and the origin.
double volume_of(const Block& block, const Cells& cells) {
  double sum = 0;
  for (int j = 0; j + 1 < block.rows; ++j)
    for (int i = 0; i + 1 < block.columns; ++i) {
      if (cells.there[block.index(i, j)] == 0) continue;
      const Vec3 &p = block.node(i, j), &q = block.node(i + 1, j), &r = block.node(i + 1, j + 1), &s = block.node(i, j + 1);
      sum += dot(p, cross(q, r)) + dot(p, cross(r, s));
    }
  return sum;
}

}  // namespace

std::vector<char> blocks_to_turn(const std::vector<Block>& blocks, const std::vector<Cells>& cells,
                                 const Borders& borders) {
  const std::vector<std::vector<Neighbour>> around = neighbours_of(blocks, borders);
  std::vector<char> open(blocks.size(), 0);
  for (const auto& [ends, uses] : borders.edges)
    if (uses.size() == 1) open[static_cast<std::size_t>(borders.faces[static_cast<std::size_t>(uses[0].face)].block)] = 1;
  std::vector<char> turned(blocks.size(), 0), seen(blocks.size(), 0);
  for (std::size_t first = 0; first < blocks.size(); ++first) {
    if (seen[first] != 0) continue;
    std::vector<std::size_t> group{first};
    seen[first] = 1;
    for (std::size_t k = 0; k < group.size(); ++k)
      for (const Neighbour& next : around[group[k]]) {
        const auto b = static_cast<std::size_t>(next.block);
        if (seen[b] != 0) continue;
        seen[b] = 1, turned[b] = next.opposite ? static_cast<char>(1 - turned[group[k]]) : turned[group[k]];
        group.push_back(b);
      }
    double volume = 0;
    for (const std::size_t b : group) volume += (turned[b] != 0 ? -1 : 1) * volume_of(blocks[b], cells[b]);
    const bool closed = std::none_of(group.begin(), group.end(), [&](std::size_t b) { return open[b] != 0; });
    if (closed && volume < 0)
      for (const std::size_t b : group) turned[b] = static_cast<char>(1 - turned[b]);
  }
  return turned;
}

void turn_over(Block& block) {
  const auto columns = static_cast<std::ptrdiff_t>(block.columns);
  for (std::ptrdiff_t j = 0; j < block.rows; ++j)
    std::reverse(block.nodes.begin() + j * columns, block.nodes.begin() + (j + 1) * columns);
}

}  // namespace carreau::grid
