// SPDX-License-Identifier: BSD-3-Clause
// The guarantees for the edges of a triangle after one look at it (plane/kernel/settled.h).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "plane/kernel/settled.h"

namespace carreau::plane {
namespace {

double squared_length_in(const Metric2& m, const Vertex& p, const Vertex& q) {
  return squared_length(m, q.point() - p.point());
}

/// Vertices c, a, d, b of a quadrilateral with the diagonal ab, some ways from two equilateral triangles in a tensor that
/// is stretched up to five times, with tensors that differ by some share.
class Quadrilaterals {
 public:
  struct Four {
    Vertex c, a, d, b;
  };

  Four next() {
    const double stretch = 1 + 4 * share(), turn = std::numbers::pi * share(), far = 0.6 * share(), unlike = 0.3 * share();
    const double co = std::cos(turn), si = std::sin(turn), big = stretch * stretch;
    const Metric2 m{co * co + big * si * si, (1 - big) * co * si, si * si + big * co * co};
    const auto vertex = [&](double x, double y) {
      x += far * (share() - 0.5), y += far * (share() - 0.5);
      Vertex v;  // of length (x, y) in m
      const double along = x, across = y / stretch;
      v.x = co * along - si * across, v.y = si * along + co * across;
      const auto about = [&] { return 1 + unlike * (share() - 0.5); };
      v.set_metric({m.a * about(), m.b * about(), m.c * about()});
      return v;
    };
    const double height = 0.5 * std::numbers::sqrt3;
    return {vertex(0.5, height), vertex(0, 0), vertex(0.5, -height), vertex(1, 0)};
  }

 private:
  double share() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  std::mt19937 random_{7};
};

TEST(Settled, EdgesOfAcuteTrianglesAreDelaunayInTheMeanMetric) {
  Quadrilaterals all;
  int acute = 0, not_delaunay = 0;
  double least = 1;
  for (int k = 0; k < 400'000; ++k) {
    const Quadrilaterals::Four four = all.next();
    const Vertex &c = four.c, &a = four.a, &d = four.d, &b = four.b;
    const Metric2 m = c.metric() + a.metric() + d.metric() + b.metric();
    const auto cosine = [&](const Vertex& at) {
      const Vec2 u = a.point() - at.point(), v = b.point() - at.point();
      return dot(m, u, v) / std::sqrt(squared_length(m, u) * squared_length(m, v));
    };
    const double lesser = std::min(cosine(c), cosine(d));
    if (lesser < 0) ++not_delaunay;
    if ((settled_state(c, a, b) & settled_state(d, b, a) & Settled::acute) == 0) continue;
    ++acute;
    least = std::min(least, lesser);
  }
  EXPECT_GT(least, 0);
  EXPECT_GT(acute, 20'000);
  EXPECT_GT(not_delaunay, 20);
}

TEST(Settled, GoodTrianglesAreNeitherCrowdedNorBad) {
  Quadrilaterals all;
  int good = 0, fine = 0;
  double shortest2 = 10, worst = 1, worst_fine = 1;
  for (int k = 0; k < 400'000; ++k) {
    const Quadrilaterals::Four four = all.next();
    const Vertex &c = four.c, &a = four.a, &b = four.b;
    const std::uint8_t state = settled_state(c, a, b);
    const Metric2 m = c.metric() + a.metric() + b.metric();
    const Vec2 u = a.point() - c.point(), v = b.point() - c.point();
    const double quality = 2 * std::numbers::sqrt3 * cross(u, v) * std::sqrt(determinant(m)) /
                           (squared_length(m, u) + squared_length(m, v) + squared_length(m, v - u));
    if ((state & Settled::good) != 0) {
      ++good, worst = std::min(worst, quality);
      const auto half = [](const Vertex& p, const Vertex& q) { return 0.5 * (p.metric() + q.metric()); };
      shortest2 = std::min({shortest2, squared_length_in(half(c, a), c, a), squared_length_in(half(a, b), a, b),
                            squared_length_in(half(b, c), b, c)});
    }
    if ((state & Settled::fine) != 0) ++fine, worst_fine = std::min(worst_fine, quality);
  }
  EXPECT_GE(shortest2, crowded_length2);
  EXPECT_GE(worst, doubtful_quality);
  EXPECT_GE(worst_fine, searched_quality);
  EXPECT_GT(good, 20'000);
  EXPECT_GT(fine, 20'000);
}

TEST(Settled, NothingIsKnownOfTrianglesWhoseMetricsDiffer) {
  Vertex p, q, r;
  q.x = 1, r.x = 0.5, r.y = 0.5 * std::numbers::sqrt3;
  EXPECT_EQ(settled_state(p, q, r), Settled::acute | Settled::good | Settled::fine);
  q.set_metric({4, 0, 4});
  EXPECT_EQ(settled_state(p, q, r), 0);
  q.set_metric({1, 0, 1});
  r.x = 0.02;
  EXPECT_EQ(settled_state(p, q, r), 0) << "right-angled";
  r.x = 0.5, r.y = -r.y;
  EXPECT_EQ(settled_state(p, q, r), 0) << "turned over";
}

}  // namespace
}  // namespace carreau::plane
