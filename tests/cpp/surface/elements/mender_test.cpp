// SPDX-License-Identifier: BSD-3-Clause
// The search for valid elements ends: its places are counted.
#include <gtest/gtest.h>

#include <functional>
#include <utility>
#include <vector>

#include "surface/elements/base/mender.h"

namespace carreau {
namespace {

using namespace thresholds::elements;

struct Trial {
  std::int32_t node;
  double x;
};

/// Triangles with one corner in common that moves along a line; the score is a function of its place.
class LineMender : public Mender<LineMender, double> {
 public:
  LineMender(std::int32_t cells, std::function<double(double)> score, Monitor& monitor)
      : Mender(fan(cells), 2 + cells, 2 + cells, all_but_first_fixed(2 + cells), monitor), score_(std::move(score)) {}

  double score(const Cell&) const { return score_(x_); }
  double score_at(const Cell&, int) const { return score_(x_); }
  static std::array<double, 2> orientations(const Cell&) { return {1, 1}; }
  static std::array<double, 8> ways(std::int32_t, double step) {
    return {step, -step, step / 2, -step / 2, step / 4, -step / 4, step / 8, -step / 8};
  }
  std::vector<Trial> places(const std::vector<std::pair<std::int32_t, double>>& moves) {
    ++tried;
    return {{moves.front().first, x_ + moves.front().second}};
  }
  Trial trial_of(std::int32_t node) const { return {node, x_}; }
  void put(const Trial& trial) { x_ = trial.x; }

  std::int64_t tried = 0;

 private:
  static std::vector<Cell> fan(std::int32_t count) {
    std::vector<Cell> cells(static_cast<std::size_t>(count));
    for (std::int32_t c = 0; c < count; ++c) cells[static_cast<std::size_t>(c)].nodes = {0, c + 1, c + 2, -1, -1, -1, -1, -1};
    return cells;
  }
  static std::vector<char> all_but_first_fixed(std::int32_t nodes) {
    std::vector<char> fixed(static_cast<std::size_t>(nodes), 1);
    fixed[0] = 0;
    return fixed;
  }

  std::function<double(double)> score_;
  double x_ = 0;
};

// A score that grows for ever and is never good.
TEST(Mender, EndsWhenItsPlacesAreSpent) {
  for (const std::int32_t cells : {1, 5, 40}) {
    Monitor monitor;
    LineMender mender(cells, [](double x) { return x - 1e9; }, monitor);
    mender.find_below(good_jacobian);
    mender.mend();
    const std::int64_t budget = max_trials + max_trials_of_element * cells;
    EXPECT_GE(mender.tried, budget) << cells;
    EXPECT_LT(mender.tried, budget + 8) << cells;
    EXPECT_FALSE(mender.bad().empty()) << cells;
  }
}

TEST(Mender, EndsWhenElementsAreGood) {
  Monitor monitor;
  LineMender mender(5, [](double x) { return x - 1; }, monitor);
  EXPECT_EQ(mender.find_below(good_jacobian), 5U);
  mender.mend();
  EXPECT_TRUE(mender.bad().empty());
  EXPECT_EQ(mender.find_below(good_jacobian), 0U);
  EXPECT_LT(mender.tried, 100);
}

// Eight places by each step from .2 to .0125, once, whatever the number of bad elements around the node.
TEST(Mender, SearchesInVainOnce) {
  Monitor monitor;
  LineMender mender(5, [](double) { return -1.; }, monitor);
  mender.find_below(good_jacobian);
  mender.mend();
  EXPECT_EQ(mender.tried, 40);
  EXPECT_EQ(mender.moves(), 0U);
  EXPECT_EQ(mender.bad().size(), 5U);
}

}  // namespace
}  // namespace carreau
