// SPDX-License-Identifier: BSD-3-Clause
#include "atlas/loop.h"

#include <gtest/gtest.h>

#include "atlas/pseudo_skeleton.h"
#include "predicates/predicates.h"
#include "random_annuli.h"

namespace carreau::atlas {
namespace {

TEST(Hermite, IncreasesAndHasItsInverse) {
  // Slopes up to the chord's own (Atlas eq. 5.5).
  for (const double s1 : {.01, .5, 1.5})
    for (const double s2 : {.01, .7, 1.5}) {
      const HermiteData<double> h{1, 3, -1, 2, s1, s2};
      EXPECT_NEAR(hermite(h, 1.), -1, 1e-15);
      EXPECT_NEAR(hermite(h, 3.), 2, 1e-15);
      EXPECT_NEAR(hermite(h, Jet(1, 1, 0)).u, s1, 1e-14);
      EXPECT_NEAR(hermite(h, Jet(3, 1, 0)).u, s2, 1e-14);
      EXPECT_NEAR(hermite(h, Jet(2, 1, 0)).u, hermite(h, Jet(2 + 1e-12, 1, 0)).u, 1e-10);
      double before = -1;
      for (int k = 1; k <= 100; ++k) {
        const double x = 1 + 2. * k / 100, y = hermite(h, x);
        EXPECT_GT(y, before);
        EXPECT_NEAR(hermite_inverse(h, y), x, 1e-13);
        before = y;
      }
    }
}

TEST(PseudoSkeleton, TriangulatesWithoutNewPoints) {
  std::mt19937_64 random(2);
  for (int k = 0; k < 100; ++k) {
    const Polygon p = test::random_star(random, 4 + static_cast<std::size_t>(k) / 2, .8);
    const PseudoSkeleton s = pseudo_skeleton(p);
    ASSERT_EQ(s.triangles.size(), p.size() - 2);
    EXPECT_GE(s.ears.size(), 2u);
    double area = 0;
    for (const auto& t : s.triangles) {
      EXPECT_EQ(orientation(p[t[0]], p[t[1]], p[t[2]]), 1);
      area += cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]) / 2;
    }
    EXPECT_NEAR(area, signed_area(p), 1e-12);
    for (const auto& e : s.edges) {
      EXPECT_TRUE(is_inside(p, e.first));
      EXPECT_TRUE(is_inside(p, e.second));
    }
  }
}

TEST(Loop, LiesOnItsPolygonAndThereAndBack) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Polygon> polygons = {test::two_squares().inner, test::two_hexagons().inner, test::hook().inner,
                                   test::spiral(2, 40, .5)};
  for (int k = 0; k < 40; ++k) polygons.push_back(test::random_star(random, 4 + static_cast<std::size_t>(k), .6));
  for (const Polygon& p : polygons)
    for (const LoopSpeed speed : {LoopSpeed::even, LoopSpeed::smooth}) {
      const Loop loop(p, speed);
      EXPECT_LT(norm(loop.at(0).point - p[0]), 1e-12);
      for (int k = 0; k < 200; ++k) {
        const double phi = loop.period() * unit(random);
        const Vec2 m = loop.at(phi).point;
        double distance = 1;
        for (std::size_t e = 0; e < p.size(); ++e) {
          const Vec2 edge = p[next_of(e, p.size())] - p[e];
          const double share = std::clamp(dot(m - p[e], edge) / dot(edge, edge), 0., 1.);
          distance = std::min(distance, norm(m - p[e] - share * edge));
        }
        EXPECT_LT(distance, 1e-12);
        EXPECT_NEAR(std::remainder(loop.phi_of(m, 1e-9) - phi, loop.period()), 0, 1e-9);
      }
    }
}

TEST(Loop, PivotsMeetTheirConditions) {
  std::mt19937_64 random(4);
  for (int k = 0; k < 200; ++k) {
    const Polygon p = test::random_star(random, 4 + static_cast<std::size_t>(k) % 57, .7);
    Pivots pivots = Loop(p).pivots();
    const std::vector<char> wrong = wrong_pivots(p, pivots);
    EXPECT_EQ(std::count(wrong.begin(), wrong.end(), 1), 0);
    EXPECT_EQ(pivots.size() % 2, 0u);
    for (std::size_t i = 0; i < pivots.size(); ++i) EXPECT_EQ(is_inside(p, pivots.place[i]), pivots.is_inside(i));
  }
}

TEST(Loop, WrongPivotsAreFound) {
  const Polygon square = test::two_squares().inner;
  const auto wrong = [&](Pivots pivots) {
    const auto marks = wrong_pivots(square, pivots);
    return std::count(marks.begin(), marks.end(), 1);
  };
  EXPECT_EQ(wrong({{{.3, -.3}, {1.5, 1.5 - .01}, {-.3, .3}, {-1.5, -1.5 + .01}}}), 0);
  EXPECT_GT(wrong({{{.3, -.3}, {1.5, 1.5}, {-.3, .3}, {-1.5, 1.5}}}), 0);   // both cross the same side
  EXPECT_GT(wrong({{{.3, -.3}, {.5, .5}, {-.3, .3}, {-1.5, -1.5}}}), 0);    // inside where it should be outside
  EXPECT_GT(wrong({{{-.3, .3}, {1.5, 1.4}, {.3, -.3}, {-1.5, -1.4}}}), 0);  // the wrong way round
}

TEST(Loop, IsC1WherePivotsChange) {
  const Loop loop(test::hook().inner);
  // Everywhere but at vertices, where the polygon itself turns.
  constexpr int samples = 20000;
  int turns = 0;
  for (int k = 0; k < samples; ++k) {
    const double phi = loop.period() * k / samples, step = loop.period() / samples;
    turns += norm(loop.at(phi + step).derivative - loop.at(phi).derivative) > .2 * norm(loop.at(phi).derivative);
  }
  EXPECT_EQ(turns, 10);
}

}  // namespace
}  // namespace carreau::atlas
