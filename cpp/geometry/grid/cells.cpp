// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/grid/cells.h"

#include <algorithm>
#include <array>
#include <utility>

#include "geometry/grid/thresholds.h"
#include "support/rounding_of.h"

namespace carreau::grid {

namespace {

constexpr std::array<BorderEdge::NodeAt, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

BorderEdge::NodeAt corner(const BorderEdge& edge, int k) {
  const BorderEdge::NodeAt& at = corners[static_cast<std::size_t>(k % 4)];
  return {edge.i + at.i, edge.j + at.j};
}

enum class Shape { good, folded, flat };

Shape shape_of(const Block& block, int i, int j) {
  const std::array<Vec3, 4> p{block.node(i, j), block.node(i + 1, j), block.node(i + 1, j + 1), block.node(i, j + 1)};
  const Vec3 area = cross(p[2] - p[0], p[3] - p[1]) / 2;
  double longest = 0, largest = 0;
  bool folded = false;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 next = p[(k + 1) % 4] - p[k], before = p[(k + 3) % 4] - p[k];
    const Vec3 normal = cross(next, before);
    longest = std::max({longest, norm(next), norm(p[(k + 2) % 4] - p[k])});
    largest = std::max(largest, norm(normal));
    folded = folded || dot(normal, area) < -rounding_of::sizes * dot(area, area);
  }
  if (largest <= rounding_of::heights * longest * longest) return Shape::flat;
  return folded ? Shape::folded : Shape::good;
}

/// Labels and borders of the cells of one block.
class CellFinder {
 public:
  explicit CellFinder(const Block& block) : block_(block), label_(block.nodes.size(), -1) {}

  Cells run() {
    for (int j = 0; j + 1 < block_.rows; ++j)
      for (int i = 0; i + 1 < block_.columns; ++i) look_at(i, j);
    for (int j = 0; j + 1 < block_.rows; ++j)
      for (int i = 0; i + 1 < block_.columns; ++i)
        if (label_[block_.index(i, j)] == unseen) fill(i, j);
    find_loops();
    for (const int label : label_) cells_.there.push_back(label >= 0 ? 1 : 0);
    return std::move(cells_);
  }

 private:
  static constexpr int unseen = -2;

  void look_at(int i, int j) {
    if (!block_.has_cell(i, j)) {
      ++cells_.missing;
      return;
    }
    const Shape shape = shape_of(block_, i, j);
    if (shape == Shape::flat) {
      if (cells_.flat++ == 0) cells_.flat_i = i, cells_.flat_j = j;
      return;
    }
    if (shape == Shape::folded && cells_.folded++ == 0) cells_.folded_i = i, cells_.folded_j = j;
    label_[block_.index(i, j)] = unseen;
    ++cells_.count;
  }

  [[nodiscard]] int label(int i, int j) const {
    const bool inside = i >= 0 && j >= 0 && i + 1 < block_.columns && j + 1 < block_.rows;
    return inside ? label_[block_.index(i, j)] : -1;
  }

  [[nodiscard]] static std::pair<int, int> beyond(int i, int j, int side) {
    return {i + (side == 1 ? 1 : side == 3 ? -1 : 0), j + (side == 2 ? 1 : side == 0 ? -1 : 0)};
  }

  void fill(int i, int j) {
    const int region = static_cast<int>(cells_.regions.size());
    cells_.regions.emplace_back();
    std::vector<std::pair<int, int>> front{{i, j}};
    label_[block_.index(i, j)] = region;
    while (!front.empty()) {
      const auto [a, b] = front.back();
      front.pop_back();
      for (int side = 0; side < 4; ++side) {
        const auto [x, y] = beyond(a, b, side);
        if (label(x, y) != unseen) continue;
        label_[block_.index(x, y)] = region;
        front.emplace_back(x, y);
      }
    }
  }

  [[nodiscard]] bool on_border(const BorderEdge& edge, int region) const {
    const auto [x, y] = beyond(edge.i, edge.j, edge.side);
    return label(x, y) != region;
  }

  /// Turns round the corner at the end of an edge, through the cells of the region that meet there. If two cells touch
  /// by this corner only, the loop stays with its own cell.
  [[nodiscard]] BorderEdge next(BorderEdge edge, int region) const {
    edge.side = (edge.side + 1) % 4;
    while (!on_border(edge, region)) {
      const auto [x, y] = beyond(edge.i, edge.j, edge.side);
      edge.i = x, edge.j = y, edge.side = (edge.side + 3) % 4;
    }
    return edge;
  }

  void find_loops() {
    std::vector<char> seen(4 * block_.nodes.size(), 0);
    const auto mark = [&](const BorderEdge& edge) -> char& {
      return seen[4 * block_.index(edge.i, edge.j) + static_cast<std::size_t>(edge.side)];
    };
    for (int j = 0; j + 1 < block_.rows; ++j)
      for (int i = 0; i + 1 < block_.columns; ++i)
        for (int side = 0; label(i, j) >= 0 && side < 4; ++side) {
          const BorderEdge start{i, j, side};
          const int region = label(i, j);
          if (!on_border(start, region) || mark(start) != 0) continue;
          std::vector<BorderEdge>& loop = cells_.regions[static_cast<std::size_t>(region)].loops.emplace_back();
          for (BorderEdge edge = start; mark(edge) == 0; edge = next(edge, region)) {
            mark(edge) = 1;
            loop.push_back(edge);
          }
        }
  }

  const Block& block_;
  std::vector<int> label_;  // [node at the cell's lower left]: -1: no cell, unseen, or its region
  Cells cells_;
};

}  // namespace

BorderEdge::NodeAt BorderEdge::start() const { return corner(*this, side); }
BorderEdge::NodeAt BorderEdge::end() const { return corner(*this, side + 1); }
BorderEdge::NodeAt BorderEdge::inner_start() const { return corner(*this, side + 3); }
BorderEdge::NodeAt BorderEdge::inner_end() const { return corner(*this, side + 2); }

Cells find_cells(const Block& block) { return CellFinder(block).run(); }

}  // namespace carreau::grid
