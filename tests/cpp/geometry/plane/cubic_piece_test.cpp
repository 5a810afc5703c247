// SPDX-License-Identifier: BSD-3-Clause
// Splines of Catmull and Rom: radii and counts in closed form, loops, cusps, the tolerance of polylines.
#include "geometry/plane/cubic_piece.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "geometry/plane/catmull_rom.h"
#include "support/error.h"

namespace carreau {
namespace {

std::vector<Vec2> closed_polygon(int n) {
  std::vector<Vec2> points;
  for (int i = 0; i <= n; ++i) {
    const double angle = 2 * std::numbers::pi * (i % n) / n;
    points.push_back({std::cos(angle), std::sin(angle)});
  }
  return points;
}

CubicPiece unit_piece(const Vec2& b, const Vec2& c) { return piece_between({0, 0}, {1, 0}, b, c); }

TEST(CatmullRom, MiddleOfAPieceOfARegularPolygonHasTheRadiusInClosedForm) {
  for (const int n : {4, 8, 16, 32}) {
    const double a = 2 * std::numbers::pi / n;
    const double radius = std::cos(a / 2) + std::sin(a) * std::sin(a / 2) / 4;
    for (const CubicPiece& piece : catmull_rom(closed_polygon(n), {}))
      EXPECT_NEAR(norm(piece.at(0.5)), radius, 1e-12) << n;
  }
}

TEST(CatmullRom, SubdivisionOfRegularPolygonsHasTheCountsOfTheProcedure) {
  const auto edges = [](int n, double eps) {
    std::size_t count = 0;
    for (const CubicPiece& piece : catmull_rom(closed_polygon(n), {})) count += subdivide(piece, eps).size() + 1;
    return count;
  };
  EXPECT_EQ(edges(4, 0.01), 112u);
  for (const int n : {8, 16, 32}) EXPECT_EQ(edges(n, 0.01), 128u) << n;
  EXPECT_EQ(edges(4, 0.001), 1096u);
  for (const int n : {8, 16, 32}) EXPECT_EQ(edges(n, 0.001), 1024u) << n;
}

TEST(CatmullRom, EndsFollowTheirGivenDerivatives) {
  const std::vector<Vec2> points{{0, 0}, {1, 1}, {3, 1}};
  const auto free = catmull_rom(points, {});
  EXPECT_EQ(free[0].a[3], Vec2(0, 0));  // a parabola: its one tangent is at (1, 1)
  EXPECT_EQ(free[0].first(1), Vec2(1.5, 0.5));
  SplineEnds ends;
  ends.before = Vec2{-1, 3};
  ends.tangent_end = Vec2{0, -2};
  const auto given = catmull_rom(points, ends);
  EXPECT_EQ(given[0].first(0), Vec2(1, -1));
  EXPECT_EQ(given[1].first(1), Vec2(0, -2));
  const auto segment = catmull_rom(std::vector<Vec2>{{0, 0}, {2, 4}}, {});
  EXPECT_EQ(segment[0].at(0.25), Vec2(0.5, 1));
}

TEST(CatmullRom, PiecesMeetWithOneDerivative) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::vector<Vec2> points;
  for (int i = 0; i < 20; ++i) points.push_back({coordinate(random), coordinate(random)});
  points.push_back(points.front());
  const auto pieces = catmull_rom(points, {});
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const CubicPiece& next = pieces[(i + 1) % pieces.size()];
    EXPECT_LT(norm(Vec2(pieces[i].at(1) - next.at(0))), 1e-14);
    EXPECT_LT(norm(Vec2(pieces[i].first(1) - next.first(0))), 1e-14);
  }
}

TEST(CubicPiece, LoopIsFoundWithBothParameters) {
  const auto loop = loop_of(unit_piece({6, 4}, {6, -4}));
  ASSERT_TRUE(loop);
  EXPECT_NEAR(loop->t1, (1 - std::sqrt(0.6)) / 2, 1e-14);  // roots of t^2 - t + .1
  EXPECT_NEAR(loop->t2, (1 + std::sqrt(0.6)) / 2, 1e-14);
  EXPECT_NEAR(loop->at.x(), 0.5, 1e-14);
  EXPECT_NEAR(loop->at.y(), 0.4, 1e-14);
  EXPECT_FALSE(loop_of(unit_piece({1, 1}, {1, -1})));
  EXPECT_FALSE(loop_of(unit_piece({1, 1}, {1, 1})));
  EXPECT_FALSE(loop_of(unit_piece({0, 1}, {0, -1})));
}

TEST(CubicPiece, LoopOfAnyPieceIsADoublePoint) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-12, 12);
  int found = 0;
  for (int i = 0; i < 2000; ++i) {
    const CubicPiece piece =
        unit_piece({coordinate(random), coordinate(random)}, {coordinate(random), coordinate(random)});
    if (const auto loop = loop_of(piece)) {
      ++found;
      EXPECT_LT(norm(Vec2(piece.at(loop->t1) - piece.at(loop->t2))), 1e-10);
    }
  }
  EXPECT_GT(found, 50);
}

TEST(CubicPiece, CuspIsWhereTheDerivativeVanishes) {
  // f = (3 u^2, u^3) with u = t - 1/2.
  const CubicPiece cusp{{Vec2{0.75, -0.125}, Vec2{-3, 0.75}, Vec2{3, -1.5}, Vec2{0, 1}}};
  const auto t = cusp_of(cusp);
  ASSERT_TRUE(t);
  EXPECT_NEAR(*t, 0.5, 1e-7);
  EXPECT_FALSE(loop_of(cusp));
  EXPECT_FALSE(cusp_of(unit_piece({6, 4}, {6, -4})));
  EXPECT_FALSE(cusp_of(unit_piece({1, 1}, {1, 1})));
}

TEST(CubicPiece, TurningBackDiffersFromAPieceThatAdvances) {
  EXPECT_FALSE(turns_back(unit_piece({1, 1}, {1, -1})));
  EXPECT_TRUE(turns_back(unit_piece({-1, 1}, {1, 1})));
  EXPECT_TRUE(turns_back(unit_piece({5, 0.1}, {5, 0.1})));
}

TEST(Subdivision, ArcsOfThePageHaveTheirCounts) {
  EXPECT_EQ(subdivide(unit_piece({1, 1}, {1, -1}), 0.01).size(), 27u);  // y = t - t^2
  EXPECT_EQ(subdivide(unit_piece({1, 1}, {1, 1}), 0.01).size(), 46u);   // two extrema
  EXPECT_TRUE(subdivide(piece_between({0, 0}, {3, 1}, std::nullopt, std::nullopt), 1e-6).empty());
  EXPECT_THROW(subdivide(unit_piece({1, 1}, {1, 1}), 0), InvalidArgument);
}

TEST(Subdivision, EveryPointOfAnArcIsWithinTheToleranceOfItsEdge) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-2, 2);
  for (int i = 0; i < 100; ++i) {
    const CubicPiece piece =
        unit_piece({coordinate(random) + 2, coordinate(random)}, {coordinate(random) + 2, coordinate(random)});
    std::vector<double> t = subdivide(piece, 0.01);
    t.insert(t.begin(), 0);
    t.push_back(1);
    for (std::size_t k = 1; k < t.size(); ++k) {
      EXPECT_LT(t[k - 1], t[k]);
      const Vec2 a = piece.at(t[k - 1]), b = piece.at(t[k]);
      const Vec2 chord = b - a;
      for (int s = 1; s < 16; ++s) {
        const Vec2 p = piece.at(std::lerp(t[k - 1], t[k], s / 16.0));
        EXPECT_LE(std::abs(cross(chord, Vec2(p - a))) / norm(chord), 0.01 * norm(chord) * (1 + 1e-9));
      }
    }
  }
}

}  // namespace
}  // namespace carreau
