// SPDX-License-Identifier: BSD-3-Clause
#include "control_space/prediction.h"

namespace carreau::detail {

namespace {

// The side that continues a side beyond its first and its second end.
constexpr int side_at_end(int side, int end) { return (side < 2 ? 2 : 0) + end; }

}  // namespace

Prediction NodePredictor::predict(const TreeCell& cell, int k) {
  for (int side = 0; side < 4; ++side)
    if (middles_of_sides[side] == k) return predict_middle(cell, side);
  return k == 4 ? predict_by_middles(cell) : lattice_.predict(cell.node[k]);
}

// The corner next to `end` of a side on the line through it, beyond the cell, when it has a value.
std::int32_t NodePredictor::corner_beyond(const TreeCell& cell, int side, int end) {
  const int onward = side_at_end(side, end);
  if (cell.beside[onward] < 0) return -1;
  if (const TreeCell* next = like_it_beside(cell, onward)) return lattice_.valued(next->node[ends_of_sides[side][end]]);
  if (const TreeCell* across = like_it_beside(cell, side))
    if (const TreeCell* next = like_it_beside(*across, onward))
      return lattice_.valued(next->node[ends_of_sides[side ^ 1][end]]);
  const GridPoint p = lattice_.point(cell.node[ends_of_sides[side][end]]);
  const std::int32_t d = end == 0 ? -cell.size : cell.size;
  return lattice_.valued_node(side < 2 ? GridPoint{p.i + d, p.j} : GridPoint{p.i, p.j + d});
}

// From the ends of the side and the corners beyond, and from the centres of the cells across.
Prediction NodePredictor::predict_middle(const TreeCell& cell, int side) {
  const bool along_i = side < 2, upper = side % 2 == 1;
  const auto along = [&](int k) {
    const int end = k > 0 ? 1 : 0;
    return k == -1 || k == 1 ? lattice_.valued(cell.node[ends_of_sides[side][end]]) : corner_beyond(cell, side, end);
  };
  // The cell itself lies on the lower side of its upper sides.
  const auto across = [&](int k) {
    if ((k < 0) == upper) return centre_if_sampled(k == 1 || k == -1 ? &cell : like_it_beside(cell, side ^ 1));
    const TreeCell* beyond = like_it_beside(cell, side);
    return centre_if_sampled(k == 1 || k == -1 || beyond == nullptr ? beyond : like_it_beside(*beyond, side));
  };
  const std::int32_t node = cell.node[middles_of_sides[side]];
  return along_i ? lattice_.predict_from(node, true, false, along, across)
                 : lattice_.predict_from(node, false, true, across, along);
}

std::int32_t NodePredictor::middle_with_value(const TreeCell& cell, int side) {
  const std::int32_t n = cell.node[middles_of_sides[side]];
  if (lattice_.sampled(n)) return n;
  return lattice_.inside(n) && predict_middle(cell, side).order >= 2 ? n : -1;
}

// The node at k = -3, -1, 1, 3 times half of the cell's size from its centre, through the middle of a side.
std::int32_t NodePredictor::middle_from_centre(const TreeCell& cell, int side, int k) {
  if (k == -1 || k == 1) return middle_with_value(cell, side);
  if (cell.beside[side] < 0) return -1;
  if (const TreeCell* next = like_it_beside(cell, side)) return middle_with_value(*next, side);
  const GridPoint p = lattice_.point(cell.centre());
  const std::int32_t d = k * (cell.size / 2);
  return lattice_.valued_node(side < 2 ? GridPoint{p.i, p.j + d} : GridPoint{p.i + d, p.j});
}

// Predicts a centre from the middles of the sides of this cell and of the cells beyond.
Prediction NodePredictor::predict_by_middles(const TreeCell& cell) {
  return lattice_.predict_from(
      cell.centre(), true, true, [&](int k) { return middle_from_centre(cell, k > 0 ? 3 : 2, k); },
      [&](int k) { return middle_from_centre(cell, k > 0 ? 1 : 0, k); });
}

bool NodePredictor::predict_centre(const TreeCell& cell, Metric2& root) const {
  Metric2 inner{0, 0, 0}, outer{0, 0, 0};
  for (const int k : corners_of_cell) {
    if (!lattice_.sampled(cell.node[k])) return false;
    inner = inner + lattice_.value(cell.node[k]);
  }
  for (int side = 0; side < 4; ++side) {
    if (cell.beside[side] < 0) return false;
    const TreeCell& next = tree_[cell.beside[side]];
    for (int end = 0; end < 2; ++end) {
      const Metric2* corner = nullptr;
      if (next.size == cell.size) {
        const std::int32_t n = next.node[ends_of_sides[side][end]];
        if (lattice_.sampled(n)) corner = &lattice_.value(n);
      } else {
        const GridPoint at = cell.point(ends_of_sides[side][end]);
        const std::int32_t d = side % 2 == 0 ? -cell.size : cell.size;
        corner = lattice_.sample(side < 2 ? GridPoint{at.i, at.j + d} : GridPoint{at.i + d, at.j});
      }
      if (corner == nullptr) return false;
      outer = outer + *corner;
    }
  }
  root = 0.3125 * inner + -0.03125 * outer;
  const auto value = [&](int k) { return lattice_.value(cell.node[corners_of_cell[k]]); };
  return plausible(root, 0.5 * (value(0) + value(3)), 0.5 * (value(1) + value(2)));
}

}  // namespace carreau::detail
