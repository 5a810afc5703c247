// SPDX-License-Identifier: BSD-3-Clause
#include "surface/domain/near_vertices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace carreau {
namespace {

std::vector<int> visited(NearVertices& near, const Vec3& a, const Vec3& b, double reach) {
  std::vector<int> found;
  near.each_beside(a, b, reach, [&](int v) { return found.push_back(v), true; });
  std::sort(found.begin(), found.end());
  return found;
}

// All queries together visit at most 300 vertices a vertex. Along x, y and z in turn a straight line would need 740.
TEST(NearVertices, EveryEdgeOfALongStraightStripFindsItsNeighbours) {
  constexpr int n = 20'000;
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) points.push_back({1.0 * i, 0, 0});
  for (int i = 0; i < n; ++i) points.push_back({1.0 * i, 0.5, 0});
  NearVertices near(points);
  for (int i = 0; i + 1 < n; ++i) ASSERT_EQ(visited(near, points[i], points[i + 1], 0.6), (std::vector<int>{n + i, n + i + 1})) << i;
}

TEST(NearVertices, FindsWhatAComparisonOfAllFinds) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Vec3> points;
  for (int i = 0; i < 300; ++i) points.push_back({unit(random), unit(random), 0.1 * unit(random)});
  for (int i = 0; i < 20; ++i) points.push_back(points[static_cast<std::size_t>(i)]);  // equal points
  NearVertices near(points);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec3 a = points[i], b = points[i + 1];
    std::vector<int> all;
    for (std::size_t v = 0; v < points.size(); ++v)
      if (!(points[v] == a) && !(points[v] == b) && distance_to_segment(points[v], a, b) <= 0.1) all.push_back(static_cast<int>(v));
    EXPECT_EQ(visited(near, a, b, 0.1), all);
  }
}

}  // namespace
}  // namespace carreau
