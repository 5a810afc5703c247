// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "models.h"

namespace carreau {
namespace {

using namespace testing;

Model glued(const AnalyticCad& cad, double eps, std::vector<std::string>* remarks = nullptr) {
  return glue(unglued(cad), traces_of(cad), eps, remarks);
}

TEST(Glue, NumbersTheParaboloidAsTheManualDoes) {
  // x.pardom.new of RT-0232 sec. 6.1.
  const std::vector<std::vector<int>> manual{{1, 1, 2}, {2, 2, 4}, {3, 4, 6}, {4, 6, 1}};
  EXPECT_TRUE(needs_gluing(unglued(paraboloid())));
  EXPECT_EQ(references(glued(paraboloid(), 7.7 / 500)), manual);
}

TEST(Glue, MergedEntitiesHaveTheSmallestNumber) {
  // Two squares; the fourth side of the second is the second side of the first, reversed.
  AnalyticCad cad;
  cad.faces[3] = flat(rectangle({0, 0}, {1, 1}));
  cad.faces[7] = flat(rectangle({1, 0}, {2, 1}));
  const std::vector<std::vector<int>> expected{{1, 1, 2},  {2, 2, 4},   {3, 4, 6},  {4, 6, 1},
                                               {5, 2, 10}, {6, 10, 12}, {7, 12, 4}, {2, 4, 2}};
  const Model model = glued(cad, 1e-3);
  EXPECT_EQ(references(model), expected);
  EXPECT_TRUE(find_model_defects(model).empty());
  EXPECT_FALSE(needs_gluing(model));
}

TEST(Glue, BridgesGapsBelowItsToleranceAndNoneAbove) {
  AnalyticCad cad;
  cad.faces[1] = flat(rectangle({0, 0}, {1, 1}));
  cad.faces[2] = flat(rectangle({1.009, 0}, {2, 1}));
  EXPECT_EQ(glued(cad, 0.01).faces[1].curves[3].ref, 2);
  EXPECT_EQ(glued(cad, 0.008).faces[1].curves[3].ref, 8);
}

Model glued_where_open(const AnalyticCad& cad, double eps, double eps_open, GlueReport* report = nullptr) {
  return glue(unglued(cad), traces_of(cad), eps, nullptr, report, eps_open);
}

TEST(Glue, BridgesWiderGapsBetweenOpenCurves) {
  AnalyticCad cad;
  cad.faces[1] = flat(rectangle({0, 0}, {1, 1}));
  cad.faces[2] = flat(rectangle({1.009, 0}, {2, 1}));
  GlueReport report;
  const Model model = glued_where_open(cad, 0.001, 0.01, &report);
  const std::vector<std::vector<int>> expected{{1, 1, 2},  {2, 2, 4},   {3, 4, 6},  {4, 6, 1},
                                               {5, 2, 10}, {6, 10, 12}, {7, 12, 4}, {2, 4, 2}};
  EXPECT_EQ(references(model), expected);
  EXPECT_TRUE(find_model_defects(model).empty());
  ASSERT_EQ(report.pairs.size(), 1U);
  EXPECT_NEAR(report.pairs[0].gap, 0.009, 1e-15);
  EXPECT_EQ(report.open.size(), 6U);
  EXPECT_EQ(references(glued_where_open(cad, 0.001, 0.0089)), references(glued(cad, 0.001)));
}

// Ends that are one already have the curves of both: a grid of squares with gaps between all of them comes out whole.
TEST(Glue, AGridOfOpenSquaresBecomesOneSurface) {
  constexpr int n = 9;
  constexpr double half_gap = 0.004;
  AnalyticCad cad;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      cad.faces[1 + i * n + j] = flat(rectangle({i + half_gap, j + half_gap}, {i + 1 - half_gap, j + 1 - half_gap}));
  GlueReport report;
  const Model model = glued_where_open(cad, 0.001, 0.01, &report);
  std::map<int, int> curves;
  std::set<int> points;
  for (const Face& face : model.faces)
    for (const FaceCurve& curve : face.curves) {
      ++curves[curve.ref];
      points.insert({curve.end1, curve.end2});
      EXPECT_NE(curve.end1, curve.end2);
    }
  EXPECT_EQ(points.size(), static_cast<std::size_t>((n + 1) * (n + 1)));
  EXPECT_EQ(curves.size(), static_cast<std::size_t>(2 * n * (n + 1)));
  EXPECT_EQ(report.pairs.size(), static_cast<std::size_t>(2 * n * (n - 1)));
  EXPECT_EQ(report.open.size(), static_cast<std::size_t>(4 * n));
  EXPECT_TRUE(find_model_defects(model).empty());
}

TEST(Glue, OpenCurvesMayBeATenthOfTheirOwnLengthApart) {
  for (const double height : {0.091, 0.089}) {
    AnalyticCad cad;
    cad.faces[1] = flat(rectangle({0, 0}, {1, height}));
    cad.faces[2] = flat(rectangle({1.009, 0}, {2, height}));
    EXPECT_EQ(glued_where_open(cad, 0.001, 0.05).faces[1].curves[3].ref, height > 0.09 ? 2 : 8) << height;
  }
}

TEST(Glue, OpenCurvesTakeTheNearestAndEachOne) {
  // Two sheets beside one: the nearer one is the neighbour, whatever the order.
  for (const bool swapped : {false, true}) {
    AnalyticCad cad;
    cad.faces[1] = flat(rectangle({0, 0}, {1, 1}));
    cad.faces[swapped ? 3 : 2] = flat(rectangle({1.009, 0}, {2, 1}));
    cad.faces[swapped ? 2 : 3] = flat(rectangle({1.004, 0}, {2, 1}));
    GlueReport report;
    const Model model = glued_where_open(cad, 0.001, 0.01, &report);
    ASSERT_FALSE(report.pairs.empty());
    EXPECT_EQ(model.faces[swapped ? 1 : 2].curves[3].ref, 2);
    EXPECT_NE(model.faces[swapped ? 2 : 1].curves[3].ref, 2);
  }
}

TEST(Glue, OpenCurvesStayApartAcrossAShortCurveAndASlit) {
  AnalyticCad cad;
  cad.faces[1] = flat(rectangle({0, 0}, {1, 1}));
  cad.faces[2] = flat(rectangle({1.009, 0}, {2, 1}));
  cad.faces[3] = flat(rectangle({1, -1}, {1.009, 0}));  // its upper side lies between
  const Model model = glued_where_open(cad, 0.001, 0.01);
  EXPECT_NE(model.faces[0].curves[1].ref, model.faces[1].curves[3].ref);
  EXPECT_NE(model.faces[2].curves[2].end1, model.faces[2].curves[2].end2);
  AnalyticCad narrow;
  narrow.faces[1] = flat(rectangle({0, 0}, {1, 0.009}));
  EXPECT_EQ(references(glued_where_open(narrow, 0.001, 0.01)), references(glued(narrow, 0.001)));
}

TEST(Glue, KeepsCurvesApartThatShareTheirEndsOnly) {
  // The arc and the chord of a half disc, twice.
  AnalyticCad cad;
  cad.faces[1] = flat({segment({-1, 0}, {1, 0}), arc({0, 0}, 1, 0, pi)});
  cad.faces[2] = flat({arc({0, 0}, 1, pi, 2 * pi), segment({1, 0}, {-1, 0})});
  const std::vector<std::vector<int>> expected{{1, 1, 2}, {2, 2, 1}, {3, 1, 2}, {1, 2, 1}};
  EXPECT_EQ(references(glued(cad, 0.01)), expected);
}

TEST(Glue, MakesTheSidesOfATorusSeams) {
  const Model model = glued(torus(), 0.01);
  const std::vector<std::vector<int>> expected{{1, 1, 1}, {2, 1, 1}, {1, 1, 1}, {2, 1, 1}};
  EXPECT_EQ(references(model), expected);
  EXPECT_TRUE(find_model_defects(model).empty());
  EXPECT_EQ(euler_number(build_topology(model, traces_of(torus()), 0.05), model), 0);
}

TEST(Glue, MakesOneSeamAndTwoCirclesOfACylinder) {
  const std::vector<std::vector<int>> expected{{1, 1, 1}, {2, 1, 4}, {3, 4, 4}, {2, 4, 1}};
  EXPECT_EQ(references(glued(cylinder(), 0.01)), expected);
}

TEST(Glue, GivesADegenerateSideAReferenceOfItsOwn) {
  std::vector<std::string> remarks;
  const Model model = glued(cone(), 0.01, &remarks);
  const std::vector<std::vector<int>> expected{{1, 1, 1}, {2, 1, 4}, {3, 4, 4}, {2, 4, 1}};
  EXPECT_EQ(references(model), expected);
  EXPECT_TRUE(remarks.empty());  // an apex is no accident
  const Topology topology = build_topology(model, traces_of(cone()), 0.05);
  EXPECT_TRUE(topology.curves[2].degenerate);
  EXPECT_EQ(euler_number(topology, model), 1);
}

TEST(Glue, ClosesKleinsBottle) {
  const AnalyticCad cad = klein_bottle();
  const Model model = glued(cad, 40.0 / 500);
  EXPECT_TRUE(find_model_defects(model).empty());
  const Topology topology = build_topology(model, traces_of(cad), 0.4);
  EXPECT_EQ(topology.curves.size(), 8U);
  for (const Curve& curve : topology.curves) EXPECT_EQ(curve.uses.size(), 2U) << curve.ref;
  EXPECT_EQ(euler_number(topology, model), 0);
  // No choice of orientations makes all pairs of uses opposite: the bottle has one side only.
  bool orientable = false;
  for (int signs = 0; signs < 16; ++signs) {
    bool opposite = true;
    for (const Curve& curve : topology.curves) {
      const bool turned1 = ((signs >> curve.uses[0].face) & 1) != 0, turned2 = ((signs >> curve.uses[1].face) & 1) != 0;
      opposite = opposite && ((curve.uses[0].reversed != turned1) != (curve.uses[1].reversed != turned2));
    }
    orientable = orientable || opposite;
  }
  EXPECT_FALSE(orientable);
}

TEST(Glue, FindsTheInterfacesOfTheTeapot) {
  const AnalyticCad cad = teapot();
  ASSERT_EQ(cad.faces.size(), 32U);
  const CurveTraces traces = traces_of(cad);
  const Model model = glue(unglued(cad), traces, 7.0 / 500);
  EXPECT_TRUE(find_model_defects(model).empty());
  const Topology topology = build_topology(model, traces, 7.0 / 100);
  std::map<std::size_t, int> with_uses;
  int degenerate = 0;
  for (const Curve& curve : topology.curves) {
    if (curve.degenerate)
      ++degenerate;
    else
      ++with_uses[curve.uses.size()];
  }
  EXPECT_EQ(with_uses, (std::map<std::size_t, int>{{1, 16}, {2, 52}}));
  EXPECT_EQ(degenerate, 8);  // four patches meet at the top of the lid, four at the middle of the bottom
}

TEST(Glue, LeavesTheLongSidesOfANarrowFaceApart) {
  AnalyticCad cad;
  const double eps = 0.01;
  cad.faces[1] = flat(rectangle({0, 0}, {3, 0.4 * eps}));
  std::vector<std::string> remarks;
  const Model model = glued(cad, eps, &remarks);
  const Face& face = model.faces[0];
  EXPECT_NE(face.curves[0].ref, face.curves[2].ref);
  EXPECT_EQ(face.curves[1].end1, face.curves[1].end2);
  ASSERT_EQ(remarks.size(), 2U);
  EXPECT_EQ(remarks[0],
            "face 1, curve 2: the whole curve, 0.004 long, is nearer to a point than eps_glue = 0.01 and becomes one");
}

/// Squares and strips side by side, in any order: [position] of the faces, whose lower sides are [low, high].
std::map<int, std::array<int, 2>> sides_of_a_row(const std::vector<std::array<double, 3>>& row, std::vector<int> order,
                                                 double eps) {
  AnalyticCad cad;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto [low, high, z] = row[static_cast<std::size_t>(order[k])];
    AnalyticFace face = flat(rectangle({low, 0}, {high, 1}));
    face.at = [z = z](Vec2 p) { return SurfaceJet{{p.x(), p.y(), z}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}}; };
    cad.faces[static_cast<int>(k) + 1] = face;
  }
  const Model model = glued(cad, eps);
  std::map<int, std::array<int, 2>> sides;  // left and right, by place in the row
  for (std::size_t k = 0; k < order.size(); ++k)
    sides[order[k]] = {model.faces[k].curves[3].ref, model.faces[k].curves[1].ref};
  return sides;
}

// A is near B and B near C, but A not near C: one curve, whichever comes first.
TEST(Glue, IsTheSameInAnyOrderOfFaces) {
  const double eps = 0.01;
  const std::vector<std::array<double, 3>> chain{{0, 1, 0}, {1, 2, 0.8 * eps}, {1, 3, 1.6 * eps}};
  const std::vector<std::array<double, 3>> strip{{0, 1, 0}, {1, 1 + 0.4 * eps, 0}, {1 + 0.4 * eps, 2, 0}};
  std::vector<int> order{0, 1, 2};
  do {
    SCOPED_TRACE(::testing::PrintToString(order));
    auto sides = sides_of_a_row(chain, order, eps);
    EXPECT_EQ(sides[0][1], sides[1][0]);
    EXPECT_EQ(sides[1][0], sides[2][0]);
    // Each side of the strip belongs to the neighbour that it touches.
    sides = sides_of_a_row(strip, order, eps);
    EXPECT_EQ(sides[0][1], sides[1][0]);
    EXPECT_EQ(sides[1][1], sides[2][0]);
    EXPECT_NE(sides[1][0], sides[1][1]);
  } while (std::next_permutation(order.begin(), order.end()));
}

// Files have numbers of ten digits or so: a seam need not be exact to a thousandth of a fine tolerance.
TEST(Glue, FindsSeamsWithinTheRoundingOfFiles) {
  const AnalyticCad exact = cylinder();
  CurveTraces traces = traces_of(exact);
  const Model expected = glue(unglued(exact), traces, 1e-7);
  for (auto& of_face : traces)
    for (Vec3& p : of_face.back()) p.x() += 2e-10;
  EXPECT_EQ(references(glue(unglued(exact), traces, 1e-7)), references(expected));
}

TEST(Glue, ReportsCurvesThatItCloses) {
  AnalyticCad cad;
  cad.faces[1] = flat({arc({0, 0}, 1, 0.005, 2 * pi), segment({1, 0}, {std::cos(0.005), std::sin(0.005)})});
  Model model = unglued(cad);
  model.source = "x.pardom";
  model.faces[0].curves[0].line = 5;
  model.faces[0].curves[1].line = 6;
  std::vector<std::string> remarks;
  glue(model, traces_of(cad), 0.01, &remarks);
  ASSERT_EQ(remarks.size(), 2U);
  EXPECT_TRUE(contains(remarks[0], "x.pardom, line 5, face 1, curve 1: its ends are 0.0049")) << remarks[0];
  EXPECT_TRUE(contains(remarks[1], "x.pardom, line 6, face 1, curve 2: the whole curve, 0.0049")) << remarks[1];
}

TEST(Glue, KeepsInternalPointsAndTheOrderOfCurves) {
  Model model = unglued(paraboloid());
  model.faces[0].points.push_back({17, {0, 0}, 0});
  model.faces[0].orientation = 3;
  const Model result = glue(model, traces_of(paraboloid()), 0.01);
  ASSERT_EQ(result.faces[0].points.size(), 1U);
  EXPECT_EQ(result.faces[0].points[0].ref, 17);
  EXPECT_EQ(result.faces[0].orientation, 3);
}

TEST(Glue, GluesInternalCurvesOfOtherFacesOnly) {
  // A square with an internal line, twice given, and a second square that ends at that line.
  AnalyticCad cad;
  auto curves = rectangle({0, 0}, {2, 1});
  curves.push_back(segment({1, 0}, {1, 1}));
  curves.push_back(segment({1, 1}, {1, 0}));
  cad.faces[1] = flat(curves);
  cad.faces[2] = flat(rectangle({1, 0}, {3, 1}));
  Model model = unglued(cad);
  model.faces[0].curves[4].type = model.faces[0].curves[5].type = CurveType::internal;
  const Model result = glue(model, traces_of(cad), 0.01);
  EXPECT_EQ(result.faces[0].curves[4].ref, 5);
  EXPECT_EQ(result.faces[0].curves[5].ref, 6);
  EXPECT_EQ(result.faces[1].curves[3].ref, 5);
}

TEST(Glue, RejectsATolerancePositiveOnlyByMistakeAndTracesOfAnotherModel) {
  const Model model = unglued(paraboloid());
  EXPECT_THROW(glue(model, traces_of(paraboloid()), 0), InvalidArgument);
  EXPECT_THROW(glue(model, traces_of(paraboloid()), std::nan("")), InvalidArgument);
  EXPECT_THROW(glue(model, {}, 1), InvalidArgument);
  CurveTraces traces = traces_of(paraboloid());
  traces[0][2].resize(1);
  EXPECT_EQ(sentence_of<InvalidArgument>([&] { glue(model, traces, 1); }),
            "face 1, curve 3: the trace has less than two points");
}

}  // namespace
}  // namespace carreau
