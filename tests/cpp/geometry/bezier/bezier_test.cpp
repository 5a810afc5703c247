// SPDX-License-Identifier: BSD-3-Clause
// Bezier patches against the polynomials that they are.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cad/fundamental_forms.h"
#include "geometry/bezier/bezier_cad.h"
#include "geometry/bezier/bezier_geometry.h"
#include "support/error.h"

namespace carreau {
namespace {

/// A control net of S = (u, v, a + b u + c v + d u^2 + e u v + f v^2), of any degrees from 2 on.
struct Quadric {
  double a, b, c, d, e, f;

  [[nodiscard]] BezierPatch patch(int m, int n) const {
    BezierPatch patch{.m = m, .n = n, .control = {}};
    for (int i = 0; i <= m; ++i)
      for (int j = 0; j <= n; ++j) {
        const double u = double(i) / m, v = double(j) / n;
        const double uu = double(i) * (i - 1) / (double(m) * (m - 1)), vv = double(j) * (j - 1) / (double(n) * (n - 1));
        patch.control.emplace_back(u, v, a + b * u + c * v + d * uu + e * u * v + f * vv);
      }
    return patch;
  }
};

constexpr unsigned all = want_position | want_first | want_second;

TEST(BezierPatch, IsItsPolynomialInAnyDegree) {
  const Quadric q{0.3, -1, 2, 1.5, -0.7, 0.4};
  for (const auto& [m, n] : {std::pair{2, 2}, {3, 5}, {9, 2}, {15, 15}}) {
    const BezierPatch patch = q.patch(m, n);
    for (const Vec2& uv : {Vec2{0, 0}, Vec2{1, 0}, Vec2{0.3, 0.9}, Vec2{0.5, 0.5}, Vec2{1, 1}}) {
      const double u = uv.x(), v = uv.y();
      SurfaceJet jet;
      evaluate(patch, all, uv, jet);
      const double near = 1e-12 * m * n;
      EXPECT_NEAR(jet.s.x(), u, 1e-14);
      EXPECT_NEAR(jet.s.z(), q.a + q.b * u + q.c * v + q.d * u * u + q.e * u * v + q.f * v * v, 1e-14);
      EXPECT_NEAR(jet.su.z(), q.b + 2 * q.d * u + q.e * v, near);
      EXPECT_NEAR(jet.sv.z(), q.c + q.e * u + 2 * q.f * v, near);
      EXPECT_NEAR(jet.su.x(), 1, near);
      EXPECT_NEAR(jet.sv.x(), 0, near);
      EXPECT_NEAR(jet.suu.z(), 2 * q.d, near);
      EXPECT_NEAR(jet.suv.z(), q.e, near);
      EXPECT_NEAR(jet.svv.z(), 2 * q.f, near);
    }
  }
}

TEST(BezierPatch, DegreeOneHasNoSecondDerivative) {
  BezierPatch patch{.m = 1, .n = 1, .control = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 1}}};
  SurfaceJet jet;
  evaluate(patch, all, {0.25, 0.5}, jet);
  EXPECT_EQ(jet.suu, Vec3(0, 0, 0));
  EXPECT_EQ(jet.svv, Vec3(0, 0, 0));
  EXPECT_EQ(jet.suv, Vec3(0, 0, 1));
  EXPECT_EQ(jet.s, Vec3(0.25, 0.5, 0.125));
}

// Convex combinations: no digit is lost between control points, whatever the degree.
TEST(BezierPatch, StaysInTheBoxOfItsControlPoints) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-1, 1), parameter(0, 1);
  BezierPatch patch{.m = 15, .n = 15, .control = {}};
  for (int i = 0; i < 256; ++i) patch.control.emplace_back(coordinate(random), coordinate(random), 1.0);
  for (int i = 0; i < 200; ++i) {
    SurfaceJet jet;
    evaluate(patch, want_position, {parameter(random), parameter(random)}, jet);
    EXPECT_LE(std::abs(jet.s.x()), 1);
    EXPECT_NEAR(jet.s.z(), 1, 1e-14);
  }
}

TEST(BezierCad, RadiiMatchTheParaboloid) {
  // z = (u^2 + v^2) / 2: at the distance r from the axis the radii are sqrt(1 + r^2) and its cube.
  BezierCad cad({Quadric{0, 0, 0, 0.5, 0, 0.5}.patch(3, 4)});
  for (const double r : {0.0, 0.3, 0.8}) {
    EXPECT_NEAR(*cad.surface_radius(1, {r, 0}), std::sqrt(1 + r * r), 1e-12);
    EXPECT_NEAR(*cad.curve_radius(1, 1, r), std::pow(1 + r * r, 1.5), 1e-12);  // the parabola v = 0
  }
  BezierCad flat({Quadric{0, 0, 0, 0, 0, 0}.patch(2, 2)});
  EXPECT_FALSE(flat.curve_radius(1, 1, 0.5).has_value() && *flat.curve_radius(1, 1, 0.5) < 1e12);
}

TEST(BezierCad, SidesRunAroundTheSquare) {
  BezierCad cad({Quadric{0, 0, 0, 0, 1, 0}.patch(2, 2)});
  for (int ic = 1; ic <= 4; ++ic) {
    const Vec2 end = cad.curve(1, ic, all, 1).c, next = cad.curve(1, ic % 4 + 1, all, 0).c;
    EXPECT_EQ(end, next);
  }
  EXPECT_THROW(cad.curve(1, 5, all, 0), InvalidArgument);
  EXPECT_THROW(cad.curve(2, 1, all, 0), InvalidArgument);
}

TEST(BezierGeometry, CornersOfSharedSidesAreOne) {
  const BezierPatch patch = Quadric{0, 0, 0, 0, 0, 0}.patch(2, 2);
  BezierPatch beside = patch, above = patch;
  for (Vec3& p : beside.control) p.x() += 1;
  for (Vec3& p : above.control) p.y() += 1;
  // u = 1 of the first is u = 0 of the second, v = 1 of the first is v = 0 of the third.
  const BuiltGeometry built =
      build_bezier({.patches = {patch, beside, above}, .side_refs = {{{1, 2, 3, 4}, {5, 6, 7, 2}, {3, 8, 9, 10}}}});
  const auto& faces = built.model.faces;
  EXPECT_EQ(faces[0].curves[1].end1, faces[1].curves[3].end2);
  EXPECT_EQ(faces[0].curves[1].end2, faces[1].curves[3].end1);
  EXPECT_EQ(faces[0].curves[2].end1, faces[2].curves[0].end2);
  EXPECT_EQ(faces[1].curves[2].end2, faces[2].curves[0].end2);  // all three
  int largest = 0;
  for (const Face& face : faces)
    for (const FaceCurve& curve : face.curves) largest = std::max({largest, curve.end1, curve.end2});
  EXPECT_EQ(largest, 8);
  EXPECT_THROW(build_bezier({.patches = {patch}, .side_refs = {{{1, 2, 3, 0}}}}), InvalidArgument);
  EXPECT_THROW(build_bezier({}), InvalidArgument);
}

}  // namespace
}  // namespace carreau
