// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "models.h"

namespace carreau {
namespace {

using namespace testing;

/// Faces with the references given: {refc, refp1, refp2} of each curve.
Model referenced(const AnalyticCad& cad, const std::vector<std::vector<std::vector<int>>>& refs) {
  Model model = unglued(cad);
  for (std::size_t f = 0; f < refs.size(); ++f)
    for (std::size_t c = 0; c < refs[f].size(); ++c) {
      FaceCurve& curve = model.faces[f].curves[c];
      curve.ref = refs[f][c][0];
      curve.end1 = refs[f][c][1];
      curve.end2 = refs[f][c][2];
    }
  return model;
}

std::string refusal(const AnalyticCad& cad, const Model& model, double eps) {
  return sentence_of<InvalidModel>([&] { build_topology(model, traces_of(cad), eps); });
}

AnalyticCad two_squares() {
  AnalyticCad cad;
  cad.faces[1] = flat(rectangle({0, 0}, {1, 1}));
  cad.faces[2] = flat(rectangle({1, 0}, {2, 1}));
  return cad;
}

const std::vector<std::vector<std::vector<int>>> two_squares_refs{{{10, 1, 2}, {20, 2, 4}, {30, 4, 6}, {40, 6, 1}},
                                                                  {{50, 2, 8}, {60, 8, 9}, {70, 9, 4}, {20, 4, 2}}};

TEST(BuildTopology, CollectsCurvesAndPointsInOrderOfAppearance) {
  const AnalyticCad cad = two_squares();
  const Model model = referenced(cad, two_squares_refs);
  const Topology topology = build_topology(model, traces_of(cad), 0.01);
  ASSERT_EQ(topology.curves.size(), 7U);
  ASSERT_EQ(topology.points.size(), 6U);
  EXPECT_EQ(topology.curve_of, (std::vector<std::vector<int>>{{0, 1, 2, 3}, {4, 5, 6, 1}}));
  const Curve& shared = topology.curves[1];
  EXPECT_EQ(shared.ref, 20);
  ASSERT_EQ(shared.uses.size(), 2U);
  EXPECT_FALSE(shared.uses[0].reversed);
  EXPECT_TRUE(shared.uses[1].reversed);
  EXPECT_EQ(shared.uses[1].face, 1);
  EXPECT_EQ(shared.uses[1].curve, 3);
  const CornerPoint& corner = topology.points[shared.end1];
  EXPECT_EQ(corner.ref, 2);
  EXPECT_EQ(corner.position, (Vec3{1, 0, 0}));
  EXPECT_EQ(corner.curves, (std::vector<int>{0, 1, 4}));
  EXPECT_EQ(euler_number(topology, model), 1);
}

TEST(BuildTopology, FindsTheDirectionOfClosedCurvesInSpace) {
  for (const bool reversed : {false, true}) {
    AnalyticCad cad;  // a disc and a ring around it
    cad.faces[1] = flat({arc({0, 0}, 1, 0, 2 * pi)});
    cad.faces[2] = flat({arc({0, 0}, 2, 0, 2 * pi), reversed ? arc({0, 0}, 1, 2 * pi, 0) : arc({0, 0}, 1, 0, 2 * pi)});
    const Model model = referenced(cad, {{{5, 1, 1}}, {{6, 2, 2}, {5, 1, 1}}});
    const Topology topology = build_topology(model, traces_of(cad), 0.04);
    EXPECT_EQ(topology.curves[0].uses[1].reversed, reversed);
    EXPECT_FALSE(topology.curves[0].degenerate);
  }
}

TEST(BuildTopology, FindsTheDirectionsOfSeams) {
  // Opposite sides of a parameter rectangle run against each other; on a torus both pairs are closed in space.
  const Model model = glue(unglued(torus()), traces_of(torus()), 0.01);
  const Topology topology = build_topology(model, traces_of(torus()), 0.05);
  ASSERT_EQ(topology.curves.size(), 2U);
  for (const Curve& curve : topology.curves) {
    ASSERT_EQ(curve.uses.size(), 2U);
    EXPECT_EQ(curve.uses[0].face, curve.uses[1].face);
    EXPECT_TRUE(curve.uses[1].reversed);
    EXPECT_EQ(curve.end1, curve.end2);
  }
}

TEST(BuildTopology, RejectsClosedCurvesWithoutADirection) {
  // A circle smaller than the tolerance that starts a quarter turn later: as far off in either direction.
  AnalyticCad cad;
  cad.faces[1] = flat({arc({0, 0}, 0.01, 0, 2 * pi)});
  cad.faces[2] = flat({arc({0, 0}, 0.01, pi / 2, 2.5 * pi)});
  const std::string text = refusal(cad, referenced(cad, {{{5, 1, 1}}, {{5, 1, 1}}}), 0.05);
  EXPECT_TRUE(contains(text, "face 2, curve 1 (reference 5): the direction of the closed curve is ambiguous"))
      << text;
}

TEST(BuildTopology, AcceptsClosedCurvesThatAreTheSameInBothDirections) {
  const AnalyticCurve there_and_back{{0, 1}, [](double t) { return CurveJet{{std::sin(pi * t), 0}, {}, {}}; }};
  AnalyticCad cad;
  cad.faces[1] = flat({there_and_back});
  cad.faces[2] = flat({there_and_back});
  EXPECT_EQ(refusal(cad, referenced(cad, {{{5, 1, 1}}, {{5, 1, 1}}}), 0.01), "");
}

TEST(BuildTopology, RejectsClosedCurvesThatStartElsewhere) {
  AnalyticCad cad;
  cad.faces[1] = flat({arc({0, 0}, 1, 0, 2 * pi)});
  cad.faces[2] = flat({arc({0, 0}, 1, 1, 1 + 2 * pi)});
  const std::string text = refusal(cad, referenced(cad, {{{5, 1, 1}}, {{5, 1, 1}}}), 0.02);
  EXPECT_TRUE(contains(text, "face 2, curve 1 (reference 5): its first end is 0.9588")) << text;
}

TEST(BuildTopology, MakesOneCornerOfADegenerateSideWhateverItsReferences) {
  // The manual demanded refp1 != refp2.
  const std::vector<std::vector<int>> sides{{1, 1, 1}, {2, 1, 4}, {3, 4, 5}, {2, 4, 1}};
  Model model = referenced(cone(), {sides});
  model.faces[0].curves[3].end1 = 4;
  const Topology topology = build_topology(model, traces_of(cone()), 0.02);
  EXPECT_TRUE(topology.curves[2].degenerate);
  EXPECT_EQ(topology.curves[2].end1, topology.curves[2].end2);
  EXPECT_EQ(topology.points.size(), 2U);
  EXPECT_FALSE(topology.curves[0].degenerate);
}

TEST(BuildTopology, DistinguishesASmallHoleFromAPoint) {
  AnalyticCad cad;
  auto curves = rectangle({0, 0}, {1, 1});
  curves.push_back(arc({0.5, 0.5}, 0.002, 0, 2 * pi));
  cad.faces[1] = flat(curves);
  const Model model = glue(unglued(cad), traces_of(cad), 1e-3);
  const Topology topology = build_topology(model, traces_of(cad), 0.014);
  EXPECT_FALSE(topology.curves[4].degenerate);
}

// The end of a wire 1 x 8e-6 x 8e-6: without the face its four sides are points. With it they are not, nor for the face
// beside it; a real pole stays one.
TEST(BuildTopology, KeepsFacesWhoseSidesAreAllTiny) {
  const double a = 8e-6;
  AnalyticCad cad;
  cad.faces[1] = flat(rectangle({0, 0}, {1, a}));
  Model side = glue(unglued(cad), traces_of(cad), a / 100);
  const Topology alone = build_topology(side, traces_of(cad), 0.01);
  EXPECT_TRUE(alone.curves[1].degenerate);
  EXPECT_EQ(alone.points.size(), 2U);
  cad.faces[2] = flat(rectangle({1, 0}, {1 + a, a}));
  const Model both = glue(unglued(cad), traces_of(cad), a / 100);
  const Topology topology = build_topology(both, traces_of(cad), 0.01);
  EXPECT_FALSE(topology.curves[topology.curve_of[0][1]].degenerate);
  for (const int curve : topology.curve_of[1]) EXPECT_FALSE(topology.curves[curve].degenerate);
  EXPECT_TRUE(topology.curves[topology.curve_of[0][3]].degenerate);
  EXPECT_EQ(topology.points.size(), 5U);
}

TEST(BuildTopology, TakesATinyCurveWhoseEndsWereGluedForAPoint) {
  AnalyticCad cad;
  cad.faces[1] = flat(
      {segment({0, 0}, {1, 0}), segment({1, 0}, {1, 0.002}), segment({1, 0.002}, {1, 1}), segment({1, 1}, {0, 0})});
  const Model model = glue(unglued(cad), traces_of(cad), 0.01);
  const Topology topology = build_topology(model, traces_of(cad), 0.014);
  EXPECT_TRUE(topology.curves[1].degenerate);
  EXPECT_EQ(topology.points.size(), 3U);
  EXPECT_EQ(topology.curves[0].end2, topology.curves[2].end1);
}

TEST(BuildTopology, RejectsCurvesOfOneReferenceThatAreApart) {
  AnalyticCad cad;
  cad.faces[1] = flat({segment({-1, 0}, {1, 0}), arc({0, 0}, 1, 0, pi)});
  cad.faces[2] = flat({arc({0, 0}, 1, pi, 2 * pi), segment({1, 0}, {-1, 0})});
  Model model = referenced(cad, {{{1, 1, 2}, {2, 2, 1}}, {{2, 1, 2}, {1, 2, 1}}});
  model.source = "x.pardom";
  model.faces[0].curves[1].line = 4;
  model.faces[1].curves[0].line = 8;
  // The lower end of one arc is sqrt(2) away from the ends of the other one.
  EXPECT_TRUE(
      contains(refusal(cad, model, 0.02), "x.pardom, line 8, face 2, curve 1 (reference 2): the curve is up to 1.4"));
  EXPECT_TRUE(
      contains(refusal(cad, model, 0.02), " away from curve 2 of face 1 (line 4), which has the same reference"));
}

TEST(BuildTopology, RejectsExchangedReferences) {
  const AnalyticCad cad = two_squares();
  auto refs = two_squares_refs;
  std::swap(refs[1][3][1], refs[1][3][2]);
  EXPECT_EQ(refusal(cad, referenced(cad, refs), 0.02),
            "face 2, curve 4 (reference 20): refp1 and refp2 are exchanged: its first end is at the point of reference "
            "4, its "
            "second end at the point of reference 2");
}

TEST(BuildTopology, RejectsExchangedReferencesOfCurvesShorterThanItsTolerance) {
  AnalyticCad cad;
  cad.faces[1] = flat({segment({0, 0}, {1, 0}), segment({1, 0.02}, {0, 0}), segment({1, 0}, {1, 0.02})});
  EXPECT_EQ(refusal(cad, referenced(cad, {{{1, 1, 2}, {2, 3, 1}, {3, 2, 3}}}), 0.05), "");
  EXPECT_TRUE(contains(refusal(cad, referenced(cad, {{{1, 1, 2}, {2, 3, 1}, {3, 3, 2}}}), 0.05), "are exchanged"));
}

TEST(BuildTopology, RejectsEndsThatAreNotWhereTheirReferenceIs) {
  const AnalyticCad cad = two_squares();
  auto refs = two_squares_refs;
  refs[1][0][2] = refs[1][1][1] = 6;  // a corner of the first square
  const std::string text = refusal(cad, referenced(cad, refs), 0.02);
  EXPECT_TRUE(contains(text, "face 2, curve 1 (reference 50): its second end is 2.236")) << text;
  EXPECT_TRUE(contains(text, "away from the point of reference 6")) << text;
}

TEST(BuildTopology, RejectsOneReferenceForBothEndsOfAnOpenCurve) {
  AnalyticCad cad;
  cad.faces[1] = flat({segment({-1, 0}, {1, 0}), arc({0, 0}, 1, 0, pi)});
  EXPECT_EQ(
      refusal(cad, referenced(cad, {{{1, 1, 1}, {2, 1, 1}}}), 0.02),
      "face 1, curve 1 (reference 1): refp1 and refp2 are both 1, but the ends of the curve are 2 apart, and 2 from "
      "where that point is");
}

TEST(BuildTopology, AcceptsGapsWithinItsTolerance) {
  AnalyticCad cad;
  cad.faces[1] = flat(rectangle({0, 0}, {1, 1}));
  cad.faces[2] = flat(rectangle({1.009, 0}, {2, 1}));
  const Model model = referenced(cad, two_squares_refs);
  EXPECT_EQ(refusal(cad, model, 0.01), "");
  EXPECT_NE(refusal(cad, model, 0.008), "");
}

TEST(BuildTopology, RejectsATolerancePositiveOnlyByMistakeAndTracesOfAnotherModel) {
  const Model model = referenced(two_squares(), two_squares_refs);
  EXPECT_THROW(build_topology(model, traces_of(two_squares()), 0), InvalidArgument);
  EXPECT_THROW(build_topology(model, traces_of(paraboloid()), 0.1), InvalidArgument);
}

}  // namespace
}  // namespace carreau
