// SPDX-License-Identifier: BSD-3-Clause
// Sizes that grow from edges of space.
#include "gradation/edge_sizes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "support/segment.h"

namespace carreau {
namespace {

std::vector<EdgeSizes::Source> random_edges(int n, std::mt19937& random) {
  std::uniform_real_distribution<double> place(-1, 1), step(-0.1, 0.1), size(0.01, 0.2);
  std::vector<EdgeSizes::Source> edges;
  for (int k = 0; k < n; ++k) {
    const Vec3 a{place(random), place(random), 0.1 * place(random)};
    edges.push_back({a, a + Vec3{step(random), step(random), step(random)}, size(random)});
  }
  return edges;
}

TEST(EdgeSizes, AreTheLeastOfAllEdges) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  for (const int n : {1, 2, 3, 5, 17, 300}) {
    const auto edges = random_edges(n, random);
    const EdgeSizes sizes(edges, 0.4);
    for (int k = 0; k < 300; ++k) {
      const Vec3 p{place(random), place(random), place(random)};
      double least = 0.35;
      for (const auto& e : edges) least = std::min(least, e.h + 0.4 * distance_to_segment(p, e.a, e.b));
      EXPECT_EQ(sizes.at(p, 0.35), least);
    }
  }
}

TEST(EdgeSizes, WithoutEdgesBoundNothing) {
  EXPECT_TRUE(EdgeSizes().empty());
  EXPECT_EQ(EdgeSizes({}, 0.4).at({1, 2, 3}, 7), 7);
}

TEST(EdgeSizes, EqualEdgesKeepTheirSize) {
  const EdgeSizes sizes(std::vector<EdgeSizes::Source>(1000, {{0, 0, 0}, {1, 0, 0}, 0.5}), 2);
  EXPECT_EQ(sizes.at({0.5, 0, 0}), 0.5);
  EXPECT_EQ(sizes.at({3, 0, 0}), 4.5);
}

// Area over the area of triangles, ring by ring.
TEST(EdgeSizes, TrianglesOfGrowthAreTheIntegral) {
  const double h = 0.01, slope = 0.4, extent = 30, length = 0.02;
  double sum = 0;
  constexpr int rings = 2'000'000;
  for (int k = 0; k < rings; ++k) {
    const double r = extent * (k + 0.5) / rings, size = h + slope * r;
    sum += (2 * std::numbers::pi * r + 2 * length) / (std::numbers::sqrt3 / 4 * size * size) * extent / rings;
  }
  const EdgeSizes one({{{0, 0, 0}, {length, 0, 0}, h}}, slope);
  EXPECT_NEAR(one.triangles_within(extent), sum, 1e-4 * sum);
  EXPECT_EQ(EdgeSizes().triangles_within(extent), 0);
}

TEST(EdgeSizes, BoundedBelowGrowFromThere) {
  const EdgeSizes sizes({{{0, 0, 0}, {1, 0, 0}, 0.1}, {{5, 0, 0}, {6, 0, 0}, 0.7}}, 0.5);
  EXPECT_EQ(sizes.smallest(), 0.1);
  const EdgeSizes bounded = sizes.bounded_below(0.3);
  EXPECT_EQ(bounded.smallest(), 0.3);
  EXPECT_DOUBLE_EQ(bounded.at({0.5, 1, 0}), 0.8);
  EXPECT_DOUBLE_EQ(bounded.at({5.5, 0, 0}), 0.7);
}

}  // namespace
}  // namespace carreau
