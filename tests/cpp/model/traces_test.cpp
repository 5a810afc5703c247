// SPDX-License-Identifier: BSD-3-Clause
#include "model/traces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/infinity.h"
#include "support/segment.h"

namespace carreau {
namespace {

// A curve that winds back on itself, so that the nearest segment jumps; shaken by up to `noise`.
std::vector<Vec3> winding(int points, double noise, bool backwards, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shake(-noise, noise);
  std::vector<Vec3> trace;
  for (int i = 0; i < points; ++i) {
    const double t = 12.0 * i / (points - 1);
    trace.push_back({std::cos(t) * (1 + 0.01 * t) + shake(random), std::sin(t) + shake(random), shake(random)});
  }
  if (backwards) std::reverse(trace.begin(), trace.end());
  return trace;
}

double by_all_pairs(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  double worst = 0;
  for (const Vec3& p : from) {
    double best = infinity;
    for (std::size_t i = 1; i < to.size(); ++i) best = std::min(best, squared_distance_to_segment(p, to[i - 1], to[i]));
    worst = std::max(worst, std::sqrt(best));
  }
  return worst;
}

TEST(HausdorffDistance, MatchesAllPairs) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const auto p = winding(80 + static_cast<int>(seed), 1e-3, false, seed),
               q = winding(47, 1e-2, seed % 2 == 1, seed + 99);
    const double exact = std::max(by_all_pairs(p, q), by_all_pairs(q, p));
    EXPECT_EQ(hausdorff_distance(p, q, infinity), exact);
    EXPECT_EQ(hausdorff_distance(p, q, exact), exact);
    EXPECT_GT(hausdorff_distance(p, q, 0.9 * exact), 0.9 * exact);
    EXPECT_EQ(hausdorff_distance(p, q, infinity, 0.9 * exact), exact);
    EXPECT_EQ(hausdorff_distance(p, q, infinity, 1.1 * exact), 1.1 * exact);
  }
}

}  // namespace
}  // namespace carreau
