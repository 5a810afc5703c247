// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "cad/difference_cad.h"
#include "cad/fundamental_forms.h"
#include "cad/parameter_domain.h"
#include "cad/stencil.h"
#include "surfaces.h"

namespace carreau {
namespace {

using namespace testing;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double apply(const Stencil& stencil, int order, double x, double step) {
  double sum = 0;
  for (int i = 0; i < stencil.count; ++i) sum += stencil.weight[i] * std::exp(2 * (x + stencil.offset[i] * step));
  return sum / std::pow(step, order);
}

TEST(Stencil, ConvergesToSecondOrderOnEverySide) {
  const double x = 0.3;
  for (const int order : {1, 2})
    for (const Side side : {Side::central, Side::forward, Side::backward}) {
      const double exact = std::pow(2, order) * std::exp(2 * x);
      const Stencil stencil = stencil_of(order, side);
      const double coarse = std::abs(apply(stencil, order, x, 1.0 / 64) - exact);
      const double fine = std::abs(apply(stencil, order, x, 1.0 / 128) - exact);
      EXPECT_NEAR(std::log2(coarse / fine), 2, 0.12) << "order " << order << ", side " << static_cast<int>(side);
    }
}

TEST(DifferenceStep, KeepsTheLongestStencilInside) {
  for (const double low : {-1.0, 0.0, 1e6})
    for (const double range : {1e-6, 1.0, 1e5})
      for (const double share : {0.0, 1e-9, 1e-6, 0.3, 0.999999, 1.0}) {
        const double high = low + range, x = std::min(low + share * range, high);
        for (const double relative : {1e-5, 2e-4, 0.5}) {
          const DifferenceStep step = difference_step(x, low, high, relative);
          ASSERT_GT(step.step, 0);
          EXPECT_EQ(std::exp2(std::round(std::log2(step.step))), step.step);
          for (const int order : {1, 2}) {
            const Stencil stencil = stencil_of(order, step.side);
            for (int i = 0; i < stencil.count; ++i) {
              EXPECT_GE(x + stencil.offset[i] * step.step, low);
              EXPECT_LE(x + stencil.offset[i] * step.step, high);
            }
          }
        }
      }
}

/// Torus whose derivatives above `gives` are wrong, so that a test sees whether they are used; a stencil that leaves
/// `inside` gets NaN.
struct Source : FaceCad {
  std::function<bool(Vec2)> inside = [](Vec2) { return true; };
  std::vector<Vec2> asked;
  std::function<Vec2(int, double)> curve_of;  ///< empty: `along`
  CurveJet curve(int face, int ic, unsigned want, double t) override {
    return curve_of ? CurveJet{curve_of(ic, t), {}, {}} : FaceCad::curve(face, ic, want, t);
  }
  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override {
    EXPECT_EQ(want & ~gives, 0U);
    FaceCad::surface(face, want, uv, out);
    for (std::size_t i = 0; i < uv.size(); ++i) {
      asked.push_back(uv[i]);
      if (!inside(uv[i])) out[i] = {{nan, nan, nan}, {nan, nan, nan}, {nan, nan, nan}, {}, {}, {}};
    }
  }
};

SurfaceJet exact(Vec2 p) { return torus_jet(p, 2, 0.7); }

DifferenceCad differenced(unsigned gives, Source** source = nullptr) {
  auto host = std::make_unique<Source>();
  host->jet = exact;
  host->gives = gives;
  if (source != nullptr) *source = host.get();
  return {std::move(host), gives, gives};
}

void expect_first(const SurfaceJet& jet, Vec2 p, double tolerance) {
  EXPECT_LE(norm(jet.su - exact(p).su), tolerance);
  EXPECT_LE(norm(jet.sv - exact(p).sv), tolerance);
}

void expect_second(const SurfaceJet& jet, Vec2 p, double tolerance) {
  EXPECT_LE(norm(jet.suu - exact(p).suu), tolerance);
  EXPECT_LE(norm(jet.suv - exact(p).suv), tolerance);
  EXPECT_LE(norm(jet.svv - exact(p).svv), tolerance);
}

constexpr unsigned everything = want_position | want_first | want_second;

TEST(DifferenceCad, FindsDerivativesFromPositions) {
  DifferenceCad cad = differenced(want_position);
  cad.set_parameter_box(1, {0, 0}, {2, 3});
  for (const Vec2& p : {Vec2{1, 1}, Vec2{0, 0}, Vec2{2, 3}, Vec2{0, 1.7}, Vec2{1.99999999, 1e-9}}) {
    const SurfaceJet jet = surface_at(cad, 1, everything, p);
    EXPECT_EQ(jet.s, exact(p).s);
    expect_first(jet, p, 4e-9);
    expect_second(jet, p, 2e-6);
  }
}

TEST(DifferenceCad, FindsSecondDerivativesFromFirstOnes) {
  DifferenceCad cad = differenced(want_position | want_first);
  cad.set_parameter_box(1, {0, 0}, {2, 3});
  for (const Vec2& p : {Vec2{1, 1}, Vec2{0, 0}, Vec2{2, 3}}) {
    const SurfaceJet jet = surface_at(cad, 1, everything, p);
    EXPECT_EQ(jet.su, exact(p).su);
    expect_second(jet, p, 1e-8);
  }
}

TEST(DifferenceCad, FindsFirstDerivativesWhenOnlyTheSecondOnesAreGiven) {
  DifferenceCad cad = differenced(want_position | want_second);
  const SurfaceJet jet = surface_at(cad, 1, everything, {1, 1});
  expect_first(jet, {1, 1}, 1e-8);
  EXPECT_EQ(jet.suu, exact({1, 1}).suu);
}

TEST(DifferenceCad, StaysInsideTheBox) {
  Source* source = nullptr;
  for (const unsigned gives : {unsigned{want_position}, want_position | want_first}) {
    DifferenceCad cad = differenced(gives, &source);
    const Vec2 low{0.25, -3}, high{0.75, 100};
    cad.set_parameter_box(1, low, high);
    for (const Vec2& p : {low, high, Vec2{low.x(), high.y()}, Vec2{0.25000001, 99.9999}, Vec2{0.5, 0}})
      surface_at(cad, 1, everything, p);
    for (const Vec2& p : source->asked) {
      EXPECT_TRUE(low.x() <= p.x() && p.x() <= high.x() && low.y() <= p.y() && p.y() <= high.y()) << p.x() << " " << p.y();
    }
  }
}

TEST(DifferenceCad, TakesOtherSidesWhereTheHostIsNotDefined) {
  // A disc, which its box does not reveal.
  for (const unsigned gives : {unsigned{want_position}, want_position | want_first}) {
    Source* source = nullptr;
    DifferenceCad cad = differenced(gives, &source);
    cad.set_parameter_box(1, {-1, -1}, {1, 1});
    source->inside = [](Vec2 p) { return dot(p, p) <= 1; };
    for (const Vec2& p : {Vec2{0.6, 0.7999999999}, Vec2{-0.6, 0.7999999999}, Vec2{0.6, -0.7999999999}}) {
      const SurfaceJet jet = surface_at(cad, 1, everything, p);
      expect_first(jet, p, 1e-8);
      expect_second(jet, p, 1e-5);
    }
  }
}

TEST(DifferenceCad, ReportsWhereNoDifferenceIsFinite) {
  Source* source = nullptr;
  DifferenceCad cad = differenced(want_position, &source);
  source->inside = [](Vec2 p) { return p == Vec2{0.5, 0.5}; };
  const std::string text = callback_error([&] { surface_at(cad, 7, want_first, {0.5, 0.5}); });
  EXPECT_NE(text.find("face 7"), std::string::npos) << text;
  EXPECT_NE(text.find("u = 0.5, v = 0.5"), std::string::npos) << text;
  EXPECT_NE(text.find("first derivatives are not given"), std::string::npos) << text;
}

TEST(DifferenceCad, AnswersABatchAsItAnswersSinglePoints) {
  DifferenceCad cad = differenced(want_position);
  cad.set_parameter_box(1, {0, 0}, {1, 1});
  std::vector<Vec2> points;
  for (int i = 0; i < 1500; ++i) points.push_back({(i % 40) / 39.0, i / 1499.0});
  std::vector<SurfaceJet> jets(points.size());
  cad.surface(1, everything, points, jets);
  for (std::size_t i = 0; i < points.size(); i += 7) {
    const SurfaceJet alone = surface_at(cad, 1, everything, points[i]);
    EXPECT_EQ(alone.su, jets[i].su);
    EXPECT_EQ(alone.suv, jets[i].suv);
  }
}

TEST(DifferenceCad, KeepsItsAccuracyFarFromTheOrigin) {
  auto host = std::make_unique<Source>();
  const double far = 1e6;
  host->jet = [&](Vec2 p) { return exact({p.x() - far, p.y()}); };
  host->gives = want_position;
  DifferenceCad cad(std::move(host), want_position, want_position);
  cad.set_parameter_box(1, {far, 0}, {far + 1, 1});
  expect_first(surface_at(cad, 1, want_first, {far + 0.5, 0.5}), {0.5, 0.5}, 1e-6);
}

TEST(DifferenceCad, FindsDerivativesOfCurvesInsideTheirInterval) {
  for (const unsigned gives : {unsigned{want_position}, want_position | want_first, want_position | want_second}) {
    auto host = std::make_unique<FaceCad>();
    const auto along = host->along;
    host->along = [along](double t) {
      EXPECT_TRUE(0 <= t && t <= 2) << t;
      return along(t);
    };
    DifferenceCad cad(std::move(host), everything, gives);
    for (const double t : {0.0, 1e-7, 1.0, 1.9999999, 2.0}) {
      const CurveJet jet = cad.curve(1, 1, everything, t);
      EXPECT_EQ(jet.c, along(t).c);
      EXPECT_LE(norm(jet.ct - along(t).ct), 1e-8) << t;
      EXPECT_LE(norm(jet.ctt - along(t).ctt), (gives & want_first) != 0 ? 1e-7 : 1e-5) << t;
    }
  }
}

/// A curve of the plane by samples: C(t) for t in [a, b].
BoundaryCurve sampled(int ic, double a, double b, int samples, const std::function<Vec2(double)>& c) {
  BoundaryCurve curve{.ic = ic, .t = {}, .uv = {}};
  for (int i = 0; i <= samples; ++i) {
    curve.t.push_back(i == samples ? b : a + (b - a) * i / samples);
    curve.uv.push_back(c(curve.t.back()));
  }
  return curve;
}

constexpr double pi = std::numbers::pi;
Vec2 on_circle(double r, double t) { return {r * std::cos(t), r * std::sin(t)}; }

TEST(ParameterDomain, AdmitsStepsThatStayInside) {
  const auto circle = [](double r) { return [r](double t) { return on_circle(r, t); }; };
  const std::vector<BoundaryCurve> boundary{sampled(1, 0, 2 * pi, 200, circle(1)), sampled(2, 0, 2 * pi, 200, circle(0.5))};
  const ParameterDomain ring(boundary);
  for (int i = 0; i < 1000; ++i) {
    const double t = 0.37 * i;
    for (const auto& [r, inward] : {std::pair{1.0, -1.0}, {0.5, 1.0}})
      for (const double step : {1e-9, 1e-5, 1e-3}) {
        const Vec2 p = on_circle(r, t);
        for (int k = 0; k < 24; ++k) {
          const Vec2 q = p + step * Vec2{std::cos(k * pi / 12), std::sin(k * pi / 12)};
          EXPECT_TRUE(!ring.admits(p, {&q, 1}) || (norm(q) < 1 && norm(q) > 0.5)) << i << " " << step << " " << k;
        }
        const Vec2 inside = on_circle(r + inward * step, t), outside = on_circle(r - inward * step, t);
        EXPECT_TRUE(ring.admits(p, {&inside, 1})) << i << " " << step;
        EXPECT_FALSE(ring.admits(p, {&outside, 1})) << i << " " << step;
      }
  }
  const Vec2 beside{0.76, 0.01};
  EXPECT_TRUE(ring.admits({0.75, 0}, {&beside, 1}));
}

TEST(DifferenceCad, NeverLeavesADomainWhoseBoundaryIsKnown) {
  struct Shape {
    const char* name;
    std::function<bool(Vec2)> contains;
    std::function<Vec2(int, double)> curve;
    std::vector<BoundaryCurve> boundary;
  };
  const auto disc = [](int, double t) { return on_circle(0.9, t); };
  const auto ring = [](int ic, double t) { return on_circle(ic == 1 ? 0.9 : 0.3, t); };
  // Corners of 16 degrees at its ends.
  const auto lens = [](int ic, double t) -> Vec2 { return {t, (ic == 1 ? -1 : 1) * 0.1 * (0.64 - t * t) / 0.64}; };
  const auto of = [](const auto& curve, int ic, double a, double b, int n) {
    return sampled(ic, a, b, n, [&](double t) -> Vec2 { return curve(ic, t); });
  };
  const double outer = 0.81 * (1 + 1e-13), inner = 0.09 * (1 - 1e-13);
  const std::vector<Shape> shapes{
      {"disc", [=](Vec2 p) { return dot(p, p) <= outer; }, disc, {of(disc, 1, 0, 2 * pi, 400)}},
      {"ring", [=](Vec2 p) { return dot(p, p) <= outer && dot(p, p) >= inner; }, ring, {of(ring, 1, 0, 2 * pi, 400), of(ring, 2, 0, 2 * pi, 400)}},
      {"lens", [](Vec2 p) { return std::abs(p.y()) <= 0.1 * (0.64 - p.x() * p.x()) / 0.64 + 1e-15; }, lens, {of(lens, 1, -0.8, 0.8, 50), of(lens, 2, -0.8, 0.8, 50)}}};
  for (const unsigned gives : {unsigned{want_position}, want_position | want_first})
    for (const Shape& shape : shapes) {
      auto host = std::make_unique<Source>();
      host->jet = exact;
      host->gives = gives;
      Source* source = host.get();
      host->curve_of = shape.curve;
      DifferenceCad cad(std::move(host), gives, gives);
      cad.set_parameter_box(1, {-0.9, -0.9}, {0.9, 0.9});
      cad.set_boundary(1, shape.boundary);
      for (const BoundaryCurve& curve : shape.boundary)
        for (int i = 0; i <= 60; ++i) {
          const Vec2 p = shape.curve(curve.ic, curve.t.front() + (curve.t.back() - curve.t.front()) * i / 60);
          const SurfaceJet jet = surface_at(cad, 1, everything, p);
          expect_first(jet, p, 1e-6);
          expect_second(jet, p, 1e-2);
        }
      for (const Vec2& p : source->asked) ASSERT_TRUE(shape.contains(p)) << shape.name << ": " << p.x() << " " << p.y();
    }
}

/// A crescent: the unit disc without a disc at .6, with corners of 35 degrees.
Vec2 on_crescent(int ic, double t) { return ic == 1 ? on_circle(1, t) : Vec2{0.6 - std::cos(t), std::sin(t)}; }
bool in_crescent(Vec2 p) { return norm(p) <= 1 && norm(p - Vec2{0.6, 0}) >= 1; }
std::vector<BoundaryCurve> around_crescent() {
  const double corner = std::acos(0.3);
  const auto of = [](int ic, double a, double b) { return sampled(ic, a, b, 40, [ic](double t) { return on_crescent(ic, t); }); };
  return {of(1, corner, 2 * pi - corner), of(2, -corner, corner)};
}

TEST(TrimmedDomain, DecidesByTheCurves) {
  auto host = std::make_unique<Source>();
  host->curve_of = on_crescent;
  DifferenceCad cad(std::move(host), want_position, want_position);
  const TrimmedDomain crescent(1, around_crescent());
  std::vector<Vec2> places;
  for (int i = -100; i <= 100; ++i)
    for (int j = -100; j <= 100; ++j) places.emplace_back(0.0103 * i, 0.0103 * j);
  for (int i = 0; i < 4000; ++i) places.push_back(on_crescent(1, std::acos(0.3)) + on_circle(std::pow(10, -1 - i % 1000 * 0.005), 0.618 * i));
  for (const Vec2& p : places) {
    EXPECT_EQ(crescent.contains(p, cad), in_crescent(p)) << p.transpose();
    const std::optional<Vec2> closest = crescent.closest_from_outside(p, cad);
    EXPECT_EQ(closest.has_value(), !in_crescent(p));
    if (closest) {
      EXPECT_NEAR(std::min(std::abs(norm(*closest) - 1), std::abs(norm(*closest - Vec2{0.6, 0}) - 1)), 0, 1e-13);
    }
  }
  for (const BoundaryCurve& curve : around_crescent())
    for (const Vec2& p : curve.uv) EXPECT_TRUE(crescent.contains(p, cad)) << p.transpose();
}

TEST(DifferenceCad, ExtrapolatesPlacesOutside) {
  // Third differences of the positions bound the error; the host is not called outside.
  auto host = std::make_unique<Source>();
  host->jet = exact;
  host->curve_of = on_crescent;
  Source* const source = host.get();
  DifferenceCad cad(std::move(host), want_position, want_position);
  cad.set_parameter_box(1, {-1, -1}, {0.6, 1});
  cad.set_boundary(1, around_crescent());
  for (const double d : {0.01, 0.001})
    for (int i = -10; i <= 10; ++i) {
      const Vec2 p = Vec2{0.6, 0} - (1 - d) * on_circle(1, 0.1 * i);
      const SurfaceJet jet = surface_at(cad, 1, everything, p);
      EXPECT_LE(norm(jet.s - exact(p).s), 10 * d * d * d + 1e-12) << d;
      EXPECT_LE(norm(jet.su - exact(p).su), 10 * d);
    }
  for (const Vec2& p : source->asked) EXPECT_LE(1, norm(p - Vec2{0.6, 0}) + 1e-12) << p.transpose();
}

TEST(DifferenceCad, TakesCurvaturesFromInsideIfTheBoundaryIsSingular) {
  // A hemisphere over its disc: slopes are infinite on the circle.
  auto host = std::make_unique<Source>();
  host->jet = [](Vec2 p) { return SurfaceJet{{p.x(), p.y(), std::sqrt(std::max(0.0, 1 - dot(p, p)))}, {}, {}, {}, {}, {}}; };
  host->curve_of = [](int, double t) { return on_circle(1, t); };
  DifferenceCad cad(std::move(host), want_position, want_position);
  cad.set_parameter_box(1, {-1, -1}, {1, 1});
  cad.set_boundary(1, {sampled(1, 0, 2 * pi, 200, [](double t) { return on_circle(1, t); })});
  for (int i = 0; i < 20; ++i) {
    const SurfaceJet jet = surface_at(cad, 1, everything, on_circle(1, i));
    const PrincipalFrame frame = principal_frame(jet).value();
    EXPECT_NEAR(std::abs(frame.k1), 1, 0.01);
    EXPECT_NEAR(std::abs(frame.k2), 1, 0.01);
  }
}

TEST(DifferenceCad, RejectsInvalidBoxes) {
  DifferenceCad cad = differenced(want_position);
  EXPECT_THROW(cad.set_parameter_box(1, {0, 0}, {0, 1}), InvalidArgument);
  EXPECT_THROW(cad.set_parameter_box(1, {0, nan}, {1, 1}), InvalidArgument);
}

}  // namespace
}  // namespace carreau
