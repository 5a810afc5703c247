// SPDX-License-Identifier: BSD-3-Clause
// Matchings beside the best ones, which are known for small graphs and paths.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "surface/elements/quads/matching.h"

namespace carreau {
namespace {

using Pairs = std::vector<WeightedPair>;

Pairs random_pairs(std::mt19937& random, int n) {
  std::uniform_real_distribution<double> weight(0.7, 1.7);
  std::uniform_int_distribution<int> any(0, n - 1);
  std::vector<int> degree(n, 0);
  Pairs pairs;
  for (int tries = 0; tries < 6 * n; ++tries) {
    const int a = any(random), b = any(random);
    const bool known = std::any_of(pairs.begin(), pairs.end(), [&](const WeightedPair& p) {
      return (p.triangles[0] == a && p.triangles[1] == b) || (p.triangles[0] == b && p.triangles[1] == a);
    });
    if (a == b || known || degree[a] == 3 || degree[b] == 3) continue;
    ++degree[a], ++degree[b];
    pairs.push_back({{a, b}, weight(random)});
  }
  return pairs;
}

/// The best matching among all sets of triangles: the first free one is left alone, or takes one of the others.
double best_of_all(const Pairs& pairs, int n) {
  std::vector<double> best(std::size_t{1} << n, 0);
  for (std::size_t set = 1; set < best.size(); ++set) {
    int first = 0;
    while ((set >> first & 1) == 0) ++first;
    best[set] = best[set & ~(std::size_t{1} << first)];
    for (const WeightedPair& p : pairs) {
      const std::size_t both = (std::size_t{1} << p.triangles[0]) | (std::size_t{1} << p.triangles[1]);
      if ((p.triangles[0] == first || p.triangles[1] == first) && (set & both) == both)
        best[set] = std::max(best[set], p.weight + best[set & ~both]);
    }
  }
  return best.back();
}

double weight_of(const Pairs& pairs, const std::vector<std::int32_t>& chosen, std::size_t n) {
  std::vector<int> used(n, 0);
  double sum = 0;
  for (const std::int32_t e : chosen) {
    for (const std::int32_t t : pairs[e].triangles) EXPECT_EQ(++used[t], 1);
    sum += pairs[e].weight;
  }
  return sum;
}

TEST(Matching, IsTheBestOneOfNearlyAllSmallGraphs) {
  std::mt19937 random(1);
  Monitor monitor;
  int best = 0;
  constexpr int graphs = 300, n = 14;
  for (int k = 0; k < graphs; ++k) {
    const Pairs pairs = random_pairs(random, n);
    const double optimum = best_of_all(pairs, n), found = weight_of(pairs, match(n, pairs, monitor), n);
    ASSERT_LE(found, optimum + 1e-12);
    EXPECT_GE(found, 0.97 * optimum) << k;
    best += found > optimum - 1e-9 ? 1 : 0;
  }
  EXPECT_GE(best, 285);
}

/// In a path of triangles the best sum is best[i] = max(best[i - 1], best[i - 2] + weight).
TEST(Matching, IsWithinTwoThousandthsOfTheBestOneOfLongPaths) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> weight(0.7, 1.7);
  constexpr int n = 20000;
  Pairs pairs;
  for (int t = 0; t + 1 < n; ++t) pairs.push_back({{t, t + 1}, weight(random)});
  std::vector<double> best(n + 1, 0);
  for (int i = 2; i <= n; ++i) best[i] = std::max(best[i - 1], best[i - 2] + pairs[i - 2].weight);
  Monitor monitor;
  const double found = weight_of(pairs, match(n, pairs, monitor), n);
  EXPECT_LE(found, best[n] + 1e-9);
  EXPECT_GE(found, 0.998 * best[n]);
}

/// A row of squares, each cut in two: diagonals weigh most.
TEST(Matching, FindsTheSquaresOfARow) {
  Pairs pairs;
  constexpr int squares = 1000;
  for (int k = 0; k < squares; ++k) {
    pairs.push_back({{2 * k, 2 * k + 1}, 1.7});
    if (k + 1 < squares) pairs.push_back({{2 * k + 1, 2 * k + 2}, 1.2});
  }
  Monitor monitor;
  const std::vector<std::int32_t> chosen = match(2 * squares, pairs, monitor);
  ASSERT_EQ(chosen.size(), std::size_t{squares});
  for (int k = 0; k < squares; ++k) EXPECT_EQ(pairs[chosen[k]].weight, 1.7);
}

TEST(Matching, StopsOnRequest) {
  std::mt19937 random(3);
  Pairs pairs;
  for (int t = 0; t + 1 < 100000; ++t) pairs.push_back({{t, t + 1}, 1 + 1e-6 * static_cast<double>(random() % 1000)});
  Monitor monitor;
  monitor.request_stop();
  EXPECT_THROW(match(100000, pairs, monitor), Cancelled);
}

}  // namespace
}  // namespace carreau
