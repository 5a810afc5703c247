// SPDX-License-Identifier: BSD-3-Clause
// The sides of triangles, edge by edge, in few entries at once: the result equals a sort of all of them.
#include "mesh/simplices/by_smallest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <tuple>
#include <vector>

namespace {

using carreau::SideFrom;
using Triangle = std::array<std::int32_t, 3>;
using Side = std::tuple<std::int32_t, std::int32_t, std::uint32_t, bool>;

std::vector<Triangle> random_triangles(std::size_t count, std::int32_t vertices) {
  std::mt19937 random(7);
  std::vector<Triangle> triangles(count);
  for (Triangle& t : triangles)
    for (std::int32_t& v : t) v = static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(vertices));
  return triangles;
}

std::vector<Side> sorted_sides(const std::vector<Triangle>& triangles) {
  std::vector<Side> sides;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = triangles[t][i], b = triangles[t][(i + 1) % 3];
      if (a != b) sides.emplace_back(std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(t), a < b);
    }
  std::stable_sort(sides.begin(), sides.end(), [](const Side& p, const Side& q) {
    return std::tie(std::get<0>(p), std::get<1>(p), std::get<2>(p)) <
           std::tie(std::get<0>(q), std::get<1>(q), std::get<2>(q));
  });
  return sides;
}

void expect_all_sides(std::vector<Triangle> triangles, std::size_t vertices, std::size_t least) {
  std::vector<Side> found;
  std::size_t edges = 0;
  carreau::for_each_edge(
      triangles, vertices,
      [&](std::int32_t low, std::int32_t high, std::span<const SideFrom> sides) {
        ++edges;
        for (const SideFrom& s : sides) found.emplace_back(low, s.larger(), s.triangle, s.forward());
        for (const SideFrom& s : sides) EXPECT_EQ(s.larger(), high);
      },
      least);
  const std::vector<Side> all = sorted_sides(triangles);
  // A triangle may have an edge twice, there and back.
  std::sort(found.begin(), found.end());
  std::vector<Side> expected = all;
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(found, expected);
  std::size_t different = 0;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (k == 0 || std::get<0>(all[k]) != std::get<0>(all[k - 1]) || std::get<1>(all[k]) != std::get<1>(all[k - 1]))
      ++different;
  EXPECT_EQ(edges, different);
}

TEST(BySmallest, EdgesOfManyPasses) {
  for (const std::size_t least : {std::size_t{1}, std::size_t{100}, carreau::entries_at_once})
    expect_all_sides(random_triangles(5000, 700), 700, least);
}

TEST(BySmallest, AVertexWithMoreThanIsHeldAtOnce) {
  std::vector<Triangle> fan;
  for (std::int32_t v = 1; v < 400; ++v) fan.push_back({0, v, v + 1});
  expect_all_sides(fan, 401, 10);
}

TEST(BySmallest, VerticesAreInOrderAndNoneIsLeftOut) {
  std::vector<std::int32_t> seen;
  carreau::by_smallest_vertex<int>(
      10,
      [](const auto& put) {
        for (const int v : {9, 3, 3, 0, 9}) put(v, 10 * v);
      },
      [&](std::int32_t v, std::span<int> entries) {
        for (const int each : entries) EXPECT_EQ(each, 10 * v);
        seen.insert(seen.end(), entries.size(), v);
      },
      2);
  EXPECT_EQ(seen, (std::vector<std::int32_t>{0, 3, 3, 9, 9}));
}

// The largest number of a vertex, twice of which no signed number holds.
TEST(BySmallest, SidesOfTheLastVertexThere) {
  const SideFrom side{2 * 2147483647U + 1, 4294967295U};
  EXPECT_EQ(side.larger(), 2147483647);
  EXPECT_TRUE(side.forward());
}

}  // namespace
