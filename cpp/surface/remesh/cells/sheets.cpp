// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/cells/sheets.h"

#include <algorithm>
#include <compare>
#include <cstddef>
#include <map>
#include <utility>

#include "model/union_find.h"

namespace carreau {

namespace {

/// A side of a cell, as the cell runs.
struct CellSide {
  PlacedCorner from, to;
  std::size_t cell = 0;
  int rank = 0;
  friend auto operator<=>(const CellSide&, const CellSide&) = default;
  [[nodiscard]] bool runs_as(const CellSide& other) const { return from == other.from && to == other.to; }
};

std::vector<CellSide> sides_of(const std::vector<PlacedCell>& cells, const std::function<bool(const CellSide&)>& counts) {
  std::vector<CellSide> sides;
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (int i = 0; i < cells[c].count; ++i) {
      const CellSide side{cells[c].corners[i], cells[c].corners[(i + 1) % cells[c].count], c, i};
      if (counts(side)) sides.push_back(side);
    }
  std::ranges::sort(sides);
  return sides;
}

class SheetFinder {
 public:
  SheetFinder(std::vector<PlacedCell>& cells, std::vector<PlacedCorner> ends)
      : cells_(cells), ends_(std::move(ends)), sheets_(4 * cells.size()) {}

  void run() {
    join();
    number();
  }

 private:
  // Over edges of two cells that run along them in opposite ways.
  void join() {
    const std::vector<CellSide> sides = sides_of(cells_, [](const CellSide&) { return true; });
    const auto only = [&](const PlacedCorner& from, const PlacedCorner& to) -> const CellSide* {
      const auto first = std::ranges::lower_bound(sides, CellSide{from, to, 0, 0});
      if (first == sides.end() || first->from != from || first->to != to) return nullptr;
      return first + 1 == sides.end() || !(first + 1)->runs_as(*first) ? &*first : nullptr;
    };
    for (const CellSide& side : sides) {
      const CellSide *here = only(side.from, side.to), *beyond = only(side.to, side.from);
      if (here == nullptr || beyond == nullptr) continue;
      sheets_.merge(corner(*here, 0), corner(*beyond, 1));
      sheets_.merge(corner(*here, 1), corner(*beyond, 0));
    }
  }
  [[nodiscard]] std::size_t corner(const CellSide& side, int end) const {
    return 4 * side.cell + static_cast<std::size_t>((side.rank + end) % cells_[side.cell].count);
  }

  void number() {
    std::map<PlacedCorner, std::map<std::size_t, std::int32_t>> sheets;  // by place and root
    for (std::size_t c = 0; c < cells_.size(); ++c)
      for (int i = 0; i < cells_[c].count; ++i) {
        PlacedCorner& placed = cells_[c].corners[i];
        if (!std::ranges::binary_search(ends_, placed)) continue;
        auto& there = sheets[placed];
        const auto next = static_cast<std::int32_t>(there.size());
        placed.sheet = there.try_emplace(sheets_.find(4 * c + static_cast<std::size_t>(i)), next).first->second;
      }
  }

  std::vector<PlacedCell>& cells_;
  std::vector<PlacedCorner> ends_;  // of edges that cells run along the same way, ascending
  UnionFind sheets_;  // of corners of cells
};

}  // namespace

void part_sheets(std::vector<PlacedCell>& cells, const std::function<bool(std::int32_t)>& may_be_of_several) {
  const std::vector<CellSide> on_lines =
      sides_of(cells, [&](const CellSide& s) { return may_be_of_several(s.from.vertex) && may_be_of_several(s.to.vertex); });
  std::vector<PlacedCorner> ends;
  for (std::size_t k = 1; k < on_lines.size(); ++k)
    if (on_lines[k].runs_as(on_lines[k - 1])) ends.push_back(on_lines[k].from), ends.push_back(on_lines[k].to);
  if (ends.empty()) return;
  std::ranges::sort(ends);
  SheetFinder(cells, std::move(ends)).run();
}

}  // namespace carreau
