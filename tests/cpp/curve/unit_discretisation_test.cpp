// SPDX-License-Identifier: BSD-3-Clause
#include "curve/unit_discretisation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "support/error.h"

namespace {

using carreau::SizeLaw;

constexpr SizeLaw laws[] = {SizeLaw::linear, SizeLaw::geometric, SizeLaw::sinusoidal};

/// Integral of dr / h(r) by Simpson's rule on many intervals, independent of the closed forms.
double simpson(SizeLaw law, double h1, double h2, double d, double to = 1) {
  const int n = 20000;
  double sum = 0;
  for (int i = 0; i <= n; ++i) {
    const int weight = i == 0 || i == n ? 1 : (i % 2 == 1 ? 4 : 2);
    sum += weight / carreau::interpolate_size(law, h1, h2, to * i / n);
  }
  return d * to * sum / (3 * n);
}

TEST(SizeLaw, MeetsItsEndsAndIsMonotone) {
  for (const SizeLaw law : laws) {
    EXPECT_DOUBLE_EQ(carreau::interpolate_size(law, 0.3, 7, 0), 0.3);
    EXPECT_DOUBLE_EQ(carreau::interpolate_size(law, 0.3, 7, 1), 7);
    double before = 0.3;
    for (int i = 1; i <= 100; ++i) {
      const double h = carreau::interpolate_size(law, 0.3, 7, i / 100.);
      EXPECT_GT(h, before);
      before = h;
    }
  }
}

TEST(NormalisedLength, ClosedFormsAgreeWithQuadrature) {
  for (const SizeLaw law : laws) {
    for (const double h2 : {0.02, 0.5, 0.999, 1., 1 + 1e-7, 1.3, 40.}) {
      SCOPED_TRACE(testing::Message() << "law " << static_cast<int>(law) << ", h2 = " << h2);
      const double exact = simpson(law, 1, h2, 3);
      EXPECT_NEAR(carreau::normalised_length(law, 1, h2, 3), exact, 1e-9 * exact);
    }
  }
}

TEST(NormalisedLength, IsContinuousWhereSizesAreNearlyEqual) {
  // RR-2818 sec. 5.4: (2 - e) / (2 h1) + o(e^2) for h2 = h1 (1 + e), up to e^2.
  for (const SizeLaw law : laws) {
    for (const double e : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15, -1e-6, -1e-12}) {
      const double h1 = 0.7;
      EXPECT_NEAR(carreau::normalised_length(law, h1, h1 * (1 + e), 2), 2 * (2 - e) / (2 * h1), 2 * e * e + 2e-15);
    }
    EXPECT_DOUBLE_EQ(carreau::normalised_length(law, 0.7, 0.7, 2), 2 / 0.7);
  }
}

TEST(NormalisedLength, IsTheSameFromBothEnds) {
  for (const SizeLaw law : laws) {
    const double forward = carreau::normalised_length(law, 0.1, 2.5, 4);
    EXPECT_NEAR(forward, carreau::normalised_length(law, 2.5, 0.1, 4), 1e-14 * forward);
  }
}

TEST(DistanceAtNormalisedLength, InvertsTheLengthOfAPart) {
  for (const SizeLaw law : laws) {
    for (const double h2 : {0.02, 0.5, 1., 1 + 1e-12, 1 + 1e-7, 40.}) {
      for (const double part : {0., 0.1, 0.5, 0.73, 1.}) {
        SCOPED_TRACE(testing::Message() << "law " << static_cast<int>(law) << ", h2 = " << h2 << ", part " << part);
        const double target = simpson(law, 1, h2, 3, part);
        EXPECT_NEAR(carreau::distance_at_normalised_length(law, 1, h2, 3, target), 3 * part, 3e-7);
      }
    }
  }
}

TEST(DistanceAtNormalisedLength, AgreesWithTheSeriesOfNearlyEqualSizes) {
  // RR-2818 sec. 5.4: S_X = L_X (2 - e + e L_X) / 2 + o(e^2).
  for (const SizeLaw law : {SizeLaw::linear, SizeLaw::geometric}) {
    for (const double e : {1e-5, 1e-8, 1e-11, 1e-15}) {
      const double total = carreau::normalised_length(law, 1, 1 + e, 1);
      for (const double lx : {0.25, 0.5, 0.9}) {
        EXPECT_NEAR(carreau::distance_at_normalised_length(law, 1, 1 + e, 1, lx * total), lx * (2 - e + e * lx) / 2,
                    e * e + 1e-15);
      }
    }
  }
}

TEST(UnitEdgeCount, KeepsEveryEdgeWithinSqrtTwoOfUnity) {
  EXPECT_EQ(carreau::unit_edge_count(1.4), 1);   // 1 / 1.4 = 0.714 against 0.7
  EXPECT_EQ(carreau::unit_edge_count(1.42), 2);  // HDR sec. 2.5.2
  EXPECT_EQ(carreau::unit_edge_count(0), 1);
  EXPECT_EQ(carreau::unit_edge_count(0.2), 1);
  for (double l = std::sqrt(0.5); l < 500; l *= 1.0007) {
    const double n = carreau::unit_edge_count(l);
    EXPECT_LE(l / n, std::sqrt(2.) * (1 + 1e-12));
    EXPECT_GE(l / n, std::sqrt(0.5) * (1 - 1e-12));
    // HDR eq. 2.14: no other count has a better size quality.
    const auto quality = [&](double count) { return std::min(l / count, count / l); };
    EXPECT_GE(quality(n), quality(n + 1) - 1e-12);
    if (n > 1) {
      EXPECT_GE(quality(n), quality(n - 1) - 1e-12);
    }
  }
}

/// RR-2818 sec. 6.1.
const std::vector<double> paper_s{0, 3, 4, 8, 10};
const std::vector<double> paper_h{1.5, 0.5, 2, 0.1, 0.7};

TEST(SplitBySizes, GivesTheCountsOfTheIsotropicExample) {
  EXPECT_EQ(carreau::split_by_sizes(paper_s, paper_h, SizeLaw::linear).size() - 1, 17U);
  EXPECT_EQ(carreau::split_by_sizes(paper_s, paper_h, SizeLaw::geometric).size() - 1, 26U);
  EXPECT_EQ(carreau::split_by_sizes(paper_s, paper_h, SizeLaw::sinusoidal).size() - 1, 21U);
}

double paper_size(SizeLaw law, double s) {
  std::size_t i = 0;
  while (i + 2 < paper_s.size() && paper_s[i + 1] < s) ++i;
  return carreau::interpolate_size(law, paper_h[i], paper_h[i + 1], (s - paper_s[i]) / (paper_s[i + 1] - paper_s[i]));
}

TEST(SplitBySizes, EdgesHaveEqualNormalisedLength) {
  for (const SizeLaw law : laws) {
    const auto cuts = carreau::split_by_sizes(paper_s, paper_h, law);
    EXPECT_EQ(cuts.front(), 0);
    EXPECT_EQ(cuts.back(), 10);
    const double total = carreau::normalised_length(paper_s, paper_h, law);
    for (std::size_t j = 0; j + 1 < cuts.size(); ++j) {
      double length = 0;  // midpoint rule
      const int n = 20000;
      const double w = (cuts[j + 1] - cuts[j]) / n;
      for (int i = 0; i < n; ++i) length += w / paper_size(law, cuts[j] + (i + 0.5) * w);
      EXPECT_NEAR(length, total / static_cast<double>(cuts.size() - 1), 1e-5);
    }
  }
}

TEST(SplitBySizes, EverySquareOfTheHistogramMeetsTheSizeCurve) {
  // Theorem of RR-2818 sec. 6.1, for edges of normalised length u instead of 1: h takes the value (s2 - s1) / u
  // somewhere between s1 and s2.
  for (const SizeLaw law : laws) {
    const auto cuts = carreau::split_by_sizes(paper_s, paper_h, law);
    const double u = carreau::normalised_length(paper_s, paper_h, law) / static_cast<double>(cuts.size() - 1);
    for (std::size_t j = 0; j + 1 < cuts.size(); ++j) {
      double least = 1e300, most = 0;
      for (int i = 0; i <= 1000; ++i) {
        const double h = paper_size(law, cuts[j] + (cuts[j + 1] - cuts[j]) * i / 1000);
        least = std::min(least, h);
        most = std::max(most, h);
      }
      const double side = (cuts[j + 1] - cuts[j]) / u;
      EXPECT_GE(side, least * (1 - 1e-9));
      EXPECT_LE(side, most * (1 + 1e-9));
    }
  }
}

TEST(SplitBySizes, UniformSizeGivesEqualEdges) {
  const auto cuts =
      carreau::split_by_sizes(std::vector<double>{0, 5}, std::vector<double>{0.154, 0.154}, SizeLaw::linear);
  ASSERT_EQ(cuts.size(), 33U);  // 5 / 0.154 = 32.47
  for (std::size_t j = 0; j < cuts.size(); ++j) EXPECT_NEAR(cuts[j], 5. * static_cast<double>(j) / 32, 1e-14);
}

TEST(SplitBySizes, HonoursTheLeastCount) {
  const std::vector<double> s{0, 1}, h{9, 9};
  EXPECT_EQ(carreau::split_by_sizes(s, h, SizeLaw::linear).size(), 2U);
  EXPECT_EQ(carreau::split_by_sizes(s, h, SizeLaw::linear, 3).size(), 4U);
}

TEST(SplitBySizes, RejectsSizesThatMeanNothing) {
  const std::vector<double> s{0, 1};
  for (const double bad : {0., -1., std::nan(""), HUGE_VAL}) {
    EXPECT_THROW(carreau::split_by_sizes(s, std::vector<double>{1, bad}, SizeLaw::linear), carreau::InvalidArgument);
  }
  EXPECT_THROW(carreau::split_by_sizes(s, std::vector<double>{1}, SizeLaw::linear), carreau::InvalidArgument);
  EXPECT_THROW(carreau::split_by_sizes(std::vector<double>{1, 0}, std::vector<double>{1, 1}, SizeLaw::linear),
               carreau::InvalidArgument);
  EXPECT_THROW(carreau::split_by_sizes(s, std::vector<double>{1e-12, 1e-12}, SizeLaw::linear), carreau::LimitError);
}

TEST(SplitByMetric, AgreesWithTheClosedFormsAsLssShrinks) {
  const auto exact =
      carreau::split_by_sizes(std::vector<double>{0, 10}, std::vector<double>{0.2, 1.5}, SizeLaw::geometric);
  const auto speed = [](double w) { return 1 / carreau::interpolate_size(SizeLaw::geometric, 0.2, 1.5, w / 10); };
  double before = 0;
  for (const double lss : {0.5, 0.25, 0.125, 0.0625}) {
    const auto cuts = carreau::split_by_metric(speed, 10, lss);
    ASSERT_EQ(cuts.size(), exact.size());
    double error = 0;
    for (std::size_t j = 0; j < cuts.size(); ++j) error = std::max(error, std::abs(cuts[j] - exact[j]));
    EXPECT_LT(error, 0.05 * lss * lss);  // the trapezoid's second order
    if (before > 0) {
      EXPECT_LT(error, before / 2);
    }
    before = error;
  }
}

TEST(SplitByMetric, FindsAFineMiddleBetweenCoarseEnds) {
  const auto speed = [](double w) { return 0.1 + 60 * std::exp(-40 * (w - 0.5) * (w - 0.5)); };
  const double total = 0.1 + 60 * std::sqrt(std::numbers::pi / 40);  // the tails are below 3e-5
  EXPECT_NEAR(static_cast<double>(carreau::split_by_metric(speed, 1, 0.1).size()) - 1, total, 1.);
}

TEST(SplitByMetric, RejectsSpeedsThatMeanNothing) {
  EXPECT_THROW(carreau::split_by_metric([](double) { return std::nan(""); }, 1, 0.5), carreau::InvalidArgument);
  EXPECT_THROW(carreau::split_by_metric([](double) { return -1.; }, 1, 0.5), carreau::InvalidArgument);
  EXPECT_THROW(carreau::split_by_metric([](double) { return 1.; }, 0, 0.5), carreau::InvalidArgument);
  EXPECT_THROW(carreau::split_by_metric([](double) { return 1.; }, 1, 0), carreau::InvalidArgument);
  EXPECT_THROW(carreau::split_by_metric([](double) { return 1e15; }, 1, 0.5), carreau::LimitError);
}

}  // namespace
