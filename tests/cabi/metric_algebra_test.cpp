// SPDX-License-Identifier: BSD-3-Clause
// Algebra of metrics through the interface: closed forms in the plane and in space, and rejected input.
#include <cmath>
#include <numbers>

#include "abi_fixture.h"

namespace {

class MetricAlgebra : public testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(carreau_session_create(&session), CARREAU_OK); }
  void TearDown() override { carreau_session_free(session); }
  void ok(carreau_status status) { ASSERT_EQ(status, CARREAU_OK) << carreau_last_error(session); }
  void refused(carreau_status status, const std::string& part) {
    EXPECT_EQ(status, CARREAU_ERR_ARGUMENT);
    EXPECT_NE(std::string(carreau_last_error(session)).find(part), std::string::npos) << carreau_last_error(session);
  }

  carreau_session* session = nullptr;
};

TEST_F(MetricAlgebra, SizesAndAxesMakeTheMetricAgain) {
  const double c = std::cos(0.4), s = std::sin(0.4);
  const double sizes[] = {0.1, 2, 0.5, 0.5}, axes[] = {c, s, -s, c, 3, 0, 1, 1};
  double metrics[6], found_sizes[4], found_axes[8], again[6];
  ok(carreau_metric_of_sizes(session, 2, 2, sizes, axes, metrics));
  EXPECT_NEAR(metrics[0], c * c * 100 + s * s / 4, 1e-12);
  EXPECT_NEAR(metrics[1], c * s * (100 - 0.25), 1e-12);
  EXPECT_NEAR(metrics[3], 4, 1e-12);  // a circle, whatever its axes
  EXPECT_NEAR(metrics[4], 0, 1e-12);
  ok(carreau_metric_sizes(session, 2, 2, metrics, found_sizes, found_axes));
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(found_sizes[i], sizes[i], 1e-13);
  EXPECT_NEAR(std::abs(found_axes[0] * c + found_axes[1] * s), 1, 1e-14);
  ok(carreau_metric_of_sizes(session, 2, 2, found_sizes, found_axes, again));
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(again[i], metrics[i], 1e-11);

  const double space[] = {4, 1, 0.5, 3, -0.2, 9};
  double h[3], e[9], back[6];
  ok(carreau_metric_sizes(session, 3, 1, space, h, e));
  EXPECT_LE(h[0], h[1]);
  EXPECT_LE(h[1], h[2]);
  ok(carreau_metric_of_sizes(session, 3, 1, h, e, back));
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(back[i], space[i], 1e-13);
  ok(carreau_metric_sizes(session, 3, 1, space, h, nullptr));
}

TEST_F(MetricAlgebra, InterpolationFollowsItsLaw) {
  // Sizes 1 and 4 along x, 2 and 2 along y (RR-2818 sec. 4.3.2).
  const double p[] = {1, 0, 0.25}, q[] = {1. / 16, 0, 0.25}, half = 0.5;
  const double expected[] = {2.5, 2, 1 + 3 * 0.5};
  for (int law = 0; law < 3; ++law) {
    double m[3];
    ok(carreau_metric_interpolate(session, 2, law, 1, p, q, &half, m));
    EXPECT_NEAR(1 / std::sqrt(m[0]), expected[law], 1e-13) << law;
    EXPECT_NEAR(1 / std::sqrt(m[2]), 2, 1e-13) << law;
  }
}

TEST_F(MetricAlgebra, IntersectionsOfThree) {
  // Half axes .2 and 1, turned by 60 degrees: the largest ellipse inside is the circle of radius .2.
  double metrics[9], in_turn[3], largest[3];
  for (int k = 0; k < 3; ++k) {
    const double a = k * std::numbers::pi / 3, sizes[] = {0.2, 1}, axes[] = {std::cos(a), std::sin(a), -std::sin(a), std::cos(a)};
    ok(carreau_metric_of_sizes(session, 2, 1, sizes, axes, metrics + 3 * k));
  }
  ok(carreau_metric_intersect(session, 2, CARREAU_INTERSECT_LARGEST, 1, 3, metrics, largest));
  ok(carreau_metric_intersect(session, 2, CARREAU_INTERSECT_IN_TURN, 1, 3, metrics, in_turn));
  EXPECT_NEAR(largest[0], 25, 1e-7);
  EXPECT_NEAR(largest[1], 0, 1e-7);
  EXPECT_NEAR(largest[2], 25, 1e-7);
  EXPECT_GT(in_turn[0] * in_turn[2] - in_turn[1] * in_turn[1], 630);
  // Two places with one metric each.
  double alone[6];
  ok(carreau_metric_intersect(session, 2, CARREAU_INTERSECT_LARGEST, 2, 1, metrics, alone));
  for (int i = 0; i < 6; ++i) EXPECT_EQ(alone[i], metrics[i]);
}

TEST_F(MetricAlgebra, ReductionIsOrthogonalInBoth) {
  const double p[] = {4, 1, 0.5, 3, -0.2, 9}, q[] = {1, 0.3, 0, 7, 0.1, 2};
  double h[3], k[3], d[9];
  ok(carreau_metric_reduce(session, 3, 1, p, q, h, k, d));
  const auto dot = [](const double* m, const double* a, const double* b) {
    return a[0] * (m[0] * b[0] + m[1] * b[1] + m[2] * b[2]) + a[1] * (m[1] * b[0] + m[3] * b[1] + m[4] * b[2]) +
           a[2] * (m[2] * b[0] + m[4] * b[1] + m[5] * b[2]);
  };
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(std::hypot(d[3 * i], d[3 * i + 1], d[3 * i + 2]), 1, 1e-14);
    EXPECT_NEAR(dot(p, d + 3 * i, d + 3 * i), 1 / (h[i] * h[i]), 1e-13);
    EXPECT_NEAR(dot(q, d + 3 * i, d + 3 * i), 1 / (k[i] * k[i]), 1e-13);
    for (int j = 0; j < i; ++j) {
      EXPECT_NEAR(dot(p, d + 3 * i, d + 3 * j), 0, 1e-13);
      EXPECT_NEAR(dot(q, d + 3 * i, d + 3 * j), 0, 1e-13);
    }
  }
  const double plane_p[] = {1, 0.3, 2}, plane_q[] = {50, -3, 0.4};
  double e[4], a[2], b[2];
  ok(carreau_metric_reduce(session, 2, 1, plane_p, plane_q, a, b, e));
  for (const double* m : {plane_p, plane_q})
    EXPECT_NEAR(e[0] * (m[0] * e[2] + m[1] * e[3]) + e[1] * (m[1] * e[2] + m[2] * e[3]), 0, 1e-12);
}

TEST_F(MetricAlgebra, LengthsHaveTheirClosedForms) {
  // Sizes 1 and e along an edge of length 2: linear 2 log(e) / (e - 1), geometric 2 (1 - 1 / e).
  const double e = std::numbers::e, edges[] = {0, 0, 0, 2, 0, 0, 1, 1, 1, 1, 1, 1};
  const double far = 1 / (e * e), metrics[] = {1, 0, 0, 1, 0, 1, far, 0, 0, far, 0, far, 1, 0, 0, 1, 0, 1, 1, 0, 0, 1, 0, 1};
  const double expected[] = {2 / (e - 1), 2 * (1 - 1 / e)};
  for (int law = 0; law < 2; ++law) {
    double l[2];
    ok(carreau_metric_lengths(session, 3, law, 2, edges, metrics, l));
    EXPECT_NEAR(l[0], expected[law], 1e-4 * expected[law]);
    EXPECT_EQ(l[1], 0);
  }
}

TEST_F(MetricAlgebra, ErrorsAreReportedAndNothingIsWritten) {
  const double good_and_bad[] = {1, 0, 1, 1, 2, 1}, share[] = {0.5, 0.5};
  double out[6] = {7, 7, 7, 7, 7, 7}, axes[8];
  refused(carreau_metric_sizes(session, 2, 2, good_and_bad, out, axes), "metric 1 of metrics is not positive definite");
  refused(carreau_metric_interpolate(session, 2, 0, 2, good_and_bad, good_and_bad, share, out), "metric 1 of p");
  refused(carreau_metric_intersect(session, 2, 0, 1, 2, good_and_bad, out), "metric 1 of metrics");
  refused(carreau_metric_intersect(session, 2, 0, 1, 0, good_and_bad, out), "count is 0");
  refused(carreau_metric_intersect(session, 2, 2, 1, 1, good_and_bad, out), "how is 2");
  refused(carreau_metric_sizes(session, 4, 1, good_and_bad, out, axes), "dimension is 4");
  refused(carreau_metric_sizes(session, 2, -1, good_and_bad, out, axes), "n is -1");
  refused(carreau_metric_sizes(session, 2, 1, nullptr, out, axes), "metrics is NULL");
  refused(carreau_metric_interpolate(session, 2, 3, 1, good_and_bad, good_and_bad, share, out), "law is 3");
  const double beyond = 1.5, sizes[] = {1, 0}, flat[] = {1, 0, 2, 0};
  refused(carreau_metric_interpolate(session, 2, 0, 1, good_and_bad, good_and_bad, &beyond, out), "share 0");
  refused(carreau_metric_of_sizes(session, 2, 1, sizes, flat, out), "size 1");
  refused(carreau_metric_of_sizes(session, 2, 1, share, flat, out), "axis 1");
  EXPECT_EQ(carreau_metric_sizes(nullptr, 2, 1, good_and_bad, out, axes), CARREAU_ERR_ARGUMENT);
  for (const double x : out) EXPECT_EQ(x, 7);
  EXPECT_EQ(carreau_metric_sizes(session, 2, 0, good_and_bad, out, axes), CARREAU_OK);
}

}  // namespace
