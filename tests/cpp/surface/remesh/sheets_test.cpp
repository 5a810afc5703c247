// SPDX-License-Identifier: BSD-3-Clause
// Cells of one face that meet along an edge: each sheet has its own corners there.
#include <gtest/gtest.h>

#include <array>
#include <set>
#include <utility>
#include <vector>

#include "surface/remesh/cells/sheets.h"

namespace carreau {
namespace {

PlacedCell cell(const std::vector<std::int32_t>& corners) {
  PlacedCell made{0, static_cast<int>(corners.size()), {}, {}, false};
  for (std::size_t i = 0; i < corners.size(); ++i) made.corners[i] = {corners[i], 0};
  return made;
}

bool runs_twice_along_an_edge(const std::vector<PlacedCell>& cells) {
  std::set<std::pair<PlacedCorner, PlacedCorner>> met;
  for (const PlacedCell& c : cells)
    for (int i = 0; i < c.count; ++i)
      if (!met.emplace(c.corners[i], c.corners[(i + 1) % c.count]).second) return true;
  return false;
}

// Pages between vertices 0 and 1, each a quadrilateral and a triangle behind it; `turned` ones run the other way.
std::vector<PlacedCell> book(int pages, int turned) {
  std::vector<PlacedCell> cells;
  for (int p = 0; p < pages; ++p) {
    const std::int32_t a = 2 + 3 * p, b = a + 1, c = a + 2;
    if (p < turned) {
      cells.push_back(cell({1, 0, a, b})), cells.push_back(cell({b, a, c}));
    } else {
      cells.push_back(cell({0, 1, b, a})), cells.push_back(cell({a, b, c}));
    }
  }
  return cells;
}

TEST(Sheets, PagesOfABookHaveTheirOwnCorners) {
  for (const auto& [pages, turned] : {std::pair{2, 0}, {3, 0}, {3, 1}, {4, 2}, {5, 1}}) {
    std::vector<PlacedCell> cells = book(pages, turned);
    ASSERT_TRUE(runs_twice_along_an_edge(cells));
    part_sheets(cells, [](std::int32_t v) { return v < 2; });
    EXPECT_FALSE(runs_twice_along_an_edge(cells)) << pages << " pages, " << turned << " turned";
    for (std::size_t k = 1; k < cells.size(); k += 2)
      for (int i = 0; i < 3; ++i) EXPECT_EQ(cells[k].corners[i].sheet, 0) << "away from the edge there is one sheet";
  }
}

TEST(Sheets, AWholeSurfaceIsOneSheet) {
  std::vector<PlacedCell> cells = book(2, 1);
  const std::vector<PlacedCell> before = cells;
  part_sheets(cells, [](std::int32_t) { return true; });
  for (std::size_t c = 0; c < cells.size(); ++c) EXPECT_EQ(cells[c].corners, before[c].corners);
}

// Cells around vertex 0 that hang together over other edges stay together there.
TEST(Sheets, AreJoinedOverOtherEdges) {
  std::vector<PlacedCell> cells{cell({0, 1, 2}), cell({0, 2, 3}), cell({0, 1, 4}), cell({0, 4, 5})};
  part_sheets(cells, [](std::int32_t v) { return v < 2; });
  EXPECT_EQ(cells[0].corners[0], cells[1].corners[0]);
  EXPECT_EQ(cells[2].corners[0], cells[3].corners[0]);
  EXPECT_NE(cells[0].corners[0], cells[2].corners[0]);
  EXPECT_FALSE(runs_twice_along_an_edge(cells));
}

}  // namespace
}  // namespace carreau
