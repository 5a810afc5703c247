// SPDX-License-Identifier: BSD-3-Clause
#include "control_space/tree.h"

#include <algorithm>
#include <cmath>

#include "control_space/thresholds.h"
#include "predicates/clamped_int.h"
#include "support/rounding_of.h"

namespace carreau::detail {

namespace {

using namespace thresholds::control_space;

}  // namespace

Tree::Tree(const SampledDomain& domain, const PolygonLocator& locator, Lattice& lattice)
    : domain_(domain),
      locator_(locator),
      lattice_(lattice),
      columns_(lattice.end().i / lattice.step()),
      rows_(lattice.end().j / lattice.step()) {
  // The coarsest cells that the box of an edge overlaps.
  std::vector<std::vector<std::int32_t>> candidates(static_cast<std::size_t>(columns_) *
                                                    static_cast<std::size_t>(rows_));
  const auto cell_of = [&](double x, int count, double shift) {
    return clamped_int(x / lattice_.step() + shift, 0, count - 1);
  };
  for (std::size_t e = 0; e < domain.edges.size(); ++e) {
    const Vec2 p = lattice.position(domain.vertices[domain.edges[e].first]);
    const Vec2 q = lattice.position(domain.vertices[domain.edges[e].second]);
    const int i0 = cell_of(std::min(p.x(), q.x()), columns_, -rounding_of::places),
              i1 = cell_of(std::max(p.x(), q.x()), columns_, rounding_of::places);
    const int j0 = cell_of(std::min(p.y(), q.y()), rows_, -rounding_of::places),
              j1 = cell_of(std::max(p.y(), q.y()), rows_, rounding_of::places);
    for (int j = j0; j <= j1; ++j)
      for (int i = i0; i <= i1; ++i)
        candidates[static_cast<std::size_t>(j * columns_ + i)].push_back(static_cast<std::int32_t>(e));
  }
  for (int j = 0; j < rows_; ++j)
    for (int i = 0; i < columns_; ++i) {
      TreeCell cell{.i = i * lattice.step(), .j = j * lattice.step(), .size = lattice.step()};
      const Place place = complete(cell, candidates[static_cast<std::size_t>(j * columns_ + i)], Place::unknown);
      for (int k = 0; k < 9; ++k) cell.node[k] = lattice_.node(cell.point(k), place);
      const std::int32_t number = j * columns_ + i;
      cell.beside = {j > 0 ? number - columns_ : -1, j + 1 < rows_ ? number + columns_ : -1, i > 0 ? number - 1 : -1,
                     i + 1 < columns_ ? number + 1 : -1};
      cells_.push_back(cell);
    }
}

// Separating axes of the closed square and the segment.
bool Tree::meets(const TreeCell& cell, std::int32_t edge) const noexcept {
  const Vec2 p = lattice_.position(domain_.vertices[domain_.edges[edge].first]);
  const Vec2 q = lattice_.position(domain_.vertices[domain_.edges[edge].second]);
  const double half = 0.5 * cell.size * (1 + rounding_of::places);
  const Vec2 centre{cell.i + 0.5 * cell.size, cell.j + 0.5 * cell.size};
  const Vec2 middle = 0.5 * (p + q) - centre, d = 0.5 * (q - p);
  const double x = std::abs(d.x()), y = std::abs(d.y());
  return std::abs(middle.x()) <= half + x && std::abs(middle.y()) <= half + y &&
         std::abs(cross(d, middle)) <= half * (x + y) * (1 + rounding_of::places);
}

// Finds the cell's edges and whether it is relevant; returns the resulting place of its nodes.
Place Tree::complete(TreeCell& cell, std::span<const std::int32_t> candidates, Place whole) {
  cell.edges_begin = static_cast<std::int32_t>(edges_.size());
  for (const std::int32_t e : candidates)
    if (meets(cell, e)) edges_.push_back(e);
  cell.edges_end = static_cast<std::int32_t>(edges_.size());
  const bool cut = cell.edges_end > cell.edges_begin;
  if (whole == Place::unknown)
    cell.relevant = cut || locator_.contains(lattice_.parameters(cell.point(4)));
  else
    cell.relevant = whole == Place::inside;
  // A closed cell that no edge meets is on one side.
  return cut ? Place::unknown : cell.relevant ? Place::inside : Place::outside;
}

// The block of the nodes that a split of the cell adds. They are in its interior and on its lower and left sides, or on
// its upper or right `side`.
std::int32_t Tree::block_of(std::int32_t number, int side) {
  const TreeCell& cell = cells_[number];
  if (const std::int32_t beyond = cell.beside[side]; beyond >= 0 && cells_[beyond].size == cell.size)
    return block_of(beyond);
  const GridPoint corner{cell.i + (side == 3 ? cell.size : 0), cell.j + (side == 1 ? cell.size : 0)};
  return lattice_.block(corner, cell.size / 4);
}

std::int32_t Tree::block_of(std::int32_t number) {
  TreeCell& cell = cells_[number];
  if (cell.block < 0) cell.block = lattice_.block({cell.i, cell.j}, cell.size / 4);
  return cell.block;
}

void Tree::split(std::int32_t number) {
  cells_[number].child = size();
  // Nodes on the upper and right side belong to the cells beyond.
  const std::int32_t own = block_of(number), right = block_of(number, 3), above = block_of(number, 1);
  const TreeCell cell = cells_[number];
  const std::int32_t half = cell.size / 2;
  candidates_.assign(edges_.begin() + cell.edges_begin, edges_.begin() + cell.edges_end);
  const Place whole = !candidates_.empty() ? Place::unknown : cell.relevant ? Place::inside : Place::outside;
  // The 5 x 5 nodes of the parts, nine of which are nodes of the cell.
  std::array<std::int32_t, 25> node;
  for (int r = 0; r < 5; ++r)
    for (int c = 0; c < 5; ++c) node[5 * r + c] = r == 4 ? above + c : c == 4 ? right + 4 * r : own + 4 * r + c;
  for (int k = 0; k < 9; ++k) node[10 * (k / 3) + 2 * (k % 3)] = cell.node[k];
  for (int k = 0; k < 4; ++k) {
    TreeCell child{.i = cell.i + (k % 2) * half, .j = cell.j + (k / 2) * half, .size = half};
    child.error = cell.error, child.decay = cell.decay;
    child.vertices = cell.vertices / 4;
    const Place place = complete(child, candidates_, whole);
    for (int n = 0; n < 9; ++n) {
      const int row = 2 * (k / 2) + n / 3, column = 2 * (k % 2) + n % 3;
      child.node[n] = node[5 * row + column];
      if (row % 2 == 1 || column % 2 == 1) lattice_.create(child.node[n], place);
    }
    cells_.push_back(child);
  }
  join_parts(number);
}

// Makes the parts of a cell and the cells beyond its sides neighbours.
void Tree::join_parts(std::int32_t number) {
  const TreeCell cell = cells_[number];
  for (int k = 0; k < 4; ++k)
    for (int side = 0; side < 4; ++side) {
      const int axis = side < 2 ? 2 : 1;  // of the bit of k that selects the side of the part
      const bool outer = ((k & axis) != 0) == (side % 2 == 1);
      std::int32_t& beside = cells_[cell.child + k].beside[side];
      if (!outer) {
        beside = cell.child + (k ^ axis);
        continue;
      }
      beside = cell.beside[side];
      if (beside >= 0 && cells_[beside].size == cell.size && cells_[beside].child >= 0)
        beside = cells_[beside].child + (k ^ axis);
    }
  for (int side = 0; side < 4; ++side) point_to_parts(number, side);
}

// All smaller cells beyond a side of the cell.
void Tree::point_to_parts(std::int32_t number, int side) {
  const TreeCell cell = cells_[number];
  const std::int32_t beyond = cell.beside[side];
  if (beyond < 0 || cells_[beyond].size != cell.size || cells_[beyond].child < 0) return;
  const int axis = side < 2 ? 2 : 1, facing = side ^ 1;
  todo_.clear();
  const auto add_parts = [&](std::int32_t c) {
    for (int k = 0; k < 4; ++k)
      if (((k & axis) != 0) == (facing % 2 == 1)) todo_.push_back(cells_[c].child + k);
  };
  add_parts(beyond);
  while (!todo_.empty()) {
    TreeCell& d = cells_[todo_.back()];
    const std::int32_t c = todo_.back();
    todo_.pop_back();
    const bool upper_half = side < 2 ? d.i >= cell.i + cell.size / 2 : d.j >= cell.j + cell.size / 2;
    d.beside[facing] = cell.child + (side % 2 == 1 ? axis : 0) + (upper_half ? 3 - axis : 0);
    if (d.child >= 0) add_parts(c);
  }
}

std::int32_t Tree::leaf_at(GridPoint p) const noexcept {
  if (p.i < 0 || p.j < 0 || p.i >= lattice_.end().i || p.j >= lattice_.end().j) return -1;
  return leaf_below((p.j / lattice_.step()) * columns_ + p.i / lattice_.step(), p);
}

std::int32_t Tree::leaf_below(std::int32_t cell, GridPoint p) const noexcept {
  while (cells_[cell].child >= 0) {
    const TreeCell& c = cells_[cell];
    cell = c.child + (p.i >= c.i + c.size / 2 ? 1 : 0) + (p.j >= c.j + c.size / 2 ? 2 : 0);
  }
  return cell;
}

void Tree::vertices_in(const TreeCell& cell, std::vector<int>& found) const {
  found.clear();
  for (std::int32_t k = cell.edges_begin; k < cell.edges_end; ++k)
    for (const int v : {domain_.edges[edges_[k]].first, domain_.edges[edges_[k]].second}) {
      const Vec2 p = lattice_.position(domain_.vertices[v]);
      if (p.x() >= cell.i && p.x() <= cell.i + cell.size && p.y() >= cell.j && p.y() <= cell.j + cell.size)
        found.push_back(v);
    }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
}

}  // namespace carreau::detail
