// SPDX-License-Identifier: BSD-3-Clause
// Topology of quadrilaterals: defects are repaired, and sound parts stay.
#include <gtest/gtest.h>

#include <algorithm>

#include "surface/elements/quads/passes.h"

namespace carreau {
namespace {

const auto no_edge = [](std::int32_t, std::int32_t) { return false; };

/// 4 x 4 unit squares, whose border is fixed.
QuadPatch squares() {
  QuadPatch patch;
  for (int j = 0; j <= 4; ++j)
    for (int i = 0; i <= 4; ++i) {
      patch.uv.push_back({1. * i, 1. * j});
      patch.fixed.push_back(i == 0 || j == 0 || i == 4 || j == 4 ? 1 : 0);
    }
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) patch.cells.push_back({5 * j + i, 5 * j + i + 1, 5 * j + i + 6, 5 * j + i + 5});
  return patch;
}

double area(const QuadPatch& patch) {
  double sum = 0;
  for (const MixedCell& c : patch.cells)
    for (int k = 0, n = corners_of(c); k < n; ++k) sum += cross(patch.uv[c[k]], patch.uv[c[(k + 1) % n]]) / 2;
  return sum;
}

std::vector<int> degrees(const QuadPatch& patch) {
  std::vector<int> degree(patch.uv.size(), 0);
  for (const MixedCell& c : patch.cells)
    for (int k = 0; k < corners_of(c); ++k) ++degree[c[k]];
  return degree;
}

TEST(QuadCleanup, LeavesALatticeAlone) {
  const ControlSpace space = ControlSpace::constant({1, 0, 1});
  QuadPatch patch = squares();
  const std::vector<MixedCell> before = patch.cells;
  Monitor monitor;
  const FaceCharts charts(space);
  PlaneQuads quads(patch, charts);
  clean_up(quads, no_edge, monitor);
  EXPECT_EQ(patch.cells, before);
}

TEST(QuadCleanup, RemovesAVertexOfTwoCells) {
  const ControlSpace space = ControlSpace::constant({1, 0, 1});
  QuadPatch patch = squares();
  // The square (6, 7, 12, 11) becomes two with a vertex in its middle.
  patch.uv.push_back({1.5, 1.5}), patch.fixed.push_back(0);
  const auto at = std::find(patch.cells.begin(), patch.cells.end(), MixedCell{6, 7, 12, 11});
  *at = {6, 7, 12, 25};
  patch.cells.push_back({6, 25, 12, 11});
  Monitor monitor;
  const FaceCharts charts(space);
  PlaneQuads quads(patch, charts);
  clean_up(quads, no_edge, monitor);
  EXPECT_EQ(patch.cells.size(), 16U);
  EXPECT_EQ(degrees(patch)[25], 0);
  EXPECT_NEAR(area(patch), 16, 1e-12);
}

TEST(QuadCleanup, TurnsAnEdgeBack) {
  const ControlSpace space = ControlSpace::constant({1, 0, 1});
  QuadPatch patch = squares();
  // (6, 7, 12, 11) and (7, 8, 13, 12) with another diagonal of their hexagon 6 7 8 13 12 11.
  std::erase(patch.cells, MixedCell{6, 7, 12, 11});
  std::erase(patch.cells, MixedCell{7, 8, 13, 12});
  patch.uv[7].y() -= 0.2, patch.uv[12].y() += 0.2;
  patch.cells.push_back({8, 13, 12, 11}), patch.cells.push_back({11, 6, 7, 8});
  Monitor monitor;
  const FaceCharts charts(space);
  PlaneQuads quads(patch, charts);
  clean_up(quads, no_edge, monitor);
  const std::vector<int> degree = degrees(patch);
  for (std::size_t v = 0; v < degree.size(); ++v)
    if (patch.fixed[v] == 0) {
      EXPECT_EQ(degree[v], 4) << v;
    }
  EXPECT_NEAR(area(patch), 16, 1e-12);
}

TEST(QuadCleanup, DrawsTogetherTwoVerticesOfThreeCells) {
  const ControlSpace space = ControlSpace::constant({1, 0, 1});
  QuadPatch patch = squares();
  // The middle vertex 12 becomes two, 12 and 25, with a square between them: both have three cells.
  patch.uv[12] = {2, 1.6};
  patch.uv.push_back({2, 2.4}), patch.fixed.push_back(0);
  for (MixedCell& c : patch.cells)
    if (c == MixedCell{11, 12, 17, 16} || c == MixedCell{12, 13, 18, 17}) std::replace(c.begin(), c.end(), 12, 25);
  patch.cells.push_back({11, 12, 13, 25});
  for (const MixedCell& c : patch.cells) ASSERT_TRUE(is_convex(patch, c));
  Monitor monitor;
  const FaceCharts charts(space);
  PlaneQuads quads(patch, charts);
  clean_up(quads, no_edge, monitor);
  EXPECT_EQ(patch.cells.size(), 16U);
  const std::vector<int> degree = degrees(patch);
  EXPECT_EQ(degree[12] + degree[25], 4);
  EXPECT_NEAR(area(patch), 16, 1e-12);
}

}  // namespace
}  // namespace carreau
