// SPDX-License-Identifier: BSD-3-Clause
// Plane domains: which faces there are, their references, and a sentence for each mistake.
#include "geometry/plane/plane_geometry.h"

#include <gtest/gtest.h>

#include <numbers>

#include "geometry/plane/plane_cad.h"
#include "model/topology.h"
#include "support/error.h"

namespace carreau {
namespace {

/// Appends a closed polygon as one curve; returns its index.
int add_loop(PlaneDomainInput& input, const std::vector<Vec2>& corners, bool smooth = false) {
  PlaneCurve curve;
  curve.smooth = smooth;
  const int first = static_cast<int>(input.points.size());
  for (const Vec2& p : corners) {
    curve.points.push_back(static_cast<int>(input.points.size()));
    input.points.push_back({.xy = p});
  }
  curve.points.push_back(first);
  input.curves.push_back(curve);
  return static_cast<int>(input.curves.size()) - 1;
}

std::vector<Vec2> square(double half, const Vec2& centre = {0, 0}) {
  return {centre + Vec2{-half, -half}, centre + Vec2{half, -half}, centre + Vec2{half, half},
          centre + Vec2{-half, half}};
}

int add_segment(PlaneDomainInput& input, int a, int b) {
  input.curves.push_back({.points = {a, b}});
  return static_cast<int>(input.curves.size()) - 1;
}

std::string sentence_of(const PlaneDomainInput& input) {
  try {
    (void)build_plane_geometry(input);
  } catch (const InvalidModel& error) {
    return error.what();
  }
  return "";
}

int count(const Face& face, CurveType type) {
  int n = 0;
  for (const FaceCurve& curve : face.curves) n += curve.type == type ? 1 : 0;
  return n;
}

TEST(PlaneGeometry, NestedSquaresAlternateByParity) {
  PlaneDomainInput input;
  for (const double half : {4.0, 3.0, 2.0, 1.0}) add_loop(input, square(half));
  const PlaneGeometry plane = build_plane_geometry(input);
  const Model& model = plane.built.model;
  ASSERT_EQ(model.faces.size(), 2u);
  EXPECT_EQ(model.faces[0].curves.size(), 8u);
  EXPECT_EQ(model.faces[1].curves.size(), 8u);
  EXPECT_TRUE(find_model_defects(model).empty());
  input.rest = PlaneRest::inside;
  EXPECT_EQ(build_plane_geometry(input).built.model.faces.size(), 4u);
  EXPECT_EQ(plane.low, Vec2(-4, -4));
  EXPECT_EQ(plane.high, Vec2(4, 4));
}

TEST(PlaneGeometry, SidesNameSubdomainsAndSharedCurvesAreInBoth) {
  PlaneDomainInput input;
  const int outer = add_loop(input, square(2)), inner = add_loop(input, square(1));
  input.curves[inner].ref = 5;
  input.rest = PlaneRest::outside;
  input.sides = {{.curve = outer, .left = true, .ref = 200}, {.curve = inner, .left = true, .ref = 7}};
  const Model model = build_plane_geometry(input).built.model;
  ASSERT_EQ(model.faces.size(), 2u);
  EXPECT_EQ(model.faces[0].ref, 200);
  EXPECT_EQ(model.faces[1].ref, 7);
  EXPECT_EQ(model.faces[0].curves.size(), 8u);
  EXPECT_EQ(model.faces[1].curves.size(), 4u);
  for (const FaceCurve& curve : model.faces[1].curves) EXPECT_EQ(curve.shown_as == 0 ? curve.ref : curve.shown_as, 5);
  EXPECT_TRUE(find_model_defects(model).empty());
}

TEST(PlaneGeometry, OneReferenceOfSeveralSubdomainsMakesThemPartsOfOneFace) {
  PlaneDomainInput input;
  input.rest = PlaneRest::outside;
  const int a = add_loop(input, square(1)), b = add_loop(input, square(1, {5, 0})),
            c = add_loop(input, square(1, {9, 0}));
  input.sides = {{.curve = a, .ref = 3}, {.curve = b, .ref = 0}, {.curve = c, .ref = 3}};
  const Model model = build_plane_geometry(input).built.model;
  ASSERT_EQ(model.faces.size(), 3u);
  EXPECT_EQ(model.faces[0].ref, 3);
  EXPECT_EQ(model.faces[1].part_of, 3);
  EXPECT_EQ(model.faces[2].part_of, 0);
  EXPECT_GT(model.faces[2].ref, 3);
}

TEST(PlaneGeometry, DanglingCurvesAreInternalAndPointsAreImposedWhereTheyLie) {
  PlaneDomainInput input;
  add_loop(input, square(2));
  input.points.push_back({.xy = {0, 0}});
  input.points.push_back({.xy = {1, 1}, .ref = 9});
  input.points.push_back({.xy = {-1, 0.5}, .ref = 9, .imposed = true});
  add_segment(input, 0, 4);
  add_segment(input, 4, 5);
  const Model model = build_plane_geometry(input).built.model;
  ASSERT_EQ(model.faces.size(), 1u);
  EXPECT_EQ(count(model.faces[0], CurveType::internal), 2);
  EXPECT_EQ(count(model.faces[0], CurveType::boundary), 4);
  ASSERT_EQ(model.faces[0].points.size(), 1u);
  EXPECT_EQ(model.shown_points.at(model.faces[0].points[0].ref), 9);
  EXPECT_TRUE(find_model_defects(model).empty());
}

TEST(PlaneGeometry, ASplineIsCutWhereAnotherCurveEnds) {
  PlaneDomainInput input;
  std::vector<Vec2> circle;
  for (int i = 0; i < 16; ++i)
    circle.push_back({std::cos(i * std::numbers::pi / 8), std::sin(i * std::numbers::pi / 8)});
  add_loop(input, circle, true);
  EXPECT_EQ(build_plane_geometry(input).built.model.faces[0].curves.size(), 1u);
  add_segment(input, 4, 12);
  const PlaneGeometry plane = build_plane_geometry(input);
  ASSERT_EQ(plane.built.model.faces.size(), 2u);
  const auto& cad = dynamic_cast<const PlaneCad&>(*plane.built.cad);
  EXPECT_EQ(cad.arcs().size(), 4u);  // the circle from 0 to 4, 12 and 0 again, and the chord
  EXPECT_EQ(cad.arcs()[1].pieces.size(), 8u);
  for (const PlaneArc& arc : cad.arcs()) {
    EXPECT_EQ(arc.polyline.front(), input.points[arc.from].xy);
    EXPECT_EQ(arc.polyline.back(), input.points[arc.to].xy);
  }
}

TEST(PlaneGeometry, HolesAreTakenAwayAndRegionsHaveTheirReferences) {
  PlaneDomainInput input;
  input.rest = PlaneRest::inside;
  add_loop(input, square(4));
  add_loop(input, square(1, {-2, 0}));
  add_loop(input, square(1, {2, 0}));
  input.seeds = {
      {.at = {-2, 0}, .hole = true}, {.at = {2, 0.5}, .hole = false, .ref = 8}, {.at = {90, 0}, .hole = true}};
  const Model model = build_plane_geometry(input).built.model;
  ASSERT_EQ(model.faces.size(), 2u);
  EXPECT_EQ(model.faces[0].ref, 8);
  EXPECT_EQ(model.faces[0].curves.size(), 4u);
  EXPECT_EQ(model.faces[1].curves.size(), 12u);
}

TEST(PlaneGeometry, SizesVaryAlongACurveWithItsLength) {
  PlaneDomainInput input;
  add_loop(input, {{0, 0}, {4, 0}, {4, 3}});
  input.points[0].size = 1;
  input.points[1].size = 3;
  const PlaneGeometry plane = build_plane_geometry(input);
  ASSERT_TRUE(plane.sizes);
  const Model& model = plane.built.model;
  bool seen = false;
  for (std::size_t c = 0; c < model.faces[0].curves.size(); ++c) {
    if (model.faces[0].curves[c].end1 != model.faces[0].curves[0].end1) continue;
    const Prescription middle =
        plane.sizes->on_curve(model.faces[0].ref, static_cast<int>(c) + 1, 0.5, {2, 0}, {2, 0, 0});
    EXPECT_NEAR(middle.size, 2, 1e-12);
    seen = true;
  }
  EXPECT_TRUE(seen);
}

TEST(PlaneGeometry, MistakesAreReportedWithTheirPlaces) {
  PlaneDomainInput open;
  open.points = {{.xy = {0, 0}}, {.xy = {1, 0}}, {.xy = {1, 1}, .name = "C"}};
  open.curves = {{.points = {0, 1, 2}, .name = "s"}};
  EXPECT_NE(sentence_of(open).find("its boundary is open, since only one curve ends at point 1"), std::string::npos);
  open.sides = {{.curve = 0}};
  EXPECT_NE(sentence_of(open).find("the domain lies on the left of curve 's', but its boundary is open"),
            std::string::npos);

  PlaneDomainInput wrong;
  add_loop(wrong, square(1));
  wrong.sides = {{.curve = 0, .left = false}};
  EXPECT_NE(sentence_of(wrong).find("which is its outer side"), std::string::npos);

  PlaneDomainInput crossing;
  add_loop(crossing, {{0, 0}, {1, 0}, {0, 1}, {1, 1}});
  EXPECT_NE(sentence_of(crossing).find("curve 1 crosses or touches itself at (0.5, 0.5)"), std::string::npos);
  PlaneDomainInput two;
  add_loop(two, square(1));
  add_loop(two, square(1, {1, 0.5}));
  EXPECT_NE(sentence_of(two).find("curve 1 and curve 2 cross or touch at"), std::string::npos);

  PlaneDomainInput same;
  add_loop(same, {{0, 0}, {1, 0}, {1, 0}, {0, 1}});
  EXPECT_NE(sentence_of(same).find("point 2 and point 3 are at the same place (1, 0)"), std::string::npos);

  PlaneDomainInput loop;
  add_loop(loop, {{0, 0}, {1, 0}, {0.5, -1}}, false);
  loop.curves[0] = {.points = {0, 1}, .smooth = true, .tangent_start = Vec2{6, 4}, .tangent_end = Vec2{6, -4}};
  EXPECT_NE(sentence_of(loop).find("makes a loop between point 1 and point 2: it passes (0.5"), std::string::npos);

  PlaneDomainInput on;
  add_loop(on, square(1));
  on.points.push_back({.xy = {0, 1}, .imposed = true});
  EXPECT_NE(sentence_of(on).find("point 5 lies on a curve that does not pass it"), std::string::npos);
  on.points.back().xy = {0, 3};
  EXPECT_NE(sentence_of(on).find("the imposed point 5 lies outside of the domain"), std::string::npos);
  on.points.back() = {.xy = {0, 0}, .size = 0.0};
  EXPECT_NE(sentence_of(on).find("has the size 0; sizes must be positive"), std::string::npos);
  EXPECT_NE(sentence_of({}).find("it has no curve"), std::string::npos);
}

TEST(PlaneGeometry, TwoClaimsOnOneSubdomainContradict) {
  PlaneDomainInput input;
  add_loop(input, square(2));
  input.sides = {{.curve = 0, .ref = 1}};
  input.seeds = {{.at = {0, 0}, .ref = 2}};
  EXPECT_NE(sentence_of(input).find("name one subdomain, but give it the references 2 and 1"), std::string::npos);
}

// Random segments of a triangulated grid, whatever is left out: faces and their curves satisfy Euler's relation, and
// points are in the face that the grid gives.
TEST(PlaneGeometry, FacesOfACheckerboardAreItsSquares) {
  PlaneDomainInput input;
  input.rest = PlaneRest::inside;
  constexpr int n = 12;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) input.points.push_back({.xy = {double(i), double(j)}});
  const auto at = [](int i, int j) { return j * (n + 1) + i; };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i < n; ++i) add_segment(input, at(i, j), at(i + 1, j)), add_segment(input, at(j, i + 1), at(j, i));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) input.seeds.push_back({.at = {i + 0.5, j + 0.25}, .ref = 1 + i + n * j});
  const Model model = build_plane_geometry(input).built.model;
  ASSERT_EQ(model.faces.size(), std::size_t(n * n));
  for (const Face& face : model.faces) {
    ASSERT_EQ(face.curves.size(), 4u);
    double x = 0, y = 0;
    for (const FaceCurve& curve : face.curves) {
      // Points have no references: the model numbers them from 1, in their order.
      x += input.points[curve.end1 - 1].xy.x() + input.points[curve.end2 - 1].xy.x();
      y += input.points[curve.end1 - 1].xy.y() + input.points[curve.end2 - 1].xy.y();
    }
    EXPECT_EQ(face.ref, 1 + int(x / 8) + n * int(y / 8));
  }
}

}  // namespace
}  // namespace carreau
