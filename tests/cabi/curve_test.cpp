// SPDX-License-Identifier: BSD-3-Clause
// Curves in metrics through the interface.
#include <cmath>
#include <limits>

#include "abi_fixture.h"

namespace {

class Curve : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(carreau_session_create(&session), CARREAU_OK);
    // RR-2818 sec. 6.1: sizes 1.5, 0.5, 2, 0.1, 0.7 along a segment of length 10, the same in all directions.
    const double h[] = {1.5, 0.5, 2, 0.1, 0.7};
    for (int i = 0; i < 5; ++i) {
      const double m = 1 / (h[i] * h[i]);
      plane.insert(plane.end(), {m, 0, m});
      space.insert(space.end(), {m, 0, 0, m, 0, m});
    }
    curve.struct_size = sizeof curve;
    curve.dimension = 2;
    curve.point_count = 2;
    curve.metric_count = 5;
    curve.points = points2;
    curve.abscissae = s;
    curve.metrics = plane.data();
  }
  void TearDown() override { carreau_session_free(session); }

  std::int64_t edges() {
    std::int64_t n = -1;
    EXPECT_EQ(carreau_curve_split(session, &curve, 0, nullptr, &n, nullptr), CARREAU_OK) << carreau_last_error(session);
    return n;
  }
  std::string refused(carreau_status status = CARREAU_ERR_ARGUMENT) {
    std::int64_t n = -7;
    EXPECT_EQ(carreau_curve_split(session, &curve, 0, nullptr, &n, nullptr), status);
    EXPECT_EQ(n, -7);
    return carreau_last_error(session);
  }

  carreau_session* session = nullptr;
  carreau_curve curve{};
  double points2[4] = {1, 2, 7, 10}, points3[6] = {0, 0, 0, 10, 0, 0};
  double s[5] = {0, 3, 4, 8, 10};
  std::vector<double> plane, space;
};

TEST_F(Curve, GivesTheCountsOfTheIsotropicExample) {
  const std::int64_t expected[] = {17, 26, 21};
  for (int law = 0; law < 3; ++law) {
    curve.law = law;
    EXPECT_EQ(edges(), expected[law]);
  }
  curve.dimension = 3;
  curve.points = points3;
  curve.metrics = space.data();
  for (int law = 0; law < 3; ++law) {
    curve.law = law;
    EXPECT_EQ(edges(), expected[law]);
  }
}

TEST_F(Curve, TheLengthMatchesTheLinearLaw) {
  // RR-2818 sec. 5.2: between sizes p and q at distance d, d ln(q / p) / (q - p).
  const double h[] = {1.5, 0.5, 2, 0.1, 0.7};
  double exact = 0, length = 0;
  for (int i = 0; i < 4; ++i) exact += (s[i + 1] - s[i]) * std::log(h[i + 1] / h[i]) / (h[i + 1] - h[i]);
  std::vector<double> cuts(18);
  curve.lss = 0.05;
  ASSERT_EQ(carreau_curve_split(session, &curve, 18, cuts.data(), nullptr, &length), CARREAU_OK);
  EXPECT_NEAR(length, exact, 1e-3 * exact);
  EXPECT_EQ(cuts.front(), 0);
  EXPECT_EQ(cuts.back(), 10);
  for (std::size_t i = 1; i < cuts.size(); ++i) EXPECT_GT(cuts[i], cuts[i - 1]);
  EXPECT_EQ(carreau_curve_split(session, &curve, 17, cuts.data(), nullptr, &length), CARREAU_ERR_ARGUMENT);
}

TEST_F(Curve, RejectsMeaninglessInput) {
  plane[4] = 100;
  EXPECT_NE(refused().find("metric 1 along a curve is not positive definite"), std::string::npos);
  plane[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refused().find("metric 1"), std::string::npos);
  plane[4] = 0;
  curve.law = 3;
  EXPECT_NE(refused().find("law is 3"), std::string::npos);
  curve.law = 0;
  curve.dimension = 4;
  EXPECT_NE(refused().find("dimension is 4"), std::string::npos);
  curve.dimension = 2;
  curve.metric_count = 1;
  refused();
  curve.metric_count = -1;
  refused();
  curve.metric_count = 5;
  curve.points = nullptr;
  EXPECT_NE(refused().find("curve->points is NULL"), std::string::npos);
  curve.points = points2;
  points2[2] = 1, points2[3] = 2;
  EXPECT_NE(refused().find("coincide"), std::string::npos);
  points2[2] = 7, points2[3] = 10;
  curve.lss = -1;
  refused();
  curve.lss = 0;
  for (std::size_t i = 0; i < 5; ++i) plane[3 * i] = plane[3 * i + 2] = 1e30;
  refused(CARREAU_ERR_LIMIT);
  EXPECT_EQ(carreau_curve_split(session, nullptr, 0, nullptr, nullptr, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_curve_split(nullptr, &curve, 0, nullptr, nullptr, nullptr), CARREAU_ERR_ARGUMENT);
}

}  // namespace
