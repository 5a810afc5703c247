// SPDX-License-Identifier: BSD-3-Clause
#include "curve/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analytic_cad.h"
#include "support/error.h"

namespace {

using namespace carreau;
using namespace carreau::testing_cad;
using std::numbers::pi;

AnalyticCad cad_of(Surface surface, PlaneCurve curve) {
  AnalyticCad cad;
  cad.surfaces[1] = std::move(surface);
  cad.curves[{1, 1}] = std::move(curve);
  return cad;
}

PlaneCurve circle(double radius, double from, double to) {
  return {{from, to}, [radius](double t) {
            const double c = radius * std::cos(t), s = radius * std::sin(t);
            return CurveJet{{c, s}, {-s, c}, {-c, -s}};
          }};
}

/// The ellipse of HDR eq. 2.5-2.6.
PlaneCurve hdr_ellipse() {
  return plane_curve({0, 1}, [](double t) {
    const double alpha = -pi / 6 + std::pow(std::max(t, 0.), 1.8) * (pi + pi / 3);
    return Vec2{2 * std::cos(alpha), std::sin(alpha)};
  });
}

/// Length of the ellipse from angle a to b, by Simpson's rule.
double ellipse_length(double a, double b) {
  const int n = 20000;
  double sum = 0;
  for (int i = 0; i <= n; ++i) {
    const double x = a + (b - a) * i / n;
    sum += (i == 0 || i == n ? 1 : (i % 2 == 1 ? 4 : 2)) * std::hypot(2 * std::sin(x), std::cos(x));
  }
  return (b - a) * sum / (3 * n);
}

double parabola_length(double x) { return (x * std::sqrt(1 + x * x) + std::asinh(x)) / 2; }  // from 0, z = x^2 / 2

/// Largest deviation from linear interpolation in t, in space and in the plane (PL), over the tolerance: an arc that
/// makes `degrees` with its chord at both ends, or the fraction of the whole length at which refinement ends.
struct Linearity {
  double space = 0, plane = 0;
  double angle_deg = 0;  ///< between an edge and the curve's tangent, by differences
};

Linearity linearity(AnalyticCad& cad, const CurveSupport& s, double degrees) {
  const double allowed = std::tan(degrees * pi / 360) / 2;
  const double least = 2e-6;
  double plane_length = 0;
  for (std::size_t i = 0; i + 1 < s.t.size(); ++i) plane_length += norm(s.uv[i + 1] - s.uv[i]);
  Linearity worst;
  const auto point = [&](double t) { return surface_at(cad, 1, want_position, cad.curve(1, 1, want_position, t).c).s; };
  for (std::size_t i = 0; i + 1 < s.t.size(); ++i) {
    const double chord = norm(s.xyz[i + 1] - s.xyz[i]);
    const double plane_chord = norm(s.uv[i + 1] - s.uv[i]);
    for (int k = 1; k < 16; ++k) {
      const double w = k / 16.;
      const double t = (1 - w) * s.t[i] + w * s.t[i + 1];
      worst.space = std::max(worst.space, norm(point(t) - lerp(s.xyz[i], s.xyz[i + 1], w)) /
                                              std::max(allowed * chord, least * s.length()));
      const Vec2 uv = cad.curve(1, 1, want_position, t).c;
      worst.plane = std::max(worst.plane, norm(uv - lerp(s.uv[i], s.uv[i + 1], w)) /
                                              std::max(allowed * plane_chord, least * plane_length));
    }
    const double step = 1e-3 * (s.t[i + 1] - s.t[i]);
    for (const double t : {s.t[i] + step, s.t[i + 1] - step}) {
      const Vec3 tangent = point(t + step) - point(t - step);
      const double sine = norm(cross(tangent, s.xyz[i + 1] - s.xyz[i])) / (norm(tangent) * chord);
      worst.angle_deg = std::max(worst.angle_deg, std::asin(std::min(sine, 1.)) * 180 / pi);
    }
  }
  return worst;
}

TEST(BuildSupport, StraightLineTakesAHandfulOfCalls) {
  AnalyticCad cad = cad_of(flat(), segment({0, 0}, {3, 4}));
  const CurveSupport s = build_support(cad, 1, 1, {});
  EXPECT_LE(cad.calls.surf0, 10);
  EXPECT_NEAR(s.length(), 5, 1e-14);
  EXPECT_NEAR(s.t_at_arc(1.25), 0.25, 1e-15);
  EXPECT_FALSE(s.limited);
}

TEST(BuildSupport, SamplesAreValuesOfTheHostAndAscend) {
  AnalyticCad cad = cad_of(paraboloid(), segment({-2.5, -2.5}, {2.5, -2.5}));
  const CurveSupport s = build_support(cad, 1, 1, {});
  EXPECT_EQ(s.t.front(), 0);
  EXPECT_EQ(s.t.back(), 1);
  ASSERT_EQ(s.t.size(), s.uv.size());
  ASSERT_EQ(s.t.size(), s.xyz.size());
  ASSERT_EQ(s.t.size(), s.arc.size());
  for (std::size_t i = 0; i < s.t.size(); ++i) {
    EXPECT_EQ(s.uv[i], cad.curve(1, 1, want_position, s.t[i]).c);
    EXPECT_EQ(s.xyz[i], surface_at(cad, 1, want_position, s.uv[i]).s);
    if (i > 0) {
      EXPECT_GT(s.t[i], s.t[i - 1]);
      EXPECT_GT(s.arc[i], s.arc[i - 1]);
    }
  }
}

struct Case {
  const char* name;
  Surface surface;
  PlaneCurve curve;
  double length;
  int calls;
};

std::vector<Case> smooth_cases() {
  return {
      {"parabola", paraboloid(), segment({-2.5, -2.5}, {2.5, -2.5}), 2 * parabola_length(2.5), 130},
      {"quarter circle", flat(), circle(3, 0, pi / 2), 3 * pi / 2, 65},
      {"full circle", flat(), circle(3, 0, 2 * pi), 6 * pi, 230},
      {"circle on a paraboloid", paraboloid(), circle(1, 0, 2 * pi), 2 * pi, 230},
      {"meridian of a sphere", sphere(2), segment({0.3, -pi / 2}, {0.3, pi / 2}), 2 * pi, 120},
      {"ellipse of HDR eq. 2.5", flat(), hdr_ellipse(), ellipse_length(-pi / 6, pi + pi / 6), 270},
      {"line at a cubic pace", flat(),
       plane_curve({-1, 1},
                   [](double t) {
                     return Vec2{t + t * t * t, 0};
                   }),
       4, 115},
  };
}

TEST(BuildSupport, HasThePropertyOfLinearity) {
  for (const double degrees : {1., 0.3, 4.}) {
    for (Case& c : smooth_cases()) {
      SCOPED_TRACE(testing::Message() << c.name << ", " << degrees << " degrees");
      AnalyticCad cad = cad_of(c.surface, c.curve);
      const CurveSupport s = build_support(cad, 1, 1, {.angle_deg = degrees});
      const Linearity worst = linearity(cad, s, degrees);
      // Across and along the chord are each bounded: sqrt 2 for both together.
      EXPECT_LE(worst.space, std::sqrt(2.));
      EXPECT_LE(worst.plane, std::sqrt(2.));
      EXPECT_LE(worst.angle_deg, 1.1 * degrees);
      EXPECT_FALSE(s.limited);
    }
  }
}

TEST(BuildSupport, IsCheapOnSmoothCurves) {
  for (Case& c : smooth_cases()) {
    SCOPED_TRACE(c.name);
    AnalyticCad cad = cad_of(c.surface, c.curve);
    build_support(cad, 1, 1, {});
    EXPECT_LE(cad.calls.surf0, c.calls);
  }
}

TEST(BuildSupport, LengthConvergesAtFourthOrder) {
  for (Case& c : smooth_cases()) {
    SCOPED_TRACE(c.name);
    AnalyticCad cad = cad_of(c.surface, c.curve);
    const double coarse = std::abs(build_support(cad, 1, 1, {.angle_deg = 4}).length() - c.length) / c.length;
    const double usual = std::abs(build_support(cad, 1, 1, {}).length() - c.length) / c.length;
    EXPECT_LT(usual, 1e-6);
    EXPECT_LT(coarse, 1e-4);
  }
}

TEST(BuildSupport, ParameterAtArcMatchesTheLength) {
  // s(t) of the cubic pace is t + t^3 + 2, of the meridian R (v + pi/2).
  AnalyticCad cubic = cad_of(flat(), plane_curve({-1, 1}, [](double t) { return Vec2{t + t * t * t, 0}; }));
  const CurveSupport s = build_support(cubic, 1, 1, {});
  double worst = 0;
  for (int i = 0; i <= 1000; ++i) {
    const double t = s.t_at_arc(4. * i / 1000);
    worst = std::max(worst, std::abs(t + t * t * t + 2 - 4. * i / 1000));
  }
  EXPECT_LT(worst, 4e-6);  // of a length of 4; linear interpolation would be off by 1e-4

  AnalyticCad ellipse = cad_of(flat(), hdr_ellipse());
  const CurveSupport e = build_support(ellipse, 1, 1, {});
  for (const double r : {0.1, 0.25, 0.5, 0.8}) {
    const double t = e.t_at_arc(r * e.length());
    const double alpha = -pi / 6 + std::pow(t, 1.8) * (pi + pi / 3);
    EXPECT_NEAR(ellipse_length(-pi / 6, alpha), r * e.length(), 2e-5 * e.length());
  }
}

TEST(CurveSupport, ArcAndParameterAreInverse) {
  for (Case& c : smooth_cases()) {
    SCOPED_TRACE(c.name);
    AnalyticCad cad = cad_of(c.surface, c.curve);
    const CurveSupport s = build_support(cad, 1, 1, {});
    double before = -HUGE_VAL;
    for (int i = 0; i <= 500; ++i) {
      const double arc = s.length() * i / 500;
      const double t = s.t_at_arc(arc);
      EXPECT_GT(t, before);
      before = t;
      EXPECT_NEAR(s.arc_at_t(t), arc, 1e-9 * s.length());
      EXPECT_LE(norm(s.point_at_arc(arc) - surface_at(cad, 1, want_position, cad.curve(1, 1, want_position, t).c).s),
                0.01 * s.length());
    }
    EXPECT_EQ(s.t_at_arc(-1), s.t.front());
    EXPECT_EQ(s.t_at_arc(2 * s.length()), s.t.back());
  }
}

TEST(BuildSupport, OneKinkDoesNotExplode) {
  // RT-0232 sec. 2.1 example 1, undivided: v = |sin t|.
  AnalyticCad cad = cad_of(flat(), plane_curve({-1.5, 1.7}, [](double t) { return Vec2{t, std::abs(std::sin(t))}; }));
  const CurveSupport s = build_support(cad, 1, 1, {});
  EXPECT_LE(cad.calls.surf0, 250);
  EXPECT_FALSE(s.limited);
  double nearest = 1;
  for (const double t : s.t) nearest = std::min(nearest, std::abs(t));
  EXPECT_LT(nearest, 1.6e-5);  // where a quarter of the edge is 1e-6 of the length 3.9
}

TEST(BuildSupport, PeriodicCurveIsNotTakenForAStraightOne) {
  // Zero at every uniform sample of the first subdivision (HDR sec. 2.5, aliasing).
  AnalyticCad cad = cad_of(flat(), plane_curve({0, 1}, [](double t) { return Vec2{t, 0.1 * std::sin(8 * pi * t)}; }));
  const CurveSupport s = build_support(cad, 1, 1, {});
  double highest = 0;
  for (const Vec2& p : s.uv) highest = std::max(highest, p.y());
  EXPECT_NEAR(highest, 0.1, 1e-4);
}

TEST(BuildSupport, JumpIsBoundedAndReported) {
  AnalyticCad cad = cad_of(flat(), plane_curve({0, 1}, [](double t) { return Vec2{t, t < 0.3 ? 0. : 1.}; }));
  const CurveSupport s = build_support(cad, 1, 1, {});
  EXPECT_LE(cad.calls.surf0, 400);
  EXPECT_TRUE(s.limited);
  EXPECT_NEAR(s.limited_t, 0.3, 1e-6);
}

TEST(BuildSupport, NeverExceedsTheSamplesAllowed) {
  std::uint64_t state = 1;
  AnalyticCad cad = cad_of(flat(), plane_curve({0, 1}, [&](double t) {
                             state = state * 6364136223846793005ULL + 1442695040888963407ULL;
                             return Vec2{t, static_cast<double>(state >> 40U) * 0x1p-24};
                           }));
  const CurveSupport s = build_support(cad, 1, 1, {.max_samples = 500});
  EXPECT_LE(s.t.size(), 500U);
  EXPECT_TRUE(s.limited);
}

TEST(BuildSupport, VerticalTangentOfTheParametrisationIsBounded) {
  // Orthogonal projection of a hemisphere (RT-0232 sec. 2.1 example 2): infinite speed at the equator.
  AnalyticCad cad = cad_of(Surface{[](Vec2 p) {
                             SurfaceJet j;
                             j.s = {p.x(), p.y(), std::sqrt(std::max(0., 1 - p.x() * p.x() - p.y() * p.y()))};
                             return j;
                           }},
                           segment({-1, 0}, {1, 0}));
  const CurveSupport s = build_support(cad, 1, 1, {});
  EXPECT_LE(cad.calls.surf0, 500);
  EXPECT_NEAR(s.length(), pi, 1e-4);
}

TEST(BuildSupport, DegenerateSideHasNoLength) {
  AnalyticCad cad = cad_of(sphere(2), segment({0, pi / 2}, {1, pi / 2}));
  const CurveSupport s = build_support(cad, 1, 1, {});
  EXPECT_LE(s.length(), 1e-14);
  EXPECT_LE(cad.calls.surf0, 20);
  EXPECT_FALSE(s.limited);
  EXPECT_TRUE(std::isfinite(s.t_at_arc(0)));

  AnalyticCad point = cad_of(flat(), segment({2, 3}, {2, 3}));  // even the plane curve is one point
  const CurveSupport p = build_support(point, 1, 1, {});
  EXPECT_EQ(p.length(), 0);
  EXPECT_EQ(p.t_at_arc(0), 0);
  EXPECT_LE(point.calls.surf0, 20);
}

TEST(BuildSupport, DoesNotDependOnUnitsOrOrigin) {
  AnalyticCad cad = cad_of(flat(), circle(3, 0, pi));
  AnalyticCad small = cad_of(flat(), circle(3e-7, 0, pi));
  AnalyticCad large = cad_of(flat(), circle(3e9, 0, pi));
  const auto n = build_support(cad, 1, 1, {}).t.size();
  EXPECT_EQ(build_support(small, 1, 1, {}).t.size(), n);
  EXPECT_EQ(build_support(large, 1, 1, {}).t.size(), n);
}

TEST(BuildSupport, ReportsInvalidIntervals) {
  for (const Interval bad : {Interval{1, 0}, Interval{1, 1}, Interval{0, HUGE_VAL}, Interval{std::nan(""), 1}}) {
    PlaneCurve c = segment({0, 0}, {1, 0});
    c.interval = bad;
    AnalyticCad cad = cad_of(flat(), c);
    try {
      build_support(cad, 1, 1, {});
      FAIL();
    } catch (const CallbackError& error) {
      EXPECT_EQ(error.where().face, 1);
      EXPECT_EQ(error.where().curve_index, 1);
      EXPECT_NE(std::string(error.what()).find("curv_int"), std::string::npos);
    }
  }
}

TEST(BuildSupport, NamesTheValueThatIsNotFinite) {
  AnalyticCad cad = cad_of(flat(), plane_curve({0, 1}, [](double t) { return Vec2{t, t > 0.5 ? std::nan("") : 0.}; }));
  EXPECT_THROW(build_support(cad, 1, 1, {}), CallbackError);
  AnalyticCad other = cad_of(Surface{[](Vec2 p) {
                               SurfaceJet j;
                               j.s = {1 / p.x(), 0, 0};
                               return j;
                             }},
                             segment({0, 0}, {1, 0}));
  try {
    build_support(other, 1, 1, {});
    FAIL();
  } catch (const CallbackError& error) {
    EXPECT_EQ(error.where().t, 0.);
    EXPECT_NE(std::string(error.what()).find("surf0"), std::string::npos);
  }
  EXPECT_THROW(build_support(cad, 1, 1, {.angle_deg = 0}), InvalidArgument);
  EXPECT_THROW(build_support(cad, 1, 1, {.angle_deg = std::nan("")}), InvalidArgument);
}

TEST(RefineT, FindsTheNearestPointInOneStep) {
  AnalyticCad cad = cad_of(paraboloid(), segment({-2.5, -2.5}, {2.5, -2.5}));
  const CurveSupport s = build_support(cad, 1, 1, {});
  cad.calls = {};
  for (const double t : {0.1, 0.37, 0.5, 0.93}) {
    const Vec2 uv{-2.5 + 5 * t, -2.5};
    const Vec3 target = surface_at(cad, 1, want_position, uv).s;
    cad.calls = {};
    const CurvePoint p = refine_t(cad, 1, 1, s, t + 0.004, t - 0.01, t + 0.01, target);
    EXPECT_LE(cad.calls.surf0, 3);
    EXPECT_LT(p.distance, 2e-5);
    EXPECT_NEAR(p.t, t, 1e-5);
    // Bounds hold, and a guess that cannot be improved is kept.
    EXPECT_EQ(refine_t(cad, 1, 1, s, t + 0.004, t + 0.003, t + 0.01, target).t, t + 0.003);
    EXPECT_EQ(refine_t(cad, 1, 1, s, t, 0, 1, target).t, t);
  }
}

}  // namespace
