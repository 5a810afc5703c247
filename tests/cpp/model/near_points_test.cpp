// SPDX-License-Identifier: BSD-3-Clause
#include "model/near_points.h"

#include <gtest/gtest.h>

#include <random>

namespace carreau {
namespace {

std::vector<std::size_t> sets_of(const std::vector<Vec3>& points, double eps) {
  UnionFind sets(points.size());
  merge_near_points(points, eps, sets);
  std::vector<std::size_t> representative;
  for (std::size_t i = 0; i < points.size(); ++i) representative.push_back(sets.find(i));
  return representative;
}

TEST(MergeNearPoints, AgreesWithComparingAllPairs) {
  std::mt19937 random(7);
  for (const double centre : {0.0, -3e5})
    for (const double eps : {0.01, 0.05, 0.11, 0.4}) {
      std::uniform_real_distribution<double> coordinate(-1, 1);
      std::vector<Vec3> points;
      for (int i = 0; i < 400; ++i)
        points.push_back({centre + coordinate(random), coordinate(random), coordinate(random)});
      UnionFind all(points.size());
      for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          if (norm(points[i] - points[j]) < eps) all.merge(i, j);
      const std::vector<std::size_t> found = sets_of(points, eps);
      for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(found[i], all.find(i));
    }
}

TEST(MergeNearPoints, IsStrictAndGoesOnFromPointToPoint) {
  EXPECT_EQ(sets_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 1), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(sets_of({{2, 0, 0}, {0, 0, 0}, {1, 0, 0}}, 1.001), (std::vector<std::size_t>{0, 0, 0}));
}

TEST(MergeNearPoints, WorksWhereCoordinatesAreHugeAgainstTheTolerance) {
  const double far = 1e300;
  EXPECT_EQ(sets_of({{far, 0, 0}, {far, 0, 0}, {-far, 0, 0}, {far, 1, 0}}, 1e-9),
            (std::vector<std::size_t>{0, 0, 2, 3}));
}

TEST(MergeNearPoints, DoesNotComparePairsOfAClump) {
  // 200 000 points, half of them at one place: all pairs would be 2e10.
  std::vector<Vec3> points(200'000);
  for (std::size_t i = 0; i < points.size(); i += 2) points[i] = {static_cast<double>(i), 0, 0};
  const std::vector<std::size_t> found = sets_of(points, 0.5);
  EXPECT_EQ(found[199'999], 0U);
  EXPECT_EQ(found[199'998], 199'998U);
}

}  // namespace
}  // namespace carreau
