// SPDX-License-Identifier: BSD-3-Clause
#include "metric/field_length.h"

#include <gtest/gtest.h>

#include <cmath>

namespace carreau {
namespace {

TEST(FieldLength, AConstantFieldGivesTheMetricsLength) {
  const Metric2 m{3, 1, 5};
  const auto field = [&](Vec2) { return m; };
  const Vec2 p{0.3, -1}, q{2, 4};
  EXPECT_NEAR(field_length(field, p, q), length(m, q - p), 1e-12);
  EXPECT_EQ(field_length(field, p, p), 0);
}

// h = 1/10 + x / 4: the length from 0 to x is 4 ln(h(x) / h(0)) (RR-2818 sec. 5.4.1).
TEST(FieldLength, ConvergesWithLssAtOrderTwoToTheClosedFormOfALinearSize) {
  const auto field = [](Vec2 p) {
    const double h = 0.1 + 0.25 * p.x();
    return Metric2{1 / (h * h), 0, 1 / (h * h)};
  };
  const double exact = 4 * std::log((0.1 + 0.25 * 4) / 0.1);
  const auto error = [&](double lss) { return std::abs(field_length(field, {0, 0}, {4, 0}, lss) / exact - 1); };
  EXPECT_LT(error(0.5), 2e-3);
  EXPECT_LT(error(0.125), error(0.5) / 12);
  EXPECT_LT(error(0.03125), error(0.125) / 12);
}

TEST(FieldLength, EqualEndsDoNotHideTheMiddle) {
  const auto field = [](Vec2 p) {
    const double s = 0.1 + 2 * std::exp(-50 * (p.x() - 0.5) * (p.x() - 0.5));
    return Metric2{s * s, 0, 1};
  };
  // One trapezoid of both ends would be 0.1, and short enough.
  const double exact = 0.1 + 2 * std::sqrt(std::acos(-1.0) / 50) * std::erf(0.5 * std::sqrt(50.0));
  EXPECT_NEAR(field_length(field, {0, 0}, {1, 0}, 0.1), exact, 0.1 * exact);
  EXPECT_NEAR(field_length(field, {0, 0}, {1, 0}, 0.01), exact, 5e-3 * exact);
}

TEST(FieldLength, TheNumberOfEvaluationsFollowsTheLengthAndIsBoundedByTheDepth) {
  int calls = 0;
  const auto field = [&](Vec2) {
    ++calls;
    return Metric2{1e4, 0, 1};
  };
  EXPECT_NEAR(field_length(field, {0, 0}, {1, 0}, 0.5), 100, 1e-10);
  EXPECT_EQ(calls, 257);  // 256 intervals of length 0.39
  calls = 0;
  const auto endless = [&](Vec2 p) {
    ++calls;
    return Metric2{1e30 / ((p.x() + 1e-9) * (p.x() + 1e-9)), 0, 1};
  };
  EXPECT_GT(field_length(endless, {0, 0}, {1, 0}, 0.5, 10), 1e15);
  EXPECT_LE(calls, 1025);
}

}  // namespace
}  // namespace carreau
