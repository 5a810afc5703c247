// SPDX-License-Identifier: BSD-3-Clause
// Faces whose triangles cannot cross each other, and triangles near triangles of other sets.
#include "mesh/crossings/face_graphs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <vector>

#include "mesh/crossings/intersections.h"
#include "mesh/crossings/shared_cells.h"

namespace carreau {
namespace {

/// Faces of n x m squares cut in two. Vertices on borders come first.
struct Faces {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> first{0};
  std::int32_t on_curves = 0;

  void add(int n, int m, const std::vector<std::function<Vec3(double, double)>>& faces) {
    const auto is_border = [&](int i, int j) { return i == 0 || j == 0 || i == n || j == m; };
    std::vector<std::vector<std::int32_t>> number(faces.size(), std::vector<std::int32_t>((n + 1) * (m + 1)));
    for (const bool border : {true, false})
      for (std::size_t f = 0; f < faces.size(); ++f)
        for (int i = 0; i <= n; ++i)
          for (int j = 0; j <= m; ++j) {
            if (is_border(i, j) != border) continue;
            number[f][i * (m + 1) + j] = static_cast<std::int32_t>(vertices.size());
            vertices.push_back(faces[f](double(i) / n, double(j) / m));
            if (border) on_curves = static_cast<std::int32_t>(vertices.size());
          }
    for (std::size_t f = 0; f < faces.size(); ++f) {
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j) {
          const auto at = [&](int k, int l) { return number[f][(i + k) * (m + 1) + j + l]; };
          triangles.push_back({at(0, 0), at(1, 0), at(1, 1)}), triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
        }
      first.push_back(static_cast<std::int32_t>(triangles.size()));
    }
  }
  [[nodiscard]] std::array<Vec3, 3> corners(std::size_t t) const {
    return {vertices[triangles[t][0]], vertices[triangles[t][1]], vertices[triangles[t][2]]};
  }
  [[nodiscard]] std::vector<std::int32_t> graphs(int threads = 1) const {
    std::vector<TriangleView> views;
    for (std::size_t t = 0; t < triangles.size(); ++t) views.push_back(view_of(corners(t)[0], corners(t)[1], corners(t)[2]));
    std::vector<std::int32_t> graph(triangles.size(), -1);
    Monitor monitor;
    find_face_graphs(vertices, triangles, views, {first, on_curves}, graph, threads, monitor);
    return graph;
  }
};

Vec3 wave(double u, double v) { return {u, v, 0.2 * std::sin(3 * u + 2 * v)}; }

TEST(FaceGraphs, HoldFacesOverAPlane) {
  Faces faces;
  faces.add(20, 30, {wave, [](double u, double v) -> Vec3 { return {u, std::sin(v), std::cos(v)}; },
                     [](double u, double v) -> Vec3 { return {v, u, 2}; }});
  const std::vector<std::int32_t> graph = faces.graphs();
  for (std::size_t f = 0; f < 3; ++f)
    for (std::int32_t t = faces.first[f]; t < faces.first[f + 1]; ++t) EXPECT_EQ(graph[t], static_cast<std::int32_t>(f));
  EXPECT_EQ(graph, faces.graphs(3));
}

TEST(FaceGraphs, LeaveOutTheRimThatTurnsAway) {
  Faces faces;  // a little more than a right angle: the best axis does not see the last row of one side
  faces.add(20, 60, {[](double u, double v) -> Vec3 { return {u, std::sin(0.3 + 1.3 * v), std::cos(0.3 + 1.3 * v)}; }});
  const std::vector<std::int32_t> graph = faces.graphs();
  const auto left = std::count(graph.begin(), graph.end(), -1);
  EXPECT_LT(left, 150);
  EXPECT_GT(std::count(graph.begin(), graph.end(), 0), 2000);
}

TEST(FaceGraphs, RejectFacesThatCoverAPlaceTwice) {
  const auto none = [](const std::function<Vec3(double, double)>& at) {
    Faces faces;
    faces.add(40, 60, {at});
    const std::vector<std::int32_t> graph = faces.graphs();
    return std::all_of(graph.begin(), graph.end(), [](std::int32_t g) { return g < 0; });
  };
  // One and a half turns of a spiral ramp; a closed sphere; a disc that goes round twice.
  EXPECT_TRUE(none([](double u, double v) -> Vec3 { return {(1 + u) * std::cos(9 * v), (1 + u) * std::sin(9 * v), v}; }));
  EXPECT_TRUE(none([](double u, double v) -> Vec3 {
    const double s = 0.1 + 2.9 * u, t = 6.2 * v;
    return {std::sin(s) * std::cos(t), std::sin(s) * std::sin(t), std::cos(s)};
  }));
  EXPECT_TRUE(none([](double u, double v) -> Vec3 { return {(1 + u) * std::cos(12 * v), (1 + u) * std::sin(12 * v), 0}; }));
}

TEST(FaceGraphs, RejectFacesWithAHoleOrADoubledTriangle) {
  Faces whole;
  whole.add(20, 30, {wave});
  Faces hole = whole;  // the triangles round an inner vertex do not close
  hole.triangles.erase(hole.triangles.begin() + 611), --hole.first.back();
  Faces twice = whole;
  twice.triangles.push_back(twice.triangles[611]), ++twice.first.back();
  for (const Faces& faces : {hole, twice}) {
    const std::vector<std::int32_t> graph = faces.graphs();
    EXPECT_TRUE(std::all_of(graph.begin(), graph.end(), [](std::int32_t g) { return g < 0; }));
  }
}

// Faces of random waves through each other: no face crosses itself, and all pairs are found with and without faces.
TEST(FaceGraphs, CrossingsDoNotDependOnFaces) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int round = 0; round < 4; ++round) {
    std::vector<std::function<Vec3(double, double)>> shapes;
    for (int f = 0; f < 4; ++f) {
      const double a = number(random), b = number(random), c = number(random), d = number(random);
      const int axis = f % 3;
      shapes.emplace_back([=](double u, double v) {
        Vec3 p;
        p[axis] = 0.5 + 0.3 * a * std::sin(4 * u + b) + 0.3 * c * std::cos(4 * v + d);
        p[(axis + 1) % 3] = u, p[(axis + 2) % 3] = v;
        return p;
      });
    }
    Faces faces;
    faces.add(24, 24, shapes);
    const std::vector<std::int32_t> graph = faces.graphs();
    EXPECT_GT(std::count_if(graph.begin(), graph.end(), [](std::int32_t g) { return g >= 0; }), 1000);
    Monitor monitor;
    const Intersections with = find_intersections(faces.vertices, faces.triangles, 100000, {nullptr, 2}, monitor, {faces.first, faces.on_curves});
    const Intersections without = find_intersections(faces.vertices, faces.triangles, {.limit = 100000}, monitor);
    EXPECT_GT(with.count, 0);
    ASSERT_EQ(with.count, without.count);
    for (std::size_t k = 0; k < with.pairs.size(); ++k) {
      EXPECT_EQ(with.pairs[k].triangles, without.pairs[k].triangles);
      EXPECT_NE(graph[with.pairs[k].triangles[0]], graph[with.pairs[k].triangles[1]]);
    }
  }
}

// Each pair of boxes of different sets that meet is kept; most triangles inside large sets are not.
TEST(NearOtherSets, KeepsAllPairsOfDifferentSets) {
  Faces faces;
  faces.add(60, 60, {wave, [](double u, double v) -> Vec3 { return {u, 0.5 + 0.01 * v, v - 0.5}; }});
  std::vector<std::int32_t> set(faces.triangles.size()), numbers(faces.triangles.size());
  for (std::size_t t = 0; t < set.size(); ++t) set[t] = static_cast<std::int32_t>(t) < faces.first[1] ? 0 : 1;
  set[17] = -1;  // alone
  std::iota(numbers.begin(), numbers.end(), 0);
  Monitor monitor;
  const std::vector<std::int32_t> kept = near_other_sets(faces.vertices, faces.triangles, numbers, set, 1, monitor);
  EXPECT_EQ(kept, near_other_sets(faces.vertices, faces.triangles, numbers, set, 3, monitor));
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  EXPECT_LT(kept.size(), set.size() / 2);
  const auto box = [&](std::size_t t) {
    Vec3 low = faces.corners(t)[0], high = low;
    for (const Vec3& p : faces.corners(t)) low = low.cwiseMin(p), high = high.cwiseMax(p);
    return std::pair{low, high};
  };
  const auto meet = [&](std::size_t s, std::size_t t) {
    const auto [a, b] = box(s);
    const auto [c, d] = box(t);
    return (a.array() <= d.array()).all() && (c.array() <= b.array()).all();
  };
  for (std::size_t s = 0; s < set.size(); ++s)
    for (std::size_t t = s + 1; t < set.size(); ++t)
      if ((set[s] != set[t] || set[s] < 0) && meet(s, t)) {
        for (const std::size_t each : {s, t})
          EXPECT_TRUE(std::binary_search(kept.begin(), kept.end(), static_cast<std::int32_t>(each)));
      }
}

}  // namespace
}  // namespace carreau
