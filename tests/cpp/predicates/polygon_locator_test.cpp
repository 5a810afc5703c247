// SPDX-License-Identifier: BSD-3-Clause
#include "predicates/polygon_locator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <set>

#include "predicates/predicates.h"
#include "support/infinity.h"

namespace carreau {
namespace {

using Edges = std::vector<std::pair<int, int>>;

struct Polygon {
  std::vector<Vec2> vertices;
  Edges edges;

  void add_loop(const std::vector<Vec2>& loop) {
    const int first = static_cast<int>(vertices.size()), n = static_cast<int>(loop.size());
    vertices.insert(vertices.end(), loop.begin(), loop.end());
    for (int i = 0; i < n; ++i) edges.emplace_back(first + i, first + (i + 1) % n);
  }
};

/// Star-shaped about `centre`: radii drawn between r0 and r1, counterclockwise.
std::vector<Vec2> star(int n, Vec2 centre, double r0, double r1, std::mt19937_64& random) {
  std::uniform_real_distribution<double> radius(r0, r1);
  std::vector<Vec2> loop;
  for (int i = 0; i < n; ++i) {
    const double t = 6.283185307179586 * i / n, r = radius(random);
    loop.push_back({centre.x() + r * std::cos(t), centre.y() + r * std::sin(t)});
  }
  return loop;
}

/// Even-odd rule by the definition, every edge against a ray to the right, in exact signs: 1 inside, 0 on, -1 outside.
int position(const Polygon& polygon, Vec2 p) {
  bool inside = false;
  for (const auto& [i, j] : polygon.edges) {
    Vec2 a = polygon.vertices[i], b = polygon.vertices[j];
    if (a.y() > b.y()) std::swap(a, b);
    const int s = orientation(a, b, p);
    if (s == 0 && p.y() >= a.y() && p.y() <= b.y() && p.x() >= std::min(a.x(), b.x()) &&
        p.x() <= std::max(a.x(), b.x()))
      return 0;
    if (a.y() <= p.y() && p.y() < b.y() && s > 0) inside = !inside;
  }
  return inside ? 1 : -1;
}

TEST(PolygonLocator, AgreesWithTheDefinitionOnDegenerateIntegerPolygons) {
  // Self-crossing loops on a small lattice: points on edges, vertices on rays, overlapping edges everywhere.
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 400; ++trial) {
    const int size = 3 + trial % 12;
    const auto coordinate = [&] { return static_cast<double>(random() % static_cast<unsigned>(size)); };
    Polygon polygon;
    for (int loop = 0; loop <= trial % 3; ++loop) {
      std::vector<Vec2> points;
      for (int i = 0; i < 3 + trial % 40; ++i) points.push_back({coordinate(), coordinate()});
      polygon.add_loop(points);
    }
    std::shuffle(polygon.edges.begin(), polygon.edges.end(), random);
    const PolygonLocator locator(polygon.vertices, polygon.edges);
    for (int i = -2; i <= 2 * size; ++i)
      for (int j = -2; j <= 2 * size; ++j) {
        const Vec2 p{0.5 * i, 0.5 * j};
        ASSERT_EQ(locator.contains(p), position(polygon, p) >= 0) << trial << ' ' << p.x() << ' ' << p.y();
      }
  }
}

TEST(PolygonLocator, AgreesWithTheDefinitionOnAStarWithHolesAndIslands) {
  std::mt19937_64 random(2);
  Polygon polygon;
  polygon.add_loop(star(3000, {0, 0}, 9, 10, random));
  polygon.add_loop(star(500, {-3, 1}, 2, 3, random));
  polygon.add_loop(star(700, {-3, 1}, 1e-3, 1, random));  // an island in the hole
  polygon.add_loop(star(2000, {4, 0}, 1e-6, 2e-6, random));
  const PolygonLocator locator(polygon.vertices, polygon.edges);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 3000; ++i) {
    const double w = unit(random);
    const auto& [a, b] = polygon.edges[random() % polygon.edges.size()];
    for (const Vec2& p :
         {Vec2{11 * unit(random), 11 * unit(random)}, Vec2{4 + 2e-6 * unit(random), 2e-6 * unit(random)},
          lerp(polygon.vertices[a], polygon.vertices[b], w), Vec2{polygon.vertices[a].x(), polygon.vertices[b].y()},
          polygon.vertices[a]})
      ASSERT_EQ(locator.contains(p), position(polygon, p) >= 0) << p.x() << ' ' << p.y();
  }
  EXPECT_TRUE(locator.contains({0, 0}));
  EXPECT_FALSE(locator.contains({-3, 2.5}));
  EXPECT_TRUE(locator.contains({-3, 1}));
  EXPECT_FALSE(locator.contains({4, 0}));
  EXPECT_FALSE(locator.contains({11, 0}));
  EXPECT_FALSE(locator.contains({std::numeric_limits<double>::quiet_NaN(), 0}));
  EXPECT_FALSE(locator.contains({0, infinity}));
}

TEST(PolygonLocator, KnowsTheInsideOfEveryEdgeWhateverItsDirection) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 60; ++trial) {
    Polygon polygon;
    const int n = 3 + 7 * trial;
    polygon.add_loop(star(n, {0, 0}, 9, 10, random));
    std::vector<Vec2> hole = star(n + 1, {0, 0}, 1, 4, random);
    std::reverse(hole.begin(), hole.end());
    polygon.add_loop(hole);
    polygon.add_loop(star(5, {0, 0}, 0.25, 0.5, random));
    std::vector<char> reversed(polygon.edges.size());
    for (std::size_t e = 0; e < polygon.edges.size(); ++e) {
      reversed[e] = static_cast<char>(random() % 2);
      if (reversed[e] != 0) std::swap(polygon.edges[e].first, polygon.edges[e].second);
    }
    const PolygonLocator locator(polygon.vertices, polygon.edges);
    for (std::size_t e = 0; e < polygon.edges.size(); ++e)
      ASSERT_EQ(locator.inside_left_of(static_cast<int>(e)), reversed[e] == 0) << trial << ' ' << e;
  }
}

TEST(PolygonLocator, KnowsTheInsideOfEdgesOfALatticeOfSquares) {
  // Chessboards: horizontal and vertical edges, four to a vertex, all coordinates shared.
  const int n = 20;
  Polygon polygon;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      if ((i + j) % 2 != 0) continue;
      const double x = i, y = j;
      polygon.add_loop({{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}});
    }
  const PolygonLocator locator(polygon.vertices, polygon.edges);
  for (int e = 0; e < static_cast<int>(polygon.edges.size()); ++e) ASSERT_TRUE(locator.inside_left_of(e)) << e;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) ASSERT_EQ(locator.contains({i + 0.5, j + 0.5}), (i + j) % 2 == 0);
}

TEST(PolygonLocator, IsExactAtHugeTinyAndOffsetCoordinates) {
  std::mt19937_64 random(4);
  const auto on_lattice = [&] { return static_cast<double>(random() % 16); };
  std::vector<Vec2> loop;
  for (int i = 0; i < 40; ++i) loop.push_back({on_lattice(), on_lattice()});
  for (const double scale : {0x1p1019, 0x1p-1074, 0x1p-500, 1.0})
    for (const Vec2& offset : {Vec2{0, 0}, Vec2{0x1p50, -0x1p49}}) {
      if (scale == 0x1p1019 && offset.x() != 0) continue;
      Polygon polygon, moved;
      polygon.add_loop(loop);
      std::vector<Vec2> image;
      for (const Vec2& p : loop) image.push_back(scale * (p + offset));
      moved.add_loop(image);
      const PolygonLocator locator(moved.vertices, moved.edges);
      for (int i = 0; i < 16; ++i)
        for (int j = 0; j < 16; ++j) {
          const Vec2 p{static_cast<double>(i), static_cast<double>(j)};
          ASSERT_EQ(locator.contains(scale * (p + offset)), position(polygon, p) >= 0) << scale << ' ' << i << ' ' << j;
        }
    }
}

TEST(PolygonLocator, TakesDegenerateInput) {
  EXPECT_FALSE(PolygonLocator({}, {}).contains({0, 0}));
  const std::vector<Vec2> vertices{{0, 0}, {1, 1}, {0, 0}};
  const Edges flat{{0, 1}, {1, 2}, {2, 0}};  // there and back, and an edge without length
  const PolygonLocator locator(vertices, flat);
  EXPECT_TRUE(locator.contains({0.5, 0.5}));
  EXPECT_FALSE(locator.contains({0.5, 0.25}));
  EXPECT_FALSE(locator.inside_left_of(2));
  EXPECT_EQ(locator.edge_through({0.5, 0.5}), 0);
  EXPECT_EQ(locator.edge_through({0.5, std::nextafter(0.5, 1)}), -1);
}

TEST(EdgeGrid, ListsEveryEdgeInEveryCellThatItMeets) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 30; ++trial) {
    Polygon polygon;
    std::vector<Vec2> loop;
    for (int i = 0; i < 50 + trial; ++i)
      loop.push_back({static_cast<double>(random() % 64), static_cast<double>(random() % 64)});
    polygon.add_loop(loop);
    const EdgeGrid grid(polygon.vertices, polygon.edges);
    for (int row = 0; row < grid.rows(); ++row)
      for (int column = 0; column < grid.columns(); ++column) {
        const auto list = grid.edges_in(column, row);
        const std::set<int> listed(list.begin(), list.end());
        EXPECT_EQ(listed.size(), list.size());
        const Vec2 low{grid.x(column), grid.y(row)}, high{grid.x(column + 1), grid.y(row + 1)};
        for (int e = 0; e < static_cast<int>(polygon.edges.size()); ++e) {
          // Separating axes: the two of the box and the edge's normal.
          const Vec2 a = polygon.vertices[polygon.edges[e].first], b = polygon.vertices[polygon.edges[e].second];
          if (std::max(a.x(), b.x()) < low.x() || std::min(a.x(), b.x()) > high.x() ||
              std::max(a.y(), b.y()) < low.y() || std::min(a.y(), b.y()) > high.y())
            continue;
          const int s0 = orientation(a, b, low), s1 = orientation(a, b, high),
                    s2 = orientation(a, b, {low.x(), high.y()}), s3 = orientation(a, b, {high.x(), low.y()});
          if (s0 == s1 && s1 == s2 && s2 == s3 && s0 != 0) continue;
          ASSERT_EQ(listed.count(e), 1U) << e;
        }
      }
  }
}

}  // namespace
}  // namespace carreau
