// SPDX-License-Identifier: BSD-3-Clause
// Points for quadrilaterals: where a lattice fits, they are its points.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "plane/plane_mesher.h"
#include "plane_cases.h"
#include "plane_checks.h"

namespace carreau {
namespace {

using namespace testing;

/// [0, n]^2 with unit edges, mapped by a linear map.
PlaneDomain lattice_border(int n, const Vec2& e, const Vec2& f) {
  PlaneDomain domain;
  for (int side = 0; side < 4; ++side)
    for (int k = 0; k < n; ++k) {
      const double s = side == 0 ? k : side == 1 ? n : side == 2 ? n - k : 0;
      const double t = side == 0 ? 0 : side == 1 ? k : side == 2 ? n : n - k;
      domain.vertices.push_back(s * e + t * f);
    }
  for (int v = 0; v < 4 * n; ++v) domain.edges.push_back({v, (v + 1) % (4 * n)});
  return domain;
}

PlaneMesh squares(const PlaneDomain& domain, const ControlSpace& space) {
  PlaneMesherOptions options;
  options.squares = true;
  Monitor monitor;
  return mesh_plane(domain, space, options, monitor);
}

TEST(Squares, AreTheLatticeOfASquareInAnyConstantMetric) {
  constexpr int n = 12;
  for (const auto& [e, f] : {std::pair(Vec2{1, 0}, Vec2{0, 1}), std::pair(Vec2{0.8, 0.6}, Vec2{-0.6, 0.8}),
                             std::pair(Vec2{0.2, 0}, Vec2{0, 1}), std::pair(Vec2{1, 0.2}, Vec2{0.3, 2})}) {
    // The metric in which e and f are orthonormal: (e f)^-T (e f)^-1.
    const double det = cross(e, f);
    const Vec2 row1{f.y() / det, -f.x() / det}, row2{-e.y() / det, e.x() / det};
    const Metric2 m{row1.x() * row1.x() + row2.x() * row2.x(), row1.x() * row1.y() + row2.x() * row2.y(),
                    row1.y() * row1.y() + row2.y() * row2.y()};
    const PlaneMesh mesh = squares(lattice_border(n, e, f), ControlSpace::constant(m));
    EXPECT_EQ(mesh.vertices.size(), std::size_t{(n + 1) * (n + 1)});
    EXPECT_EQ(mesh.triangles.size(), std::size_t{2 * n * n});
    for (const Vec2& p : mesh.vertices) {
      const double s = dot(row1, p), t = dot(row2, p);
      EXPECT_NEAR(s, std::round(s), 1e-6);
      EXPECT_NEAR(t, std::round(t), 1e-6);
    }
  }
}

/// Polar lattice: vertices lie on circles about the centre, whose radii are a unit apart.
TEST(Squares, FollowTheCirclesOfARing) {
  constexpr double h = 0.05, inside = 1, outside = 1.5;
  PlaneCase c{"ring", [](Vec2 p) -> Vec3 { return {p.x(), p.y(), 0}; }, [](Vec2) { return h; }, {}, {-2, -2}, {2, 2}};
  const auto circle = [](double r, double turn) {
    return [=](double t) -> Vec2 {
      const double a = 2 * std::numbers::pi * turn * t;
      return {r * std::cos(a), r * std::sin(a)};
    };
  };
  append_closed_curve(c, circle(outside, 1));
  append_closed_curve(c, circle(inside, -1));
  const PlaneMesh mesh = squares(c.domain, control_space(c));
  EXPECT_TRUE(find_plane_defects(c.domain, mesh).empty());
  std::size_t on_circles = 0;
  for (const Vec2& p : mesh.vertices) {
    const double layer = (norm(p) - inside) / h;
    on_circles += std::abs(layer - std::round(layer)) < 0.1 ? 1 : 0;
  }
  EXPECT_GT(on_circles, mesh.vertices.size() * 85 / 100);
}

TEST(Squares, AreSoundMeshesOfAllCases) {
  for (const PlaneCase& c : {paraboloid(0.3), hemisphere(0.1), swirl(0.05), stretched(0.3), size_field(0.3), holes(0.05),
                             star(0.05), internal_curves(0.05), polar_disc(0.1), polar_cone(0.1, 0.25),
                             sphere_two_poles(0.15)}) {
    const ControlSpace space = control_space(c);
    const PlaneMesh mesh = squares(c.domain, space);
    const std::vector<std::string> defects = find_plane_defects(c.domain, mesh);
    EXPECT_TRUE(defects.empty()) << c.name << ": " << (defects.empty() ? "" : defects.front());
    // A unit square holds 4 / sqrt(3) unit triangles.
    const double wanted = space.measure() * std::numbers::sqrt3 / 2;
    EXPECT_NEAR(static_cast<double>(mesh.triangles.size()), wanted, 0.35 * wanted) << c.name;
    EXPECT_EQ(squares(c.domain, space).triangles, mesh.triangles) << c.name;
  }
}

}  // namespace
}  // namespace carreau
