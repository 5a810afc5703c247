// SPDX-License-Identifier: BSD-3-Clause
#include "atlas/annulus.h"

#include <gtest/gtest.h>

#include <array>

#include "atlas/pseudo_skeleton.h"
#include "predicates/predicates.h"
#include "random_annuli.h"

namespace carreau::atlas {
namespace {

using test::Borders;

constexpr double pi = std::numbers::pi;

double circular(double difference, double period) {
  const double d = std::abs(std::remainder(difference, period));
  return d;
}

/// Partial derivatives on one side of a place: quotients of Richardson's first order, whose error is of order two.
struct Partials {
  Vec2 tau, phi;
};
Partials one_sided(const Annulus& a, double tau, double phi, double side) {
  constexpr double h = 1e-6;
  const auto at = [&](double t, double x) { return value_of(a.at(t, x)); };
  const Vec2 here = at(tau, phi + 1e-13 * side);
  const auto slope = [&](const Vec2& near, const Vec2& far, double step) -> Vec2 {
    return (4 * near - far - 3 * here) / (2 * step);
  };
  return {slope(at(tau + h, phi + 1e-13 * side), at(tau + 2 * h, phi + 1e-13 * side), h),
          slope(at(tau, phi + side * h), at(tau, phi + 2 * side * h), side * h)};
}

/// The share of the polygonal annulus that the smooth one covers.
double covered(const Annulus& a) {
  Polygon inner, outer;
  constexpr int samples = 4000;
  for (int k = 0; k < samples; ++k) {
    inner.push_back(value_of(a.at(0., a.period() * k / samples)));
    outer.push_back(value_of(a.at(1., a.period() * k / samples)));
  }
  return (signed_area(outer) - signed_area(inner)) / (signed_area(a.outer()) - signed_area(a.inner()));
}

std::vector<Borders> figures() { return {test::two_squares(), test::two_hexagons(), test::hook()}; }

std::vector<AnnulusOptions> smooth_kinds() {
  std::vector<AnnulusOptions> kinds;
  for (const bool outer_first : {false, true})
    for (const OuterBorder kind : {OuterBorder::spline, OuterBorder::cubic})
      kinds.push_back({.border = kind, .outer_first = outer_first});
  return kinds;
}
std::vector<AnnulusOptions> smooth_and_polygonal() {
  std::vector<AnnulusOptions> kinds = smooth_kinds();
  kinds.push_back({.border = OuterBorder::polygon});
  return kinds;
}

TEST(Annulus, FiguresAreDescribedByTheSkeletonAndThereAndBack) {
  for (const Borders& b : figures())
    for (const AnnulusOptions& options : smooth_and_polygonal()) {
      const Annulus a(b.inner, b.outer, options);
      EXPECT_EQ(a.pivot_choice(), PivotChoice::skeleton);
      std::mt19937_64 random(7);
      std::uniform_real_distribution<double> unit(0, 1);
      for (int k = 0; k < 1000; ++k) {
        const double tau = unit(random), phi = a.period() * unit(random);
        const auto back = a.find(a.at(tau, phi));
        ASSERT_TRUE(back.has_value());
        EXPECT_NEAR(back->tau, tau, 1e-12);
        EXPECT_LT(circular(back->phi - phi, a.period()), 1e-12);
      }
    }
}

TEST(Annulus, PolygonalBordersAreTheGivenOnes) {
  const Borders b = test::two_squares();
  const Annulus a(b.inner, b.outer, {.border = OuterBorder::polygon});
  for (int k = 0; k < 100; ++k) {
    const Vec2 in = value_of(a.at(0., k * 2 * pi / 100)), out = value_of(a.at(1., k * 2 * pi / 100));
    EXPECT_NEAR(in.cwiseAbs().maxCoeff(), 1, 1e-12);
    EXPECT_LE(out.cwiseAbs().maxCoeff(), 2 + 1e-12);
  }
  EXPECT_NEAR(signed_area(a.described_outer()), 16, 1.7);
}

TEST(Annulus, ThousandRandomOnesAreDescribed) {
  std::mt19937_64 random(1), random_outer(2);
  int made = 0, by_skeleton = 0;
  double spline = 0, cubic = 0, least = 1, worst = 0, worst_phi = 0, in_space = 0, in_space_outer = 0;
  std::uniform_real_distribution<double> unit(0, 1);
  while (made < 1000) {
    const auto borders = test::random_borders(random);
    if (!borders) continue;
    ++made;
    const Annulus a(borders->inner, borders->outer);
    const Annulus simple(borders->inner, borders->outer, {.border = OuterBorder::cubic});
    const Annulus outer(borders->inner, borders->outer, {.outer_first = true});
    const Annulus simple_outer(borders->inner, borders->outer, {.border = OuterBorder::cubic, .outer_first = true});
    by_skeleton += a.pivot_choice() == PivotChoice::skeleton;
    for (const Annulus* one : {&a, &simple, &outer, &simple_outer})
      for (int k = 0; k < 20; ++k) {
        const bool from_inside = one == &a || one == &simple;
        std::mt19937_64& source = from_inside ? random : random_outer;
        const double tau = unit(source), phi = a.period() * unit(source);
        const auto p = one->at(Jet(tau, 1, 0), Jet(phi, 0, 1));
        EXPECT_GT(p[0].u * p[1].v - p[0].v * p[1].u, 0) << "Jacobian of annulus " << made;
        const auto back = one->find(Pair<double>{p[0].f, p[1].f});
        ASSERT_TRUE(back.has_value()) << made;
        // One rounding of the point, which no inverse can undo, is 1e-16 by the width of the annulus in tau.
        const double off_tau = std::abs(back->tau - tau), off_phi = circular(back->phi - phi, a.period());
        const double width = norm(Vec2(p[0].u, p[1].u));
        double& largest = from_inside ? in_space : in_space_outer;
        largest = std::max(largest, off_tau * width);
        if (width > .01) worst = std::max(worst, off_tau);
        worst_phi = std::max(worst_phi, off_phi);
      }
    const double share = covered(a);
    spline += share, cubic += covered(simple), least = std::min(least, share);
  }
  std::cout << "pivots by the skeleton " << by_skeleton << " of " << made << "; covered by splines " << spline / made
            << ", least " << least << ", by cubics " << cubic / made << "; there and back: tau in space " << in_space
            << ", phi " << worst_phi << ", tau where wider than .01 " << worst << "\n";
  EXPECT_LT(in_space, 1e-14);
  EXPECT_LT(in_space_outer, 5e-14);  // outer borders can be nearly radial
  EXPECT_LT(worst_phi, 1e-12);
  EXPECT_LT(worst, 1e-12);
  EXPECT_GT(by_skeleton, 700);
  EXPECT_GT(spline, cubic);
}

TEST(Annulus, IsInsideThePolygonalOne) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  const std::vector<AnnulusOptions> kinds = smooth_kinds();
  int points = 0;
  while (points < 200000) {
    const auto b = test::random_borders(random);
    if (!b) continue;
    const AnnulusOptions& options = kinds[static_cast<std::size_t>(points / 999) % kinds.size()];
    const Annulus a(b->inner, b->outer, options);
    for (int k = 0; k < 999; ++k, ++points) {
      // Both borders, and between; on straight parts of the border that was given rounding decides.
      constexpr double off = 1e-9;
      const double inner = options.outer_first ? 0 : off, outer = options.outer_first ? 1 - off : 1;
      const double tau = k % 3 == 0 ? outer : (k % 3 == 1 ? inner : unit(random));
      const Vec2 p = value_of(a.at(tau, a.period() * unit(random)));
      ASSERT_TRUE(is_inside(b->outer, p));
      ASSERT_FALSE(is_inside(b->inner, p));
    }
  }
}

/// Between any two places of a part: b has no steps, and its cubics are no steeper than half again.
TEST(Annulus, OuterBordersHaveNoSteps) {
  std::mt19937_64 random(12);
  for (int made = 0; made < 200;) {
    const auto b = test::random_borders(random);
    if (!b) continue;
    ++made;
    const Annulus a(b->inner, b->outer);
    for (const Part& part : a.parts())
      for (int k = 0; k < 500; ++k) {
        const Slope ratio = part.ratio_at(Slope(part.total() * (k + .5) / 500, 1, 0));
        EXPECT_LT(std::abs(ratio.u), 3 + 1e-9);
      }
  }
}

/// One-sided slopes at a distance h of joints and vertices differ by O(h): first derivatives are continuous, and second
/// ones jump.
TEST(Annulus, SlopesOfBothSidesMeetWithOrderOne) {
  for (const Borders& b : figures()) {
    const Annulus a(b.inner, b.outer);
    const auto jump = [&](double h) {
      double largest = 0;
      for (const Part& part : a.parts())
        for (const double phi : part.phi) {
          const auto near = a.at(Slope(.4), Slope(phi - h, 0, 1)), far = a.at(Slope(.4), Slope(phi + h, 0, 1));
          largest = std::max(largest, std::hypot(near[0].v - far[0].v, near[1].v - far[1].v));
        }
      return largest;
    };
    const double order = std::log10(jump(1e-4) / jump(1e-5));
    std::cout << "slopes meet with order " << order << "\n";
    EXPECT_NEAR(order, 1, .05);
  }
}

/// Exact derivatives on both sides: knots of outer borders can be too near to one another for differences.
TEST(Annulus, IsC1FromTheOuterBorder) {
  std::mt19937_64 random(6);
  for (int made = 0; made < 200;) {
    const auto b =
        made < 3 ? std::optional<Borders>(figures()[static_cast<std::size_t>(made)]) : test::random_borders(random);
    if (!b) continue;
    ++made;
    for (const OuterBorder kind : {OuterBorder::spline, OuterBorder::cubic}) {
      const Annulus a(b->inner, b->outer, {.border = kind, .outer_first = true});
      for (const Part& part : a.parts())
        for (const double phi : part.phi)
          for (const double tau : {0., .37, 1.}) {
            // The difference of slopes at a distance h of both sides, over the slopes.
            const auto jump = [&](double h) {
              const auto left = a.at(Slope(tau, 1, 0), Slope(phi - h, 0, 1)),
                         right = a.at(Slope(tau, 1, 0), Slope(phi + h, 0, 1));
              const double scale = std::hypot(left[0].v, left[1].v) + std::hypot(left[0].u, left[1].u);
              return std::max(std::hypot(left[0].v - right[0].v, left[1].v - right[1].v),
                              std::hypot(left[0].u - right[0].u, left[1].u - right[1].u)) /
                     scale;
            };
            // Slopes change fast between knots that are 1e-5 apart, but they do not jump.
            EXPECT_LT(jump(1e-13), std::max(1e-6, .2 * jump(1e-12))) << made << " " << phi << " " << tau;
            EXPECT_LT(jump(1e-13), 1e-3);
          }
    }
  }
}

TEST(Annulus, IsC1AcrossJointsAndVerticesAndAnywhere) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const Borders& b : figures())
    for (const OuterBorder kind : {OuterBorder::spline, OuterBorder::cubic}) {
      const Annulus a(b.inner, b.outer, {.border = kind});
      std::vector<double> places;
      for (const Part& part : a.parts()) places.insert(places.end(), part.phi.begin(), part.phi.end());
      for (int k = 0; k < 1000; ++k) places.push_back(a.period() * unit(random));
      for (const double phi : places)
        for (const double tau : {0., .37, .9}) {
          const Partials left = one_sided(a, tau, phi, -1), right = one_sided(a, tau, phi, 1);
          const double scale = norm(left.phi) + norm(left.tau);
          EXPECT_LT(norm(left.phi - right.phi), 1e-6 * scale + 1e-8) << phi << " " << tau;
          EXPECT_LT(norm(left.tau - right.tau), 1e-6 * scale + 1e-8) << phi << " " << tau;
        }
    }
}

TEST(Annulus, DerivativesMatchDifferences) {
  const Borders b = test::hook();
  const Annulus a(b.inner, b.outer);
  for (int k = 0; k < 50; ++k) {
    const double tau = .3, phi = .017 + a.period() * k / 50, h = 1e-5;
    const auto p = a.at(Jet(tau, 1, 0), Jet(phi, 0, 1));
    const auto at = [&](double t, double x) { return value_of(a.at(t, x)); };
    const Vec2 d = (at(tau, phi + h) - at(tau, phi - h)) / (2 * h);
    EXPECT_NEAR(p[0].v, d.x(), 1e-3);
    EXPECT_NEAR(p[1].v, d.y(), 1e-3);
    // Chart and inverse: the product of their Jacobians is the identity.
    const auto q = a.find(Pair<Jet>{Jet(p[0].f, 1, 0), Jet(p[1].f, 0, 1)});
    ASSERT_TRUE(q.has_value());
    EXPECT_NEAR(q->tau.u * p[0].u + q->tau.v * p[1].u, 1, 1e-10);
    EXPECT_NEAR(q->tau.u * p[0].v + q->tau.v * p[1].v, 0, 1e-10);
    EXPECT_NEAR(q->phi.u * p[0].v + q->phi.v * p[1].v, 1, 1e-10);
    EXPECT_NEAR(q->phi.u * p[0].u + q->phi.v * p[1].u, 0, 1e-10);
  }
}

/// End of Atlas sec. 5.4.4: from the outer border the result covers more of the polygonal annulus, and its inner border
/// is further from the given one.
TEST(Annulus, FromTheOuterBorderMoreIsCoveredAndTheInnerBorderIsLessWellMet) {
  const auto from_inner =
      [](const Annulus& a) {  // area between the given and the smooth inner border, over the annulus'
        Polygon smooth;
        constexpr int samples = 4000;
        for (int k = 0; k < samples; ++k) smooth.push_back(value_of(a.at(0., a.period() * k / samples)));
        return (signed_area(smooth) - signed_area(a.inner())) / (signed_area(a.outer()) - signed_area(a.inner()));
      };
  const std::vector<std::array<double, 2>> printed{{.67, .76}, {.62, .81}, {.70, .72}};  // docs/reference/papers.md, splines
  for (std::size_t figure = 0; figure < printed.size(); ++figure)
    for (const OuterBorder kind : {OuterBorder::spline, OuterBorder::cubic}) {
      const Borders b = figures()[figure];
      const Annulus inner(b.inner, b.outer, {.border = kind}),
          outer(b.inner, b.outer, {.border = kind, .outer_first = true});
      std::cout << "covered from inside " << covered(inner) << ", from outside " << covered(outer)
                << "; beside the inner border " << from_inner(inner) << ", " << from_inner(outer) << "\n";
      EXPECT_GT(covered(outer), covered(inner));
      if (kind == OuterBorder::spline) {
        EXPECT_NEAR(covered(inner), printed[figure][0], .005);
        EXPECT_NEAR(covered(outer), printed[figure][1], .005);
      }
      EXPECT_GT(from_inner(outer), from_inner(inner));
    }
}

TEST(Annulus, EnclosesTheInsideOfItsSmoothBorder) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(-1, 7);
  for (const Borders& b : figures()) {
    for (const AnnulusOptions& options : smooth_kinds()) {
      const Annulus a(b.inner, b.outer, options);
      Polygon smooth;
      constexpr int samples = 20000;
      for (int k = 0; k < samples; ++k) smooth.push_back(value_of(a.at(0., a.period() * k / samples)));
      for (int k = 0; k < 500; ++k) {
        const Vec2 p(unit(random), unit(random));
        EXPECT_EQ(a.encloses(p), is_inside(smooth, p)) << p.transpose();
      }
    }
  }
}

TEST(Annulus, OnePivotServesStars) {
  const Borders b = test::two_hexagons();
  const Annulus a(b.inner, b.outer, {.star = true});
  EXPECT_EQ(a.pivot_choice(), PivotChoice::star);
  EXPECT_NEAR(norm(a.pivots().place[0]), 0, 1e-12);
  for (int k = 0; k < 60; ++k) {
    const double phi = a.period() * k / 60;
    const auto back = a.find(a.at(.5, phi));
    ASSERT_TRUE(back.has_value());
    EXPECT_LT(circular(back->phi - phi, a.period()), 1e-12);
  }
  EXPECT_TRUE(a.encloses({0, 0}));
  EXPECT_FALSE(a.encloses({1.5, 0}));
}

template <typename Make>
std::string sentence_of(Make&& make) {
  try {
    make();
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

TEST(Annulus, BadBordersAreReportedWithTheVertex) {
  const Polygon square = test::two_squares().inner;
  EXPECT_NE(sentence_of([] {
              Loop({{0, 0}, {2, 2}, {2, 0}, {0, 2}});
            }).find("from vertex 1 meets the edge from vertex 3"),
            std::string::npos);
  EXPECT_NE(sentence_of([] { Loop({{0, 0}, {0, 2}, {2, 2}, {2, 0}}); }).find("clockwise"), std::string::npos);
  EXPECT_NE(sentence_of([] { Loop({{0, 0}, {1, 0}}); }).find("2 vertices"), std::string::npos);
  EXPECT_NE(sentence_of([] { Loop({{0, 0}, {1, 0}, {1, 0}, {0, 1}}); }).find("vertices 2 and 3"), std::string::npos);
  EXPECT_NE(sentence_of([] { Loop({{0, 0}, {1, NAN}, {1, 1}}); }).find("vertex 2"), std::string::npos);
  EXPECT_NE(sentence_of([&] { Annulus(square, square); }).find("no width"), std::string::npos);
  EXPECT_NE(sentence_of([&] { Annulus(square, {{5, 5}, {6, 5}, {6, 6}}); }).find("not inside"), std::string::npos);
  EXPECT_NE(sentence_of([&] {
              Annulus(square, test::two_squares().outer, {.phi = {0, 1, 1, 2}});
            }).find("vertex 2"),
            std::string::npos);
}

}  // namespace
}  // namespace carreau::atlas
