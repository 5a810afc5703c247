// SPDX-License-Identifier: BSD-3-Clause
// The distance between two faces over triangles that cross.
#include "pipeline/inspect/face_gap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/analytic_cad.h"
#include "mesh/crossings/intersections.h"
#include "surface/supports.h"

namespace carreau {
namespace {

using std::numbers::pi;

SurfaceJet cylinder_jet(Vec2 p, double radius) {
  SurfaceJet jet;
  const double c = std::cos(p.x()), s = std::sin(p.x());
  jet.s = {radius * c, radius * s, p.y()};
  jet.su = {-radius * s, radius * c, 0}, jet.sv = {0, 0, 1};
  return jet;
}

/// Triangles of faces, each with its own vertices, without curves.
class Triangles {
 public:
  explicit Triangles(testing::AnalyticCad& cad) : cad_(cad) {}

  FaceTriangle add(int ref, const std::array<Vec2, 3>& uv) {
    FaceMesh face;
    face.ref = ref;
    for (const Vec2& p : uv) {
      face.uv.push_back(p);
      face.vertex.push_back(static_cast<std::int32_t>(mesh_.vertices.size()));
      mesh_.vertices.push_back(surface_at(cad_, ref, want_position, p).s);
    }
    face.triangles = {{0, 1, 2}};
    mesh_.faces.push_back(face);
    const CurveModel none{model_, topology_, supports_, cad_};
    return {mesh_, static_cast<int>(mesh_.faces.size()) - 1, 0, CurveEdges(mesh_, {}), {}, none};
  }

 private:
  testing::AnalyticCad& cad_;
  SurfaceMesh mesh_;
  Model model_;
  Topology topology_;
  std::vector<std::vector<CurveSupport>> supports_;
};

TEST(FaceGap, ConcentricCylindersHaveTheDifferenceOfTheirRadii) {
  testing::AnalyticCad cad;
  cad.faces[1].at = [](Vec2 p) { return cylinder_jet(p, 1); };
  cad.faces[2].at = [](Vec2 p) { return cylinder_jet(p, 0.95); };
  Triangles triangles(cad);
  const FaceTriangle outer = triangles.add(1, {Vec2{-0.5, 0}, Vec2{0.5, 0}, Vec2{0, 1}});
  const FaceTriangle inner = triangles.add(2, {Vec2{-0.4, 0.7}, Vec2{-0.3, -0.6}, Vec2{0.6, 0.1}});
  // The chord of the outer triangle lies inside the inner cylinder at cos(1/2) = 0.88.
  const Vec3 place{std::cos(0.5), 0, 0.1};
  const FaceGap gap = measure_gap(cad, outer, inner, place);
  EXPECT_NEAR(gap.width, 0.05, 1e-12);
  EXPECT_GE(gap.sagitta, 1 - std::cos(0.5) - 1e-12);  // at the place
  EXPECT_LE(gap.sagitta, 0.5 * 0.5 / 2 + 1e-12);      // of any chord of half an angle of 1/2
  // The same surface twice is a contact.
  const FaceTriangle other = triangles.add(1, {Vec2{-0.4, 0.7}, Vec2{-0.3, -0.6}, Vec2{0.6, 0.1}});
  EXPECT_LT(measure_gap(cad, outer, other, place).width, 1e-12);
}

TEST(FaceGap, IsZeroAtACommonPointAndNotBesideTheTriangles) {
  testing::AnalyticCad cad;
  cad.faces[1].at = [](Vec2 p) {
    SurfaceJet jet;
    jet.s = {p.x(), p.y(), p.x() * p.x() + p.y() * p.y()};
    jet.su = {1, 0, 2 * p.x()}, jet.sv = {0, 1, 2 * p.y()};
    return jet;
  };
  const auto plane = [](double x) {
    return [x](Vec2 p) {
      SurfaceJet jet;
      jet.s = {x, p.x(), p.y()}, jet.su = {0, 1, 0}, jet.sv = {0, 0, 1};
      return jet;
    };
  };
  cad.faces[2].at = plane(0.5), cad.faces[3].at = plane(1.5);
  Triangles triangles(cad);
  const FaceTriangle paraboloid = triangles.add(1, {Vec2{0.3, -0.3}, Vec2{0.9, -0.1}, Vec2{0.3, 0.5}});
  const FaceTriangle through = triangles.add(2, {Vec2{-0.4, -0.1}, Vec2{0.6, 0.1}, Vec2{0, 0.9}});
  const FaceTriangle beside = triangles.add(3, {Vec2{-0.4, -0.1}, Vec2{0.6, 0.1}, Vec2{0, 0.9}});
  const FaceGap meets = measure_gap(cad, paraboloid, through, {0.5, 0, 0.4});
  EXPECT_EQ(meets.width, 0);
  EXPECT_NEAR(meets.place.x(), 0.5, 1e-6);
  EXPECT_NEAR(meets.place.z(), 0.25 + meets.place.y() * meets.place.y(), 1e-6);
  // The plane x = 3/2 meets the paraboloid beyond the triangle, which ends at x = 0.9.
  EXPECT_GE(measure_gap(cad, paraboloid, beside, {0.9, 0, 0.4}).width, 0.6 - 1e-9);
}

/// The quarter x, y > 0 of the plane z = 0 outside a circle, and a triangle over one chord of the circle.
class PlaneWithHole {
 public:
  explicit PlaneWithHole(double radius) {
    cad.faces[1].at = [](Vec2 p) {
      SurfaceJet jet;
      jet.s = {p.x(), p.y(), 0}, jet.su = {1, 0, 0}, jet.sv = {0, 1, 0};
      return jet;
    };
    cad.faces[1].curves = {testing::arc({0, 0}, radius, pi / 2, 0)};
    curves_.resize(1);
    curves_[0].r = {0, 1}, curves_[0].t_of_use = {{0, 1}}, curves_[0].uv_of_use = {{{0, radius}, {radius, 0}}};
    topology_.curves.push_back({.ref = 1, .uses = {{.face = 0, .curve = 0}}});
    mesh_.vertices = {{0, radius, 0}, {radius, 0, 0}, {2 * radius, 2 * radius, 0}};
    FaceMesh face;
    face.ref = 1;
    face.uv = {{0, radius}, {radius, 0}, {2 * radius, 2 * radius}};
    face.vertex = {0, 1, 2}, face.triangles = {{0, 1, 2}};
    mesh_.faces = {face};
    mesh_.curves = {{.ref = 1, .vertices = {0, 1}, .uses = {{.face = 0}}}};
  }
  FaceTriangle triangle() {
    return {mesh_, 0, 0, CurveEdges(mesh_, curves_), curves_, {model_, topology_, supports_, cad}};
  }
  testing::AnalyticCad cad;

 private:
  Model model_;
  Topology topology_;
  std::vector<std::vector<CurveSupport>> supports_;
  std::vector<DiscreteCurve> curves_;
  SurfaceMesh mesh_;
};

TEST(FaceGap, EndsWhereCurvesEndTheFace) {
  PlaneWithHole plate(1);
  const FaceTriangle at_hole = plate.triangle();
  // The chord x + y = 1 crosses the hole: its middle is nearest to the middle of the arc.
  const Vec2 middle = at_hole.nearest(at_hole.position_of({0.5, 0.5, 0}));
  const OnFace on_arc = at_hole.evaluate(plate.cad, middle);
  // A quarter circle is followed by eight chords.
  const double off = 1 - std::cos(pi / 32);
  EXPECT_NEAR(norm(on_arc.jet.s), 1, off);
  // Beyond the arc the triangle is a piece of the face.
  const Vec3 inside{0.9, 0.9, 0};
  EXPECT_NEAR(norm(at_hole.evaluate(plate.cad, at_hole.nearest(at_hole.position_of(inside))).jet.s - inside), 0, 1e-14);
  // A cylinder of radius 0.9 in the hole stays 0.1 away, although the plane of the plate cuts it.
  plate.cad.faces[2].at = [](Vec2 p) { return cylinder_jet(p, 0.9); };
  Triangles triangles(plate.cad);
  const FaceTriangle bolt = triangles.add(2, {Vec2{0.3, -0.5}, Vec2{1.3, -0.4}, Vec2{0.8, 0.6}});
  const FaceGap gap = measure_gap(plate.cad, at_hole, bolt, {0.55, 0.55, 0});
  EXPECT_NEAR(gap.width, 0.1, off);
  EXPECT_GT(gap.sagitta, 1 - 0.55 * std::sqrt(2.) - off);
}

}  // namespace
}  // namespace carreau
