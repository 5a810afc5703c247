// SPDX-License-Identifier: BSD-3-Clause
// Sets of triangles that cannot cross: their guarantee, their detection, and the detection of crossings beside them.
#include "mesh/crossings/graphs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <utility>

#include "mesh/crossings/intersections.h"
#include "mesh/crossings/outline.h"
#include "mesh/crossings/spatial_order.h"

namespace carreau {
namespace {

using Indices = std::array<std::int32_t, 3>;

struct Sheet {
  std::vector<Vec3> vertices;
  std::vector<Indices> triangles;
  [[nodiscard]] std::array<Vec3, 3> corners(std::size_t t) const {
    const auto at = [&](int k) {
      return vertices[static_cast<std::size_t>(triangles[t][static_cast<std::size_t>(k)])];
    };
    return {at(0), at(1), at(2)};
  }
};

/// The image of [0, 1]^2, n x m squares cut in two.
Sheet sheet_of(int n, int m, const std::function<Vec3(double, double)>& at) {
  Sheet sheet;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= m; ++j) sheet.vertices.push_back(at(double(i) / n, double(j) / m));
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const int a = i * (m + 1) + j, b = a + m + 1;
      sheet.triangles.push_back({a, b, b + 1}), sheet.triangles.push_back({a, b + 1, a + 1});
    }
  return sheet;
}

std::vector<std::int32_t> graphs_of(const Sheet& sheet, int threads = 1) {
  Monitor monitor;
  std::vector<std::int32_t> order(sheet.triangles.size());
  std::iota(order.begin(), order.end(), 0);
  order = spatial_order(sheet.vertices, sheet.triangles, std::move(order), monitor, threads);
  std::vector<TriangleView> views;
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
    const auto [a, b, c] = sheet.corners(t);
    views.push_back(view_of(a, b, c));
  }
  return find_graphs(sheet.vertices, sheet.triangles, views, order, threads, monitor);
}

double share_in_graphs(const std::vector<std::int32_t>& graph) {
  return static_cast<double>(std::count_if(graph.begin(), graph.end(), [](std::int32_t g) { return g >= 0; })) /
         static_cast<double>(graph.size());
}

std::set<std::pair<std::int32_t, std::int32_t>> crossings_one_by_one(const Sheet& sheet) {
  std::set<std::pair<std::int32_t, std::int32_t>> pairs;
  for (std::size_t s = 0; s < sheet.triangles.size(); ++s)
    for (std::size_t t = s + 1; t < sheet.triangles.size(); ++t)
      if (triangles_intersect(sheet.corners(s), sheet.corners(t), nullptr))
        pairs.emplace(static_cast<std::int32_t>(s), static_cast<std::int32_t>(t));
  return pairs;
}

void expect_all_crossings(const Sheet& sheet, bool some) {
  const auto expected = crossings_one_by_one(sheet);
  EXPECT_EQ(!expected.empty(), some);
  const std::vector<std::int32_t> graph = graphs_of(sheet);
  for (const auto& [s, t] : expected)
    EXPECT_TRUE(graph[static_cast<std::size_t>(s)] < 0 ||
                graph[static_cast<std::size_t>(s)] != graph[static_cast<std::size_t>(t)]);
  Monitor monitor;
  const Intersections found = find_intersections(sheet.vertices, sheet.triangles, {.limit = 100000}, monitor);
  ASSERT_EQ(found.count, static_cast<std::int64_t>(expected.size()));
  std::set<std::pair<std::int32_t, std::int32_t>> pairs;
  for (const TriangleIntersection& each : found.pairs) pairs.emplace(each.triangles[0], each.triangles[1]);
  EXPECT_TRUE(pairs == expected);
}

TEST(Graphs, HoldAWholeSheetOverAPlane) {
  for (int axis = 0; axis < 3; ++axis)
    for (const int sign : {1, -1}) {
      const Sheet sheet = sheet_of(20, 30, [&](double u, double v) {
        Vec3 p;
        p[axis] = 0.2 * std::sin(3 * u + 2 * v), p[(axis + 1) % 3] = u, p[(axis + 2) % 3] = sign * v;
        return p;
      });
      const std::vector<std::int32_t> graph = graphs_of(sheet);
      EXPECT_TRUE(std::all_of(graph.begin(), graph.end(), [&](std::int32_t g) { return g == 0; })) << axis << sign;
    }
}

TEST(Graphs, HoldNearlyAllOfASphereAndATorus) {
  const auto turned = [](double t) { return 2 * std::numbers::pi * t; };
  const Sheet sphere = sheet_of(60, 40, [&](double u, double v) -> Vec3 {
    const double s = std::numbers::pi * (0.02 + 0.96 * v);
    return {std::sin(s) * std::cos(turned(0.98 * u)), std::sin(s) * std::sin(turned(0.98 * u)), std::cos(s)};
  });
  const Sheet torus = sheet_of(100, 40, [&](double u, double v) -> Vec3 {
    const double r = 2 + 0.7 * std::cos(turned(v));
    return {r * std::cos(turned(0.98 * u)), r * std::sin(turned(0.98 * u)), 0.7 * std::sin(turned(v))};
  });
  EXPECT_GT(share_in_graphs(graphs_of(sphere)), 0.9);
  EXPECT_GT(share_in_graphs(graphs_of(torus)), 0.9);
  expect_all_crossings(sphere, false);
  EXPECT_TRUE(graphs_of(torus) == graphs_of(torus, 3));
}

// All is turned alike, but the plane is covered twice: sheets of a spiral stair that cross each other.
TEST(Graphs, DoNotHoldAStairThatGoesRoundTwice) {
  const Sheet stair = sheet_of(60, 6, [](double u, double v) -> Vec3 {
    const double angle = 4 * std::numbers::pi * u + 0.1, r = 1 + v + 0.1 * u;
    return {r * std::cos(angle), r * std::sin(angle), 0.1 * std::sin(2 * std::numbers::pi * u + 0.5)};
  });
  expect_all_crossings(stair, true);
}

// A fan whose triangles go round its middle twice: turned alike, too, its line round it simple but for the middle.
TEST(Graphs, DoNotHoldAFanThatGoesRoundTwice) {
  Sheet fan;
  fan.vertices.emplace_back(0, 0, 0);
  constexpr int n = 60;
  for (int k = 0; k < n; ++k) {
    const double angle = 4 * std::numbers::pi * k / n, r = 1 + 0.3 * std::cos(angle / 2);
    fan.vertices.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.2 * std::sin(angle / 2));
  }
  for (int k = 0; k < n; ++k) fan.triangles.push_back({0, k + 1, (k + 1) % n + 1});
  expect_all_crossings(fan, true);
}

TEST(Graphs, WrinkledSheetsHideNoCrossing) {
  std::mt19937 random(7);
  for (const double wrinkle : {0.004, 0.02, 0.2}) {
    std::uniform_real_distribution<double> shift(-wrinkle, wrinkle);
    const Sheet sheet = sheet_of(24, 24, [&](double u, double v) -> Vec3 {
      return {u + shift(random), v + shift(random), shift(random)};
    });
    expect_all_crossings(sheet, wrinkle > 0.01);
  }
}

OutlineEdge edge(std::int32_t from, std::int32_t to, const std::vector<Vec2>& at) {
  return {from, to, at[static_cast<std::size_t>(from)], at[static_cast<std::size_t>(to)]};
}

/// Closed lines through points of whole numbers, each a range of them.
bool goes_round(const std::vector<Vec2>& at, const std::vector<std::pair<int, int>>& lines) {
  std::vector<OutlineEdge> edges;
  for (const auto& [first, last] : lines)
    for (int k = first; k <= last; ++k) edges.push_back(edge(k, k == last ? first : k + 1, at));
  EXPECT_TRUE(pinched_vertices(edges).empty());
  return goes_round_once(edges);
}

TEST(Outlines, AreDecidedExactly) {
  const std::vector<Vec2> square{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  const auto with = [&](std::vector<Vec2> more) {
    std::vector<Vec2> all = square;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  EXPECT_TRUE(goes_round(square, {{0, 3}}));
  EXPECT_FALSE(goes_round({{0, 0}, {0, 4}, {4, 4}, {4, 0}}, {{0, 3}}));                 // clockwise
  EXPECT_TRUE(goes_round(with({{1, 1}, {1, 2}, {2, 2}}), {{0, 3}, {4, 6}}));            // a hole
  EXPECT_FALSE(goes_round(with({{1, 1}, {2, 2}, {1, 2}}), {{0, 3}, {4, 6}}));           // covered twice
  EXPECT_FALSE(goes_round(with({{6, 1}, {7, 1}, {7, 2}}), {{0, 3}, {4, 6}}));           // two sheets
  EXPECT_FALSE(goes_round(with({{4, 2}, {1, 1}, {1, 3}}), {{0, 3}, {4, 6}}));           // a hole that touches a side
  EXPECT_FALSE(goes_round(with({{0, 0}, {1, 3}, {3, 1}}), {{0, 3}, {4, 6}}));           // another vertex at one place
  EXPECT_TRUE(goes_round({{0, 0}, {2, 0}, {4, 0}, {4, 4}, {2, 4}, {0, 4}}, {{0, 5}}));  // sides in line
  EXPECT_FALSE(goes_round({{0, 0}, {4, 0}, {2, 0}, {4, 4}}, {{0, 3}}));                 // back along a side
  EXPECT_FALSE(goes_round({{0, 0}, {4, 4}, {4, 0}, {0, 4}}, {{0, 3}}));                 // an eight
}

TEST(Outlines, DetectPinchedVertices) {
  const std::vector<Vec2> at{{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  std::vector<OutlineEdge> edges{edge(0, 1, at), edge(1, 2, at), edge(2, 0, at),
                                 edge(0, 3, at), edge(3, 4, at), edge(4, 0, at)};
  EXPECT_TRUE(pinched_vertices(edges) == std::vector<std::int32_t>{0});
}

}  // namespace
}  // namespace carreau
