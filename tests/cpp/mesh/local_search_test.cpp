// SPDX-License-Identifier: BSD-3-Clause
// Orders, budgets and ends of searches.
#include "mesh/local_search.h"

#include <gtest/gtest.h>

#include <cmath>

namespace carreau {
namespace {

using Items = std::vector<std::int32_t>;

/// A row of numbers that are bad above 0; a change takes 1 away and gives it to the next one on the left.
struct Row {
  std::vector<int> left;
  Items order;

  explicit Row(std::vector<int> of) : left(std::move(of)) {}
  Items run(const Items& first, Rings rings, Budget& budget) {
    Monitor monitor;
    return improve_ring_by_ring(
        first, rings, budget, monitor, [this](std::int32_t x) { return left[x] > 0; },
        [&](std::int32_t x) {
          if (x == 0) return false;
          order.push_back(x);
          budget.spend();
          --left[x], ++left[x - 1];
          return true;
        },
        [](std::int32_t x) {
          return Items{x, x - 1};
        });
  }
};

TEST(RingByRing, ChangesSpreadUntilNothingIsBadThatCanBeChanged) {
  Row row({0, 0, 0, 1});
  Budget budget(100);
  EXPECT_EQ(row.run({3}, {}, budget), Items{0});
  EXPECT_EQ(row.order, (Items{3, 2, 1}));
}

TEST(RingByRing, LooksAtARingAsItWasFoundOrInAscendingOrder) {
  Row found({0, 0, 1, 0, 1}), ascending = found;
  Budget budget(100);
  found.run({4, 2}, {}, budget);
  ascending.run({4, 2}, {.ascending = true}, budget);
  EXPECT_EQ(found.order, (Items{4, 2, 3, 2, 1, 1}));
  EXPECT_EQ(ascending.order, (Items{4, 2, 1, 3, 2, 1}));
}

TEST(RingByRing, EndsWithTheBudgetOrTheRingsAndReturnsTheRest) {
  Row row({0, 0, 0, 5});
  Budget budget(2);
  EXPECT_EQ(row.run({3}, {}, budget), (Items{2, 3}));
  EXPECT_TRUE(budget.is_spent());
  Row other({0, 0, 0, 5});
  Budget enough(100);
  EXPECT_EQ(other.run({3}, {.most = 1}, enough), Items{3}) << "what came to be bad in the last ring is not met";
}

TEST(InPasses, WorstFirstUntilAPassImprovesNothing) {
  std::vector<int> value{3, 1, 2};
  Items order;
  Monitor monitor;
  const auto list = [&] {
    Items bad;
    for (std::int32_t x = 0; x < 3; ++x)
      if (value[x] > 0) bad.push_back(x);
    std::sort(bad.begin(), bad.end(), [&](std::int32_t p, std::int32_t q) { return value[p] > value[q]; });
    return bad;
  };
  const auto improve = [&](std::int32_t x) { return order.push_back(x), --value[x], true; };
  EXPECT_TRUE(improve_in_passes(10, monitor, list, improve));
  EXPECT_EQ(order, (Items{0, 2, 1, 0, 2, 0}));
  EXPECT_FALSE(improve_in_passes(10, monitor, list, improve)) << "nothing is bad any more";
}

TEST(InPasses, AndSearchesStopOnRequest) {
  Monitor monitor;
  monitor.request_stop();
  const auto one = [] { return Items{0}; };
  EXPECT_THROW(improve_in_passes(1, monitor, one, [](std::int32_t) { return true; }), Cancelled);
}

TEST(Placements, AreAtTheirDistancesInTheMetric) {
  const Metric2 metric{4, 1, 9};
  int count = 0;
  double longest = 0, shortest = 1;
  for_placements(UnitCircle(metric), [&](const Vec2& offset) {
    const double l = std::sqrt(squared_length(metric, offset));
    longest = std::max(longest, l), shortest = std::min(shortest, l);
    ++count;
  });
  EXPECT_EQ(count, 30);
  EXPECT_NEAR(longest, 0.24, 1e-15);
  EXPECT_NEAR(shortest, 0.015, 1e-15);
}

// The largest of the least of three linear functions is where they are equal.
TEST(AlongCompass, FindsTheTopOfARoofThatHasNoDerivativeThere) {
  const auto roof = [](const Vec2& p, double) {
    return std::min({1 - p[0], 1 + 0.5 * p[0] - p[1], 2 + 0.5 * p[0] + p[1]});
  };
  const Vec2 top = search_along_compass(roof({0, 0}, 0), 0.4, 1e-4, roof);
  EXPECT_GT(roof(top, 0), 1 + 0.3) << "4/3 at (-1/3, -1/2)";
}

TEST(AlongCompass, StaysWhereNothingIsBetter) {
  const Vec2 top = search_along_compass(0, 0.4, 0.01, [](const Vec2& p, double) { return -norm(p); });
  EXPECT_EQ(top, (Vec2{0, 0}));
}

// The sine of an angle that is turned over rises to 0 as its corner goes to infinity.
TEST(AlongCompass, EndsWhereItGetsBetterForEver) {
  int asked = 0;
  const Vec2 top = search_along_compass(-1, 0.2, 0.01, [&asked](const Vec2& p, double) {
    ++asked;
    return p.x() > -1 ? -1 / (2 + p.x()) : -2;
  });
  EXPECT_GT(top.x(), 1);
  EXPECT_LE(norm(top), 0.2 * max_steps_of_compass);
  EXPECT_LE(asked, 8 * max_steps_of_compass);
}

}  // namespace
}  // namespace carreau
