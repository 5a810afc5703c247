// SPDX-License-Identifier: BSD-3-Clause
#include "atlas/covering/covering.h"

#include <gtest/gtest.h>

#include <random>

#include "shapes.h"
#include "support/error.h"

namespace carreau::atlas {
namespace {

/// Independent of shared_triangle.h: Atlas sec. 5.5.1.2, as printed.
double printed_outer_length(double phi) {
  const double pi = std::numbers::pi, first = std::atan(std::sqrt(3) / 5), second = std::atan(std::sqrt(3) / 2);
  if (phi <= first) return std::cos(phi) - std::sqrt(std::cos(phi) * std::cos(phi) - 13. / 16);
  if (phi <= second)
    return std::cos(pi / 6 - phi) / std::sqrt(3) + std::sqrt(std::pow(std::cos(pi / 6 - phi), 2) / 3 - 5. / 16);
  return std::cos(pi / 3 - phi) - std::sqrt(std::pow(std::cos(pi / 3 - phi), 2) - 13. / 16);
}

TEST(SharedTriangle, BorderIsC1AndGoesThroughItsClosedValues) {
  EXPECT_NEAR(inner_length, .4330127, 1e-7);
  EXPECT_NEAR(outer_length(0.), .566987, 1e-6);
  EXPECT_NEAR(outer_length(std::atan(std::sqrt(3) / 5)), .661438, 1e-6);
  EXPECT_NEAR(outer_length(std::numbers::pi / 6), .721688, 1e-6);
  for (int k = 0; k <= 60; ++k)
    EXPECT_NEAR(outer_length(sixth_turn * k / 60), printed_outer_length(sixth_turn * k / 60), 1e-14);
  for (const double at : {std::atan(std::sqrt(3) / 5), std::atan(std::sqrt(3) / 2), std::numbers::pi / 6, sixth_turn}) {
    const double before = outer_length(Jet(at - 1e-9, 1, 0)).u, behind = outer_length(Jet(at + 1e-9, 1, 0)).u;
    EXPECT_NEAR(before, behind, 1e-7);
  }
  EXPECT_NEAR(outer_length(Jet(std::atan(std::sqrt(3) / 5), 1, 0)).u, std::sqrt(7. / 12), 1e-12);
}

TEST(SharedTriangle, WeightsHaveTheSumOneAndAreC1) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int k = 0; k < 2000; ++k) {
    double a = unit(random), b = unit(random);
    if (a + b > 1) a = 1 - a, b = 1 - b;
    const Vec2 p = a * corner_of_t(1) + b * corner_of_t(2);
    const auto w = Covering::weights(parameters_at(p));
    EXPECT_NEAR(w[0].f + w[1].f + w[2].f, 1, 1e-12);
    EXPECT_NEAR(w[0].u + w[1].u + w[2].u, 0, 1e-10);
    for (const Jet& one : w) {
      EXPECT_GE(one.f, 0);
      EXPECT_LE(one.f, 1);
    }
    // Slopes on both sides of the place agree: no zone ends with a jump.
    constexpr double h = 1e-7;
    for (const Vec2& d : {Vec2(h, 0), Vec2(0, h)}) {
      const auto near = Covering::weights(pair_of(p + d)), far = Covering::weights(pair_of(p - d));
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR((near[c] - far[c]) / (2 * h), d.x() > 0 ? w[c].u : w[c].v, 1e-4);
    }
    for (int c = 0; c < 3; ++c) EXPECT_LT(norm(value_of(from_polar(c, to_polar(c, pair_of(p)))) - p), 1e-14);
  }
}

void check_transitions(const Covering& covering, double bound) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  double inverse = 0, cocycle = 0, partition = 0;
  int pairs = 0, threes = 0;
  for (std::size_t i = 0; i < covering.charts().size(); ++i)
    for (int k = 0; k < 30; ++k) {
      const Annulus& a = covering.charts()[i].annulus;
      const Vec2 m = value_of(a.at(unit(random), a.period() * unit(random)));
      const auto on = covering.on_t(i, pair_of(m));
      ASSERT_TRUE(on.has_value());
      std::vector<std::pair<std::size_t, Vec2>> others;
      double sum = covering.weight(i, m);
      for (const std::int32_t chart : covering.triples()[static_cast<std::size_t>(on->corner.triple)].chart) {
        const auto j = static_cast<std::size_t>(chart);
        const auto there = j == i ? std::nullopt : covering.transition(i, j, m);
        if (!there) continue;
        const auto back = covering.transition(j, i, *there);
        ASSERT_TRUE(back.has_value());
        inverse = std::max(inverse, norm(*back - m)), ++pairs;
        sum += covering.weight(j, *there);
        others.emplace_back(j, *there);
      }
      partition = std::max(partition, std::abs(sum - 1));
      if (others.size() < 2) continue;
      const auto around = covering.transition(others[0].first, others[1].first, others[0].second);
      if (around) cocycle = std::max(cocycle, norm(*around - others[1].second)), ++threes;
    }
  EXPECT_LT(inverse, bound);
  EXPECT_LT(cocycle, bound);
  EXPECT_LT(partition, 1e-11);
  EXPECT_GT(pairs, 100);
  EXPECT_GT(threes, 50);
}

TEST(Covering, TransitionsAreInverseAndTransitive) {
  const Covering sphere(test::icosphere(2));
  EXPECT_EQ(2 * sphere.charts().size() - sphere.triples().size(), 4u);
  check_transitions(sphere, 1e-10);
  const Covering torus(test::torus(2, .8, 36, 18));
  EXPECT_EQ(2 * torus.charts().size(), torus.triples().size());
  check_transitions(torus, 1e-10);
  check_transitions(Covering(test::torus(2, .8, 36, 18), {.hops = 2, .border = OuterBorder::cubic}), 1e-10);
}

/// Atlas fig. 5.22: the triple zones of a chart are the images of the disc of radius sqrt 3 / 12 about the middle of T,
/// one a corner, each touches both borders of the annulus at one place, and double zones lie between them.
TEST(Covering, ZonesOfAChartAreImagesOfADisc) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  const Vec2 middle = (corner_of_t(0) + corner_of_t(1) + corner_of_t(2)) / 3;
  for (const bool outer_first : {false, true})
    for (const OuterBorder border : {OuterBorder::spline, OuterBorder::cubic}) {
      const Covering covering(test::torus(2, .8, 36, 18), {.border = border, .outer_first = outer_first});
      const auto charts_at = [&](std::size_t i, const Vec2& m) {
        const auto on = covering.on_t(i, pair_of(m));
        const std::array<double, 3> w = Covering::weights(on->place);
        return std::count_if(w.begin(), w.end(), [](double x) { return x > 0; });
      };
      int doubles = 0, triples = 0;
      for (std::size_t i = 0; i < covering.charts().size(); ++i) {
        const Annulus& a = covering.charts()[i].annulus;
        for (int k = 0; k < 50; ++k) {
          const Vec2 m = value_of(a.at(unit(random), a.period() * unit(random)));
          const double off = norm(value_of(covering.on_t(i, pair_of(m))->place) - middle) - std::sqrt(3) / 12;
          if (std::abs(off) < 1e-9) continue;
          EXPECT_EQ(charts_at(i, m), off < 0 ? 3 : 2);
          ++(off < 0 ? triples : doubles);
        }
        for (std::size_t k = 0; k < covering.charts()[i].corners.size(); ++k) {
          const double at = (static_cast<double>(k) + .5) * sixth_turn;
          for (const double tau : {1e-6, 1 - 1e-6}) EXPECT_EQ(charts_at(i, value_of(a.at(tau, at))), 3);
          for (const double tau : {1e-6, .5, 1 - 1e-6})
            EXPECT_EQ(charts_at(i, value_of(a.at(tau, at + sixth_turn / 2))), 2);
        }
      }
      EXPECT_GT(triples, 100);
      EXPECT_GT(doubles, 100);
    }
}

/// Atlas fig. 5.23: the part of a chart that it shares with a neighbour is mapped onto the neighbour's part. Both have
/// the area that the Jacobian of the transition gives, which is positive.
TEST(Covering, TransitionsMapSharedPartsOntoOneAnother) {
  for (const bool outer_first : {false, true}) {
    const Covering covering(test::icosphere(2), {.outer_first = outer_first});
    constexpr int n = 96;
    for (std::size_t t = 0; t < covering.triples().size(); ++t) {
      const Triple& triple = covering.triples()[t];
      const auto number = static_cast<std::int32_t>(t);
      double by_jacobian = 0, by_places = 0;
      // Corners 0 and 1 share the places whose strata lie below 1 in both.
      for (int i = 0; i < n; ++i)
        for (int j = 0; i + j < n; ++j) {
          const Vec2 place = ((i + 1. / 3) * corner_of_t(1) + (j + 1. / 3) * corner_of_t(2)) / n;
          bool shared = true;
          for (int c = 0; c < 2; ++c) {
            const double tau = share_of(to_polar(c, pair_of(place)));
            shared = shared && tau > .02 && tau < .98;
          }
          if (!shared) continue;
          const auto area = [&](int c) {
            const Pair<Jet> at = covering.from_t(number, c, parameters_at<Jet>(place));
            return at[0].u * at[1].v - at[0].v * at[1].u;
          };
          const Vec2 m = value_of(covering.from_t(number, 0, pair_of(place)));
          constexpr double h = 1e-7;
          const auto to = [&](const Vec2& p) {
            return covering.transition(static_cast<std::size_t>(triple.chart[0]),
                                       static_cast<std::size_t>(triple.chart[1]), p);
          };
          const auto east = to(m + Vec2(h, 0)), west = to(m - Vec2(h, 0)), north = to(m + Vec2(0, h)),
                     south = to(m - Vec2(0, h));
          ASSERT_TRUE(east && west && north && south);
          const double jacobian = cross(*east - *west, *north - *south) / (4 * h * h);
          EXPECT_GT(jacobian, 0);
          by_jacobian += jacobian * area(0), by_places += area(1);
        }
      EXPECT_NEAR(by_jacobian / by_places, 1, 1e-4);
    }
  }
}

TEST(Covering, IsTheSameEachTime) {
  const Covering once(test::torus(2, .8, 36, 18)), again(test::torus(2, .8, 36, 18));
  ASSERT_EQ(once.charts().size(), again.charts().size());
  for (std::size_t i = 0; i < once.charts().size(); ++i) {
    EXPECT_EQ(once.charts()[i].members, again.charts()[i].members);
    EXPECT_EQ(value_of(once.charts()[i].annulus.at(.3, 1.)), value_of(again.charts()[i].annulus.at(.3, 1.)));
  }
}

TEST(Covering, CoarseSurfacesAreDivided) {
  const Covering covering(test::icosphere(0));
  EXPECT_GT(covering.surface().triangles.size(), 20u);
  EXPECT_EQ(2 * covering.charts().size() - covering.triples().size(), 4u);
}

TEST(Clusters, EachIsADiscWithAPureZone) {
  const Triangulation surface = test::icosphere(3);
  const Fans fans(surface);
  for (const int hops : {1, 2}) {
    Partition partition = grown_clusters(surface, fans, hops);
    repair_clusters(surface, fans, partition);
    for (const std::string& defect : defects(surface, fans, partition)) EXPECT_EQ(defect, "");
  }
}

TEST(Triangulation, DivisionKeepsEulersNumberAndArea) {
  const Triangulation coarse = test::torus(2, 1, 8, 6), fine = subdivided(coarse);
  EXPECT_EQ(fine.triangles.size(), 4 * coarse.triangles.size());
  EXPECT_EQ(2 * fine.vertices.size(), fine.triangles.size());
  const auto area = [](const Triangulation& s) {
    double sum = 0;
    for (const auto& t : s.triangles) sum += norm(area_vector(s, t[0], t[1], t[2]));
    return sum;
  };
  EXPECT_NEAR(area(coarse), area(fine), 1e-10);
}

}  // namespace
}  // namespace carreau::atlas
