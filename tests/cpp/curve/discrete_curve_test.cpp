// SPDX-License-Identifier: BSD-3-Clause
#include "curve/discrete_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene.h"
#include "support/error.h"

namespace {

using namespace carreau;
using namespace carreau::testing_cad;
using std::numbers::pi;

TEST(DiscretiseCurve, UniformSideHasEqualEdgesAndTheManualsCount) {
  // RT-0232 sec. 6.1: h = diag / 50 with diag = 7.7; 216 boundary edges are 54 a side.
  Scene s;
  const int face = s.add_face(1, paraboloid());
  s.add_curve({s.add_use(face, segment({-2.5, -2.5}, {2.5, -2.5}))});
  s.build();
  s.sizes.hphydef = std::hypot(5, 5, 3.125) / 50;
  SizeRules rules(s.model, s.topology, s.cad, s.sizes);
  const DiscreteCurve d = discretise_curve(s.curve_model(), 0, rules);
  EXPECT_EQ(d.segments(), 54);
  EXPECT_EQ(s.cad.calls.surf0, 53);
  EXPECT_EQ(s.cad.calls.sizes, 0);
  const auto arc = [](double x) { return (x * std::sqrt(1 + x * x) + std::asinh(x)) / 2; };
  for (int k = 0; k < 54; ++k) {
    const double length = arc(d.xyz[k + 1].x()) - arc(d.xyz[k].x());
    EXPECT_NEAR(length, 2 * arc(2.5) / 54, 2e-4 * 2 * arc(2.5) / 54);
    EXPECT_NEAR(d.size[k], s.sizes.hphydef, 1e-15);
  }
}

TEST(DiscretiseCurve, VerticesAreOnTheFirstUsesSurfaceAndEndsAreCorners) {
  Scene s = interface_between_two_faces(true);
  SizeRules rules(s.model, s.topology, s.cad, s.sizes);
  const DiscreteCurve d = discretise_curve(s.curve_model(), 0, rules);
  const Curve& c = s.topology.curves[0];
  EXPECT_EQ(d.xyz.front(), s.topology.points[0].position);
  EXPECT_EQ(d.xyz.back(), s.topology.points[1].position);
  EXPECT_EQ(d.r.front(), 0);
  EXPECT_EQ(d.r.back(), 1);
  for (std::size_t u = 0; u < 2; ++u) {
    for (std::size_t k = 0; k < d.r.size(); ++k) {
      EXPECT_EQ(d.uv_of_use[u][k], s.cad.curve(static_cast<int>(u) + 1, 1, want_position, d.t_of_use[u][k]).c);
      if (k > 0) {
        EXPECT_EQ(d.t_of_use[u][k] < d.t_of_use[u][k - 1], c.uses[u].reversed);
      }
    }
  }
  for (std::size_t k = 1; k + 1 < d.r.size(); ++k) EXPECT_EQ(d.xyz[k], s.lifted(c.uses[0], d.uv_of_use[0][k]));
}

TEST(DiscretiseCurve, SamePaceNeedsOnlyProbes) {
  Scene s = interface_between_two_faces(true);
  SizeRules rules(s.model, s.topology, s.cad, s.sizes);
  const DiscreteCurve d = discretise_curve(s.curve_model(), 0, rules);
  EXPECT_LE(s.cad.calls.surf0, d.segments() - 1 + 4);
  EXPECT_EQ(d.refined[1], 0);
  EXPECT_LT(d.gap, 1e-4 * s.sizes.hphydef);
  for (std::size_t k = 0; k < d.r.size(); ++k) {
    EXPECT_LT(norm(s.lifted(s.topology.curves[0].uses[1], d.uv_of_use[1][k]) - d.xyz[k]), 1e-3 * d.size[k]);
  }
}

TEST(DiscretiseCurve, OtherPacesStayWithinAThousandthOfAnEdge) {
  for (const double h : {0.5, 0.1, 0.01}) {
    SCOPED_TRACE(h);
    Scene s = interface_between_two_faces(false);
    s.sizes.hphydef = h;
    SizeRules rules(s.model, s.topology, s.cad, s.sizes);
    const DiscreteCurve d = discretise_curve(s.curve_model(), 0, rules);
    for (std::size_t k = 0; k < d.r.size(); ++k) {
      EXPECT_LT(norm(s.lifted(s.topology.curves[0].uses[1], d.uv_of_use[1][k]) - d.xyz[k]), 1.5e-3 * h);
    }
  }
}

TEST(DiscretiseCurve, RefinesParametersThatInterpolationCannotGive) {
  Scene s = interface_between_two_faces(false);
  SizeRules rules(s.model, s.topology, s.cad, s.sizes);
  const DiscreteCurve d = discretise_curve(s.curve_model(), 0, rules, {.carry_tolerance = 1e-9});
  EXPECT_EQ(d.refined[1], 1);
  EXPECT_LT(d.gap, 1e-6 * s.sizes.hphydef);
  for (std::size_t k = 1; k < d.r.size(); ++k) EXPECT_LT(d.t_of_use[1][k], d.t_of_use[1][k - 1]);
}

TEST(DiscretiseCurve, ReportsTheGapBetweenFacesThatDoNotMeet) {
  Scene s;
  const int first = s.add_face(1, flat());
  const int second = s.add_face(2, Surface{[](Vec2 p) {
                                  SurfaceJet j;
                                  j.s = {p.x(), p.y(), 0.02 * std::sin(pi * p.x())};
                                  return j;
                                }});
  const auto a = s.add_use(first, segment({0, 0}, {1, 0}));
  const auto b = s.add_use(second, segment({0, 0}, {1, 0}));
  s.add_curve({a, b});
  s.build();
  SizeRules rules(s.model, s.topology, s.cad, s.sizes);
  const DiscreteCurve d = discretise_curve(s.curve_model(), 0, rules);
  EXPECT_NEAR(d.gap, 0.02, 2e-4);
  EXPECT_EQ(d.refined[1], 1);
}

TEST(DiscretiseCurve, ClosedCurveHasAtLeastThreeSegments) {
  Scene s;
  const int face = s.add_face(1, flat());
  s.add_curve({s.add_use(face, plane_curve({0, 2 * pi},
                                           [](double t) {
                                             return Vec2{std::cos(t), std::sin(t)};
                                           }))},
              true);
  s.build();
  s.sizes.hphydef = 10;
  SizeRules rules(s.model, s.topology, s.cad, s.sizes);
  const DiscreteCurve d = discretise_curve(s.curve_model(), 0, rules);
  ASSERT_EQ(d.segments(), 3);
  EXPECT_EQ(d.xyz.front(), d.xyz.back());
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(norm(d.xyz[k + 1] - d.xyz[k]), std::sqrt(3.), 1e-4);
}

TEST(DiscretiseCurve, SeamIsCarriedToBothSidesOfOneFace) {
  Scene s;
  const int face = s.add_face(1, cylinder(1));
  const auto a = s.add_use(face, segment({0, 0}, {0, 2}));
  const auto b = s.add_use(face, segment({2 * pi, 2}, {2 * pi, 0}), true);
  s.add_curve({a, b});
  s.build();
  SizeRules rules(s.model, s.topology, s.cad, s.sizes);
  const DiscreteCurve d = discretise_curve(s.curve_model(), 0, rules);
  EXPECT_EQ(d.segments(), 20);
  for (std::size_t k = 0; k < d.r.size(); ++k) {
    EXPECT_NEAR(d.uv_of_use[0][k].x(), 0, 1e-15);
    EXPECT_NEAR(d.uv_of_use[1][k].x(), 2 * pi, 1e-14);
    EXPECT_NEAR(d.uv_of_use[0][k].y(), d.uv_of_use[1][k].y(), 1e-12);
  }
  EXPECT_LT(d.gap, 1e-12);
}

TEST(DiscretiseCurve, DegenerateSideIsNeverDivided) {
  // HDR sec. 4.5.4.
  Scene s;
  const int face = s.add_face(1, sphere(1));
  s.add_curve({s.add_use(face, segment({1, pi / 2}, {0, pi / 2}))}, false, true);
  s.build();
  SizeRules rules(s.model, s.topology, s.cad, s.sizes);
  DiscreteCurve d = discretise_curve(s.curve_model(), 0, rules);
  EXPECT_TRUE(d.indivisible);
  ASSERT_EQ(d.segments(), 1);
  EXPECT_EQ(d.xyz[0], d.xyz[1]);
  EXPECT_EQ(d.uv_of_use[0][0], (Vec2{1, pi / 2}));
  EXPECT_EQ(d.uv_of_use[0][1], (Vec2{0, pi / 2}));
  EXPECT_FALSE(split_segment(d, 0, s.curve_model()));
  EXPECT_EQ(d.segments(), 1);
}

TEST(SplitSegment, HalvesTheLengthInEveryUse) {
  for (const bool same_pace : {true, false}) {
    Scene s = interface_between_two_faces(same_pace);
    SizeRules rules(s.model, s.topology, s.cad, s.sizes);
    DiscreteCurve d = discretise_curve(s.curve_model(), 0, rules);
    const int n = d.segments();
    for (const int k : {0, 5, n + 1}) {
      const double middle = (d.r[k] + d.r[k + 1]) / 2;
      ASSERT_TRUE(split_segment(d, k, s.curve_model()));
      EXPECT_EQ(d.r[k + 1], middle);
    }
    ASSERT_EQ(d.segments(), n + 3);
    ASSERT_EQ(d.xyz.size(), d.r.size());
    ASSERT_EQ(d.size.size(), d.r.size());
    ASSERT_EQ(d.physical.size(), d.r.size());
    const auto arc = [](double x) { return (x * std::sqrt(1 + x * x) + std::asinh(x)) / 2; };
    for (std::size_t k = 0; k < d.r.size(); ++k) {
      EXPECT_NEAR((arc(d.xyz[k].x()) + arc(2.5)) / (2 * arc(2.5)), d.r[k], 2e-6);
      for (std::size_t u = 0; u < 2; ++u) {
        EXPECT_LT(norm(s.lifted(s.topology.curves[0].uses[u], d.uv_of_use[u][k]) - d.xyz[k]), 1.5e-4);
      }
    }
  }
}

TEST(SplitSegment, EndsByRejectingIndivisibleSegments) {
  Scene s;
  const int face = s.add_face(1, flat());
  s.add_curve({s.add_use(face, segment({0, 0}, {1, 0}))});
  s.build();
  s.sizes.hphydef = 10;
  SizeRules rules(s.model, s.topology, s.cad, s.sizes);
  DiscreteCurve d = discretise_curve(s.curve_model(), 0, rules);
  int times = 0;
  while (split_segment(d, d.segments() - 1, s.curve_model())) ASSERT_LT(++times, 2000);
  for (std::size_t k = 1; k < d.r.size(); ++k) EXPECT_LT(d.t_of_use[0][k - 1], d.t_of_use[0][k]);
}

TEST(SampleSizes, InterpolationBetweenEndsIsExactWithoutAnswers) {
  for (const int law : {0, 1, 2}) {
    Scene s;
    const int face = s.add_face(1, flat());
    s.add_curve({s.add_use(face, segment({0, 0}, {4, 0}))});
    s.build();
    s.sizes.physical = PhysicalSizes::asked;
    s.sizes.law = static_cast<SizeLaw>(law);
    s.cad.hphyp = [](int p) { return std::optional<double>(p == 1 ? 0.01 : 0.5); };
    SizeRules rules(s.model, s.topology, s.cad, s.sizes);
    const SizeSamples samples = sample_sizes(s.curve_model(), 0, rules);
    EXPECT_EQ(samples.r, (std::vector<double>{0, 1}));
    EXPECT_EQ(samples.h, (std::vector<double>{0.01, 0.5}));
    for (const double r : {0.2, 0.7}) {
      EXPECT_DOUBLE_EQ(samples.size_at(r), interpolate_size(static_cast<SizeLaw>(law), 0.01, 0.5, r));
      EXPECT_DOUBLE_EQ(samples.physical_at(r), samples.size_at(r));
    }
  }
}

TEST(SampleSizes, FollowsASizeThatVariesAlongTheCurve) {
  Scene s;
  const int face = s.add_face(1, flat());
  s.add_curve({s.add_use(face, segment({0, 0}, {4, 0}))});
  s.build();
  s.sizes.physical = PhysicalSizes::asked;
  const auto h = [](double x) { return 0.3 - 0.28 * std::exp(-40 * (x - 2.6) * (x - 2.6)); };
  s.cad.hphyc = [&](int, int, double t) { return std::optional<double>(h(4 * t)); };
  SizeRules rules(s.model, s.topology, s.cad, s.sizes);
  const SizeSamples samples = sample_sizes(s.curve_model(), 0, rules);
  EXPECT_LT(samples.r.size(), 300U);
  for (int i = 0; i <= 1000; ++i) EXPECT_NEAR(samples.size_at(i / 1000.) / h(4. * i / 1000), 1, 0.05);
  // The normalised length decides the number of edges.
  const DiscreteCurve d = discretise_curve(s.curve_model(), 0, rules);
  double exact = 0;
  for (int i = 0; i < 100000; ++i) exact += 4e-5 / h(4e-5 * (i + 0.5));
  EXPECT_NEAR(d.segments(), exact, 0.5 + 0.01 * exact);
}

TEST(SampleSizes, SmallerSubSegmentsFollowMoreClosely) {
  Scene s;
  const int face = s.add_face(1, flat());
  s.add_curve({s.add_use(face, segment({0, 0}, {4, 0}))});
  s.build();
  s.sizes.physical = PhysicalSizes::asked;
  const auto h = [](double x) { return 0.2 + 0.1 * std::sin(3 * x); };
  s.cad.hphyc = [&](int, int, double t) { return std::optional<double>(h(4 * t)); };
  SizeRules rules(s.model, s.topology, s.cad, s.sizes);
  double before = HUGE_VAL;
  for (const double lss : {2., 0.5, 0.125}) {
    const SizeSamples samples = sample_sizes(s.curve_model(), 0, rules, {.lss = lss});
    double error = 0;
    for (int i = 0; i <= 1000; ++i) error = std::max(error, std::abs(samples.size_at(i / 1000.) - h(4. * i / 1000)));
    EXPECT_LT(error, before / 2);
    before = error;
  }
  EXPECT_LT(before, 2e-3);
  EXPECT_THROW(sample_sizes(s.curve_model(), 0, rules, {.lss = 0}), InvalidArgument);
}

TEST(SampleSizes, AJumpOfSizesEndsTheRefinement) {
  Scene s;
  const int face = s.add_face(1, flat());
  s.add_curve({s.add_use(face, segment({0, 0}, {4, 0}))});
  s.build();
  s.sizes.physical = PhysicalSizes::asked;
  s.cad.hphyc = [&](int, int, double t) { return std::optional<double>(t < 0.37 ? 0.01 : 1); };
  SizeRules rules(s.model, s.topology, s.cad, s.sizes);
  const DiscreteCurve d = discretise_curve(s.curve_model(), 0, rules);
  EXPECT_LT(d.sizes.r.size(), 400U);
  EXPECT_NEAR(d.segments(), 0.37 * 4 / 0.01 + 0.63 * 4, 3);
}

TEST(SampleSizes, EndsTakeTheCurvesOrThePointsSize) {
  Scene s;
  const int face = s.add_face(1, flat());
  s.add_curve({s.add_use(face, segment({0, 0}, {4, 0}))});
  s.build();
  s.sizes.physical = PhysicalSizes::asked;
  s.cad.hphyc = [&](int, int, double) { return std::optional<double>(0.1); };
  s.cad.hphyp = [](int) { return std::optional<double>(1); };
  SizeRules rules(s.model, s.topology, s.cad, s.sizes);
  EXPECT_EQ(sample_sizes(s.curve_model(), 0, rules, {.ends = EndSizes::of_curve}).h.front(), 0.1);
  EXPECT_EQ(sample_sizes(s.curve_model(), 0, rules, {.ends = EndSizes::of_point}).h.front(), 1);
  const DiscreteCurve d = discretise_curve(s.curve_model(), 0, rules);
  EXPECT_EQ(d.segments(), 40);
  EXPECT_EQ(d.size.front(), 1);  // the vertex is the point
  EXPECT_EQ(d.size[1], 0.1);
}

TEST(SampleSizes, CircleByCurvatureHasTheAnglesEdges) {
  // h = 2 rho sin(angle_mesh): a chord of a circle that makes 8 degrees with it (HDR eq. 2.33): 360 / 16 = 22.5 edges.
  Scene s;
  const int face = s.add_face(1, flat());
  s.add_curve({s.add_use(face, PlaneCurve{{0, 2 * pi},
                                          [](double t) {
                                            const double c = std::cos(t), z = std::sin(t);
                                            return CurveJet{{c, z}, {-z, c}, {-c, -z}};
                                          }})},
              true);
  s.build();
  s.sizes.physical = PhysicalSizes::ignored;
  s.sizes.geometric = GeometricSizes::curvature;
  SizeRules rules(s.model, s.topology, s.cad, s.sizes);
  const DiscreteCurve d = discretise_curve(s.curve_model(), 0, rules);
  EXPECT_EQ(d.segments(), 23);  // 2 pi / (2 sin 8 deg) = 22.57
}

TEST(SampleSizes, ACurveWhoseSamplesAreInflectionsIsStillSampledWhereItBends) {
  // z = a sin(2 t) over two periods: its ends, middle and quarters are inflections. Edges by h = 2 rho sin(angle_mesh)
  // are the turning of the curve, 8 atan(2 a), over 2 sin(angle_mesh).
  for (const double a : {0.4, 0.2, 0.1}) {
    Scene s;
    const int face = s.add_face(1, flat());
    s.add_curve({s.add_use(face, PlaneCurve{{0, 2 * pi}, [a](double t) {
                                              const double c = std::cos(2 * t), z = std::sin(2 * t);
                                              return CurveJet{{t, a * z}, {1, 2 * a * c}, {0, -4 * a * z}};
                                            }})});
    s.build();
    s.sizes.physical = PhysicalSizes::ignored;
    s.sizes.geometric = GeometricSizes::curvature;
    s.sizes.hgeomax = 1e3;
    s.sizes.angle_mesh = 2;
    SizeRules rules(s.model, s.topology, s.cad, s.sizes);
    const double turning = 8 * std::atan(2 * a), expected = turning / (2 * std::sin(2 * pi / 180));
    EXPECT_NEAR(discretise_curve(s.curve_model(), 0, rules).segments(), expected, 1 + 0.05 * expected) << a;
  }
}

TEST(DiscretiseCurve, AHopelessSizeIsALimitError) {
  Scene s;
  const int face = s.add_face(1, flat());
  s.add_curve({s.add_use(face, segment({0, 0}, {1e9, 0}))});
  s.build();
  s.sizes.hphydef = 1e-3;
  SizeRules rules(s.model, s.topology, s.cad, s.sizes);
  EXPECT_THROW(discretise_curve(s.curve_model(), 0, rules), LimitError);
}

}  // namespace
