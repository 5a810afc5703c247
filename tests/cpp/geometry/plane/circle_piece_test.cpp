// SPDX-License-Identifier: BSD-3-Clause
// Arcs of circles against closed forms, alone and as curves of plane domains.
#include "geometry/plane/circle_piece.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/plane/plane_cad.h"
#include "geometry/plane/plane_geometry.h"
#include "session/session.h"
#include "support/error.h"

namespace carreau {
namespace {

constexpr double pi = std::numbers::pi;

Vec2 on_circle(const Vec2& centre, double radius, double angle) {
  return centre + radius * Vec2{std::cos(angle), std::sin(angle)};
}

TEST(CirclePiece, ThroughThreePointsHasTheCircleAndTheWay) {
  const Vec2 centre{3, -2};
  for (const double radius : {1e-3, 1.0, 1e4})
    for (const double start : {0.3, 3.0, -2.5})
      for (const double sweep : {0.01, 1.0, -2.0, 4.0, -6.0, 6.28}) {
        const auto at = [&](double t) { return on_circle(centre, radius, start + sweep * t); };
        const auto arc = arc_through(at(0), at(0.3), at(1));
        ASSERT_TRUE(arc);
        // Three points fix a circle less well where the arc is flat, its sagitta being the sweep squared, or two are close.
        const double close = norm(Vec2(at(1) - at(0))) / radius;
        const double rounding = 1e-15 * (radius + norm(centre)) / std::min({1.0, sweep * sweep / 8, close});
        EXPECT_NEAR(arc->radius, radius, 100 * rounding) << radius << " " << sweep;
        EXPECT_NEAR(arc->sweep, sweep, 100 * rounding / radius);
        for (const double t : {0.0, 0.25, 0.5, 1.0})
          EXPECT_LE(norm(Vec2(arc->at(t) - at(t))), 10 * rounding) << radius << " " << start << " " << sweep;
      }
}

TEST(CirclePiece, FromAPointToItselfIsTheWholeCircle) {
  const auto circle = arc_through({1, 0}, {-1, 0}, {1, 0});
  ASSERT_TRUE(circle);
  EXPECT_EQ(circle->radius, 1);
  EXPECT_EQ(circle->sweep, 2 * pi);
  EXPECT_LE(norm(Vec2(circle->at(0.25) - Vec2{0, 1})), 1e-15);
}

TEST(CirclePiece, PointsOnALineHaveNone) {
  EXPECT_FALSE(arc_through({0, 0}, {1, 1}, {2, 2}));
  EXPECT_FALSE(arc_through({0, 0}, {3, 3}, {2, 2}));
}

TEST(CirclePiece, CurvatureIsOneOverTheRadiusAndDerivativesMatchThePoints) {
  const auto arc = arc_through({0, 0}, {1, 2}, {5, 1});
  ASSERT_TRUE(arc);
  for (double t = 0; t <= 1; t += 0.125) {
    const Vec2 d = arc->first(t), dd = arc->second(t);
    EXPECT_NEAR(cross(d, dd) / std::pow(norm(d), 3) * arc->radius, arc->sweep > 0 ? 1 : -1, 1e-14);
    const double h = 1e-5;
    EXPECT_LE(norm(Vec2((arc->at(t + h) - arc->at(t - h)) / (2 * h) - d)), 1e-8 * norm(d));
    EXPECT_LE(norm(Vec2((arc->first(t + h) - arc->first(t - h)) / (2 * h) - dd)), 1e-8 * norm(dd));
  }
}

TEST(CirclePiece, PartsMeetAtThePointOfTheCut) {
  const Vec2 m{1, 2};
  const auto arc = arc_through({0, 0}, m, {5, 1});
  const auto [before, behind] = cut_at(*arc, m);
  EXPECT_LE(norm(Vec2(before.at(1) - m)), 1e-15);
  EXPECT_LE(norm(Vec2(behind.at(0) - m)), 1e-15);
  EXPECT_LE(norm(Vec2(behind.at(1) - Vec2{5, 1})), 1e-14);
  EXPECT_NEAR(before.sweep + behind.sweep, arc->sweep, 1e-15);
  EXPECT_GT(before.sweep * arc->sweep, 0);
  EXPECT_GT(behind.sweep * arc->sweep, 0);
}

TEST(CirclePiece, EdgesOfPolylinesKeepTheTolerance) {
  for (const double sweep : {0.05, 1.0, -3.0, 2 * pi})
    for (const double eps : {0.5, 0.01, 1e-4}) {
      const CirclePiece arc{{0, 0}, 2, 0.4, sweep};
      const std::vector<double> cuts = subdivide(arc, eps);
      const double part = std::abs(sweep) / static_cast<double>(cuts.size() + 1);
      const double chord = 2 * arc.radius * std::sin(part / 2), height = arc.radius * (1 - std::cos(part / 2));
      EXPECT_LE(height, eps * chord * (1 + 1e-12));
      EXPECT_LE(part, pi / 2 + 1e-12);
    }
  EXPECT_THROW(subdivide(CirclePiece{{0, 0}, 1, 0, 1}, 0), InvalidArgument);
}

/// A disc segment of radius r: an arc that sweeps `sweep`, closed by its chord. The point between lies off the middle.
PlaneDomainInput disc_segment(double r, double sweep) {
  PlaneDomainInput input;
  for (const double share : {0.0, 0.37, 1.0}) input.points.push_back({.xy = on_circle({1, 2}, r, 0.7 + share * sweep)});
  input.curves.push_back({.points = {0, 1, 2}, .arcs = true, .ref = 5});
  input.curves.push_back({.points = {2, 0}});
  return input;
}

std::unique_ptr<Session> meshed(const PlaneDomainInput& input, double size, Monitor& monitor) {
  PlaneGeometry plane = build_plane_geometry(input);
  auto session = std::make_unique<Session>(monitor);
  session->set_cad(plane.built.cad);
  session->set_model(plane.built.model);
  session->parameters().set("hphydef", size);
  session->parameters().set("hphymin", 1e-6);
  session->make_mesh();
  return session;
}

double area_of(const SurfaceMesh& mesh) {
  double area = 0;
  for (const FaceMesh& face : mesh.faces)
    for (const auto& t : face.triangles) {
      const auto p = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(face.vertex[t[k]])]; };
      area += norm(cross(Vec3(p(1) - p(0)), Vec3(p(2) - p(0)))) / 2;
    }
  return area;
}

TEST(PlaneArcsOfCircles, AreaOfDiscSegmentsMatchesEqualEdges) {
  for (const double sweep : {1.0, 2.5, 5.0}) {
    const double r = 1.5, size = 0.1;
    Monitor silent;
    const auto session = meshed(disc_segment(r, sweep), size, silent);
    int edges = 0;
    for (const CurveMesh& curve : session->mesh().curves)
      if (curve.shown_ref() == 5) edges += static_cast<int>(curve.vertices.size()) - 1;
    EXPECT_NEAR(edges, r * sweep / size, 1);
    const double inscribed = r * r / 2 * (edges * std::sin(sweep / edges) - std::sin(sweep));
    EXPECT_NEAR(area_of(session->mesh()), inscribed, 1e-9 * inscribed) << sweep;
    // The polygon misses the segment by order 2 in the size.
    EXPECT_NEAR(area_of(session->mesh()), r * r / 2 * (sweep - std::sin(sweep)), r * sweep * size * size / 12 / r * 1.1);
  }
}

TEST(PlaneArcsOfCircles, HaveTheirCurvatureAndTheirEndsBitForBit) {
  const PlaneDomainInput input = disc_segment(0.25, 4);
  const PlaneGeometry plane = build_plane_geometry(input);
  ASSERT_EQ(plane.built.model.faces.size(), 1u);
  EXPECT_EQ(plane.built.model.faces[0].curves.size(), 2u);  // the point between is no vertex
  const int face = plane.built.model.faces[0].ref;
  for (double t = 0; t <= 1; t += 0.1) {
    const CurveJet jet = plane.built.cad->curve(face, 1, 0, t);
    EXPECT_NEAR(std::abs(cross(jet.ct, jet.ctt)) / std::pow(norm(jet.ct), 3), 4, 1e-12);
  }
  EXPECT_EQ(plane.built.cad->curve(face, 1, 0, 0).c, input.points[0].xy);
  EXPECT_EQ(plane.built.cad->curve(face, 1, 0, 1).c, input.points[2].xy);
}

TEST(PlaneArcsOfCircles, AreCutWherePointsBetweenAreVertices) {
  PlaneDomainInput input = disc_segment(1, 3);
  input.points[1].imposed = true;
  Monitor silent;
  const auto session = meshed(input, 0.05, silent);
  const Vec2 m = input.points[1].xy;
  double nearest = 1;
  for (const Vec3& p : session->mesh().vertices) nearest = std::min(nearest, norm(Vec3(p - Vec3{m.x(), m.y(), 0})));
  EXPECT_EQ(nearest, 0);
  EXPECT_EQ(session->model().faces[0].curves.size(), 3u);
}

TEST(PlaneArcsOfCircles, ACircleIsOneCurve) {
  PlaneDomainInput input;
  input.points = {{.xy = {2, 0}}, {.xy = {-2, 0}}};
  input.curves = {{.points = {0, 1, 0}, .arcs = true}};
  Monitor silent;
  const auto session = meshed(input, 0.1, silent);
  int edges = 0;
  for (const CurveMesh& curve : session->mesh().curves) edges += static_cast<int>(curve.vertices.size()) - 1;
  EXPECT_NEAR(area_of(session->mesh()), 2.0 * edges * std::sin(2 * pi / edges), 1e-9);
  for (const CurveMesh& curve : session->mesh().curves)
    for (const auto v : curve.vertices)
      EXPECT_NEAR(norm(session->mesh().vertices[static_cast<std::size_t>(v)]), 2, 1e-14);
}

TEST(PlaneArcsOfCircles, MistakesAreReportedWithTheirPlaces) {
  const auto sentence_of = [](const PlaneDomainInput& input) -> std::string {
    try {
      (void)build_plane_geometry(input);
    } catch (const InvalidModel& error) {
      return error.what();
    }
    return "";
  };
  PlaneDomainInput input = disc_segment(1, 3);
  input.source = "x.data", input.curves[0].line = 9, input.curves[0].name = "C";
  input.curves[0].points = {0, 1};
  EXPECT_NE(sentence_of(input).find("x.data, line 9: curve 'C' of arcs passes 2 points; each arc has a start"),
            std::string::npos)
      << sentence_of(input);
  input.curves[0].points = {0, 1, 2};
  input.points[0].xy = {0, 0}, input.points[1].xy = {1, 0}, input.points[2].xy = {2, 0};
  EXPECT_NE(sentence_of(input).find("curve 'C' has no arc through point 1, point 2 and point 3: they lie on one line"),
            std::string::npos)
      << sentence_of(input);
  // An arc that bulges through a segment of another curve.
  PlaneDomainInput crossing = disc_segment(1, 3);
  crossing.points.push_back({.xy = {1, 3.5}});
  crossing.points.push_back({.xy = {1, 2.5}});
  crossing.curves.push_back({.points = {3, 4}});
  EXPECT_NE(sentence_of(crossing).find("curve 1 and curve 3 cross or touch at"), std::string::npos)
      << sentence_of(crossing);
}

}  // namespace
}  // namespace carreau
