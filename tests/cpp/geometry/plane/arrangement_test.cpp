// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane/arrangement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "predicates/predicates.h"

namespace carreau {
namespace {

void add_segment(PlaneDomainInput& input, const Vec2& a, const Vec2& b) {
  const int first = static_cast<int>(input.points.size());
  input.points.push_back({.xy = a}), input.points.push_back({.xy = b});
  PlaneCurve curve;
  curve.points = {first, first + 1}, curve.ref = static_cast<int>(input.curves.size()) + 1;
  input.curves.push_back(curve);
}

const Vec2& at(const PlaneDomainInput& input, int point) { return input.points[static_cast<std::size_t>(point)].xy; }

double length_of(const PlaneDomainInput& input) {
  double sum = 0;
  for (const PlaneCurve& curve : input.curves) sum += norm(Vec2(at(input, curve.points[1]) - at(input, curve.points[0])));
  return sum;
}

bool cross_inside(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return orientation(a, b, c) * orientation(a, b, d) < 0 && orientation(c, d, a) * orientation(c, d, b) < 0;
}

std::size_t crossings_of(const PlaneDomainInput& input) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < input.curves.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto &c = input.curves[i].points, &d = input.curves[j].points;
      n += cross_inside(at(input, c[0]), at(input, c[1]), at(input, d[0]), at(input, d[1])) ? 1 : 0;
    }
  return n;
}

void expect_arranged(const PlaneDomainInput& input) {
  EXPECT_EQ(crossings_of(input), 0u);
  std::set<std::pair<double, double>> places;
  for (const PlanePoint& p : input.points) EXPECT_TRUE(places.emplace(p.xy.x(), p.xy.y()).second);
  for (const PlaneCurve& curve : input.curves)
    for (std::size_t p = 0; p < input.points.size(); ++p) {
      if (static_cast<int>(p) == curve.points[0] || static_cast<int>(p) == curve.points[1]) continue;
      const Vec2 &a = at(input, curve.points[0]), &b = at(input, curve.points[1]), &x = input.points[p].xy;
      EXPECT_FALSE(orientation(a, b, x) == 0 && dot(Vec2(x - a), Vec2(x - b)) < 0);
    }
}

TEST(Arrangement, RandomSegmentsMeetAtPointsAlone) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1, 1);
  for (int run = 0; run < 100; ++run) {
    PlaneDomainInput input;
    for (int k = 0; k < 2 + run % 20; ++k)
      add_segment(input, {place(random), place(random)}, {place(random), place(random)});
    const std::size_t segments = input.curves.size(), crossings = crossings_of(input);
    const double length = length_of(input);
    const SegmentArrangement found = arrange_segments(input);
    EXPECT_EQ(found.crossings, crossings) << run;
    EXPECT_EQ(input.curves.size(), segments + 2 * crossings) << run;
    EXPECT_NEAR(length_of(input), length, 1e-12) << run;
    expect_arranged(input);
  }
}

TEST(Arrangement, LinesThroughOnePlaceHaveOneCrossing) {
  for (int n : {2, 3, 7, 40}) {
    PlaneDomainInput input;
    const Vec2 centre{0.3, 0.1};
    for (int k = 0; k < n; ++k) {
      const double angle = std::numbers::pi * (k + 0.1) / n;
      const Vec2 away{std::cos(angle), std::sin(angle)};
      add_segment(input, centre - away, centre + 2 * away);
    }
    EXPECT_EQ(arrange_segments(input).crossings, 1u) << n;
    EXPECT_EQ(input.curves.size(), 2u * static_cast<unsigned>(n)) << n;
    expect_arranged(input);
  }
}

TEST(Arrangement, OnAGridPointsRepeatAndSegmentsOverlap) {
  std::mt19937 random(11);
  for (int run = 0; run < 200; ++run) {
    PlaneDomainInput input;
    const auto place = [&] { return Vec2(static_cast<double>(random() % 5), static_cast<double>(random() % 5)); };
    for (int k = 0; k < 12; ++k) add_segment(input, place(), place());
    arrange_segments(input);
    expect_arranged(input);
    std::set<std::pair<int, int>> known;
    for (const PlaneCurve& curve : input.curves)
      EXPECT_TRUE(known.insert(std::minmax(curve.points[0], curve.points[1])).second);
  }
}

TEST(Arrangement, CountsItsWork) {
  PlaneDomainInput input;
  add_segment(input, {0, 0}, {4, 0});
  add_segment(input, {0, 0}, {4, 0});   // the same again
  add_segment(input, {1, 0}, {1, 2});   // begins on the first one
  add_segment(input, {0, 1}, {4, 1});   // crosses the third one
  add_segment(input, {2, 2}, {2, 2});   // of no length
  const SegmentArrangement found = arrange_segments(input);
  EXPECT_EQ(found.merged_points, 3u);
  EXPECT_EQ(found.dropped_segments, 2u);
  EXPECT_EQ(found.points_on_segments, 1u);
  EXPECT_EQ(found.crossings, 1u);
  EXPECT_EQ(input.curves.size(), 6u);
  for (const PlaneCurve& curve : input.curves) EXPECT_GT(curve.ref, 0);
}

}  // namespace
}  // namespace carreau
