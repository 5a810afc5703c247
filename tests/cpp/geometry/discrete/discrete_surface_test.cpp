// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "geometry/discrete/discrete_cad.h"
#include "geometry/discrete/normals.h"
#include "geometry/discrete/refinement.h"
#include "geometry/discrete/surface.h"
#include "geometry/discrete/unfolding.h"
#include "mesh/quality.h"
#include "model/topology.h"
#include "support/error.h"
#include "surfaces.h"

namespace carreau::discrete {
namespace {

constexpr double degree = std::numbers::pi / 180;

TEST(WaltonMeek, ArcsOfTheUnitSphere) {
  // Computed for this test: the middle of the cubic between points of the unit sphere with its normals.
  for (const auto& [angle, radius] : {std::pair{63.434948822922, 0.994762}, {90.0, 0.972272}, {30.0, 0.999791}}) {
    const Vec3 p{1, 0, 0}, q{std::cos(angle * degree), std::sin(angle * degree), 0};
    const Cubic z = curve_by_normals(p, q, p, q);
    EXPECT_NEAR(norm(point_of(z, 0.5)), radius, 5e-7);
    EXPECT_NEAR(dot(z[1] - z[0], p), 0, 1e-15);
    EXPECT_NEAR(dot(z[3] - z[2], q), 0, 1e-15);
  }
}

TEST(WaltonMeek, TangentsAreOrthogonalToAnyNormals) {
  for (int k = 0; k < 50; ++k) {
    const Vec3 p{0, 0, 0}, q{1, 0.1 * k, -0.2}, np = Vec3{0.3, 0.1 * k - 2, 1}.normalized(),
                                                nq = Vec3{-0.5, 0.2, 1 + 0.1 * k}.normalized();
    const Cubic z = curve_by_normals(p, q, np, nq);
    EXPECT_NEAR(dot(z[1] - z[0], np), 0, 1e-14);
    EXPECT_NEAR(dot(z[3] - z[2], nq), 0, 1e-14);
  }
}

/// Largest difference of unit normals, and of points, over edges that are not sharp; of points over sharp edges.
std::array<double, 3> jumps(const DiscreteSurface& s) {
  std::array<double, 3> most{0, 0, 0};
  const Triangulation& m = s.mesh();
  const std::array<Vec2, 3> corner{Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}};
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(s.triangles()); ++t)
    for (int i = 0; i < 3; ++i) {
      const Side u = m.beyond(t, i);
      if (u.triangle < 0) continue;
      const bool sharp = s.lines().sharp[static_cast<std::size_t>(m.edge(t, i))] != 0;
      for (int k = 0; k <= 8; ++k) {
        const double w = k / 8.0;
        const Vec2 a = lerp(corner[static_cast<std::size_t>(i)], corner[static_cast<std::size_t>((i + 1) % 3)], w);
        const Vec2 b =
            lerp(corner[static_cast<std::size_t>((u.side + 1) % 3)], corner[static_cast<std::size_t>(u.side)], w);
        const SurfaceJet p = s.at(t, a, want_position | want_first),
                         q = s.at(u.triangle, b, want_position | want_first);
        most[sharp ? 2 : 1] = std::max(most[sharp ? 2 : 1], norm(p.s - q.s));
        if (sharp) continue;
        most[0] = std::max(most[0], norm(cross(p.su, p.sv).normalized() - cross(q.su, q.sv).normalized()));
      }
    }
  return most;
}

TEST(DiscreteSurface, IsSmoothOverRegularEdgesAndContinuousOverSharpOnes) {
  FlatMesh bumpy = torus(16, 10);
  for (std::size_t v = 0; v < bumpy.vertices.size(); ++v)
    bumpy.vertices[v] += 0.05 * Vec3{std::sin(7.0 * static_cast<double>(v)), std::cos(5.0 * static_cast<double>(v)),
                                     std::sin(3.0 * static_cast<double>(v))};
  for (const FlatMesh& mesh : {icosahedron(), sphere(3), torus(24, 12), bumpy, cube(2), cylinder(36)}) {
    const DiscreteSurface s = surface_of(mesh, {.sharp_angle = mesh.triangles.size() == 20 ? 80.0 : 60.0});
    EXPECT_EQ(s.folded(), 0);
    const auto [normals, points, sharp] = jumps(s);
    EXPECT_LT(normals, 1e-12);
    EXPECT_LT(points, 1e-14 * 10);
    EXPECT_LT(sharp, 1e-14 * 10);
  }
}

TEST(DiscreteSurface, PassesItsVertices) {
  const DiscreteSurface s = surface_of(torus(24, 12));
  const std::array<Vec2, 3> corner{Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}};
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(s.triangles()); ++t)
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(s.at(t, corner[static_cast<std::size_t>(k)], want_position).s, s.mesh().at(s.mesh().corner(t, k)));
}

TEST(GregoryTriangle, DerivativesMatchDifferences) {
  const DiscreteSurface s = surface_of(sphere(2));
  const double h = 1e-4;
  for (std::int32_t t = 0; t < 20; ++t)
    for (const Vec2& p : {Vec2{0.2, 0.3}, Vec2{0.05, 0.9}, Vec2{0.4, 0.01}, Vec2{0.6, 0.35}}) {
      const SurfaceJet jet = s.at(t, p, want_position | want_first | want_second);
      const auto at = [&](double u, double v) { return s.at(t, p + Vec2{u, v}, want_position).s; };
      EXPECT_LT(norm((at(h, 0) - at(-h, 0)) / (2 * h) - jet.su), 1e-6);
      EXPECT_LT(norm((at(0, h) - at(0, -h)) / (2 * h) - jet.sv), 1e-6);
      EXPECT_LT(norm((at(h, 0) - 2 * at(0, 0) + at(-h, 0)) / (h * h) - jet.suu), 1e-4);
      EXPECT_LT(norm((at(0, h) - 2 * at(0, 0) + at(0, -h)) / (h * h) - jet.svv), 1e-4);
      EXPECT_LT(norm((at(h, h) - at(-h, h) - at(h, -h) + at(-h, -h)) / (4 * h * h) - jet.suv), 1e-4);
    }
}

TEST(DiscreteSurface, DeviationBoundsTheDistanceToTheTriangles) {
  const DiscreteSurface s = surface_of(torus(12, 8));
  double most = 0;
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(s.triangles()); ++t)
    for (int i = 0; i <= 8; ++i)
      for (int j = 0; i + j <= 8; ++j) {
        const Vec2 p{i / 8.0, j / 8.0};
        const auto corner = [&](int k) { return s.mesh().at(s.mesh().corner(t, k)); };
        const Vec3 flat = (1 - p.x() - p.y()) * corner(0) + p.x() * corner(1) + p.y() * corner(2);
        most = std::max(most, norm(s.at(t, p, want_position).s - flat));
      }
  EXPECT_LE(most, s.deviation());
  EXPECT_GT(most, 0.3 * s.deviation());
}

TEST(DiscreteSurface, TorusConvergesWithTheThirdPower) {
  const auto distance = [](const Vec3& p) { return distance_to_torus(p); };
  const double coarse = largest(surface_of(torus(24, 12)), distance),
               fine = largest(surface_of(torus(48, 24)), distance),
               finest = largest(surface_of(torus(96, 48)), distance);
  EXPECT_LT(coarse, 1.6e-3);
  EXPECT_GT(coarse / fine, 8);
  EXPECT_GT(fine / finest, 8);
}

TEST(DiscreteSurface, SphereAndEllipsoidConverge) {
  const auto of_sphere = [](const Vec3& p) { return std::abs(norm(p) - 1); };
  EXPECT_LT(largest(surface_of(sphere(1), {.sharp_angle = 80}), of_sphere), 0.0107);
  EXPECT_GT(largest(surface_of(sphere(4)), of_sphere) / largest(surface_of(sphere(8)), of_sphere), 8);
  const auto ellipsoid = [](int n) {
    FlatMesh mesh = sphere(n);
    for (Vec3& p : mesh.vertices) p = {2 * p.x(), 1.3 * p.y(), p.z()};
    // To first order: |F| / |grad F|.
    return largest(surface_of(mesh, {.sharp_angle = 80}), [](const Vec3& p) {
      const Vec3 q{p.x() / 2, p.y() / 1.3, p.z()}, g{q.x() / 2, q.y() / 1.3, q.z()};
      return std::abs(dot(q, q) - 1) / (2 * norm(g));
    });
  };
  EXPECT_GT(ellipsoid(4) / ellipsoid(8), 8);
  EXPECT_GT(ellipsoid(2) / ellipsoid(8), 64);
}

TEST(DiscreteSurface, ACylinderHasRoundRims) {
  const DiscreteSurface s = surface_of(cylinder(36));
  EXPECT_LT(largest(s,
                    [](const Vec3& p) {
                      return p.z() > 1e-9 && p.z() < 2 - 1e-9 ? std::abs(std::hypot(p.x(), p.y()) - 1) : 0;
                    }),
            1e-5);  // the flat triangles are .0038 off
  // Tangent planes of each side are kept: the bottom stays plane.
  EXPECT_LT(
      largest(s, [](const Vec3& p) { return p.z() < 0.5 && std::hypot(p.x(), p.y()) < 0.9 ? std::abs(p.z()) : 0; }),
      1e-14);
}

// Sides of 2 x 2 between roundings of radius .01 in facets that lean by 30 degrees: normals lean by 15 degrees if
// facets weigh by their angles, and the sides bulge by .086.
TEST(DiscreteSurface, PlaneSidesBesideNarrowRoundingsStayPlane) {
  constexpr double radius = 0.01;
  FlatMesh prism;
  for (const double z : {0., 2.})
    for (int k = 0; k < 4; ++k)
      for (int j = 0; j < 4; ++j) {
        const double middle = (90 * k + 45) * degree, angle = (90 * k + 30 * j) * degree;
        prism.vertices.push_back({(1 - radius) * std::numbers::sqrt2 * std::cos(middle) + radius * std::cos(angle),
                                  (1 - radius) * std::numbers::sqrt2 * std::sin(middle) + radius * std::sin(angle), z});
      }
  prism.vertices.push_back({0, 0, 0}), prism.vertices.push_back({0, 0, 2});
  for (std::int32_t i = 0; i < 16; ++i) {
    const std::int32_t j = (i + 1) % 16;
    for (const auto& t : {std::array{i, j, 16 + j}, std::array{i, 16 + j, 16 + i}, std::array{j, i, 32},
                          std::array{16 + i, 16 + j, 33}})
      prism.triangles.push_back(t);
  }
  EXPECT_LT(surface_of(prism).deviation(), 3 * radius);
}

TEST(Unfolding, SharesTheAnglesOutUntilTangentsFollowEachOther) {
  // A plane hexagon; the tangent of the second spoke, at 60 degrees, is turned to 140 degrees, beyond the third one.
  FlatMesh mesh;
  mesh.vertices.emplace_back(0, 0, 0);
  for (int k = 0; k < 6; ++k) {
    mesh.vertices.emplace_back(std::cos(60 * k * degree), std::sin(60 * k * degree), 0);
    mesh.triangles.push_back({0, k + 1, (k + 1) % 6 + 1});
  }
  const Triangulation triangulation(mesh);
  const SharpLines lines = find_sharp_lines(triangulation);
  Frames frames = find_frames(triangulation, lines);
  std::vector<Cubic> curves = find_curves(triangulation, lines, frames);
  EXPECT_EQ(unfold(triangulation, lines, frames, curves).unfolded, 0);
  const auto control = [&](int spoke) -> Vec3& {
    return curves[static_cast<std::size_t>(triangulation.find_edge(0, spoke + 1))][1];
  };
  control(1) = Vec3{std::cos(140 * degree), std::sin(140 * degree), 0} / 3;
  const Unfolding done = unfold(triangulation, lines, frames, curves);
  EXPECT_EQ(done.unfolded, 1);
  EXPECT_EQ(done.folded, 0);
  // Angles from there on are -20 and 60 degrees: 40 in the ratio 20 to 60.
  for (const auto& [spoke, angle] : {std::pair{0, 0.0}, {1, 140.0}, {2, 150.0}, {3, 180.0}, {4, 240.0}, {5, 300.0}}) {
    EXPECT_NEAR(control(spoke).x(), std::cos(angle * degree) / 3, 1e-15) << spoke;
    EXPECT_NEAR(control(spoke).y(), std::sin(angle * degree) / 3, 1e-15) << spoke;
  }
}

std::int64_t euler(const RefinedMesh& mesh) {
  std::vector<Edge> edges;
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) edges.push_back(edge_of(t[i], t[(i + 1) % 3]));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return static_cast<std::int64_t>(mesh.vertices.size()) - static_cast<std::int64_t>(edges.size()) +
         static_cast<std::int64_t>(mesh.triangles.size());
}

double worst_shape(const std::vector<Vec3>& x, const std::vector<std::array<std::int32_t, 3>>& triangles) {
  double worst = 1;
  for (const auto& t : triangles)
    worst = std::min(worst, quality_q2(x[static_cast<std::size_t>(t[0])], x[static_cast<std::size_t>(t[1])],
                                       x[static_cast<std::size_t>(t[2])]));
  return worst;
}

TEST(Refinement, AllTrianglesAreWithinTheAngle) {
  Monitor monitor;
  for (const FlatMesh& mesh : {icosahedron(), torus(24, 12)}) {
    const DiscreteSurface s = surface_of(mesh, {.sharp_angle = 80});
    const RefinedMesh fine = refine(s, wish_of_angle(s, 8), {}, monitor);
    EXPECT_TRUE(fine.complete);
    EXPECT_GT(fine.triangles.size(), mesh.triangles.size());
    for (std::size_t t = 0; t < fine.triangles.size(); ++t) {
      const auto& [a, b, c] = fine.triangles[t];
      const auto at = [&](std::int32_t v) { return fine.vertices[static_cast<std::size_t>(v)]; };
      const Vec3 n = cross(at(b) - at(a), at(c) - at(a)).normalized();
      for (const Vec2& uv : fine.uv[t]) {
        const SurfaceJet jet = s.at(fine.parent[t], uv, want_first);
        EXPECT_GE(dot(n, cross(jet.su, jet.sv).normalized()), std::cos(8 * degree));
      }
    }
    EXPECT_EQ(euler(fine), s.mesh().findings.euler_number);
    EXPECT_GE(worst_shape(fine.vertices, fine.triangles), 0.5 * worst_shape(mesh.vertices, mesh.triangles));
  }
}

TEST(Refinement, KeepsLinesAndEulerNumbersOfOpenSurfaces) {
  Monitor monitor;
  FlatMesh open = cylinder(36);
  std::erase_if(open.triangles,
                [&](const auto& t) { return std::find(t.begin(), t.end(), 72) != t.end(); });  // no bottom
  const DiscreteSurface s = surface_of(open);
  EXPECT_EQ(s.mesh().findings.border_edges, 36);
  const RefinedMesh fine = refine(s, wish_of_angle(s, 2), {}, monitor);
  EXPECT_EQ(euler(fine), 1);
  const FlatMesh flat = flat_mesh(s, fine);
  ASSERT_EQ(fine.lines.size(), 2u);
  EXPECT_EQ(flat.edges.size(), fine.lines[0].size() + fine.lines[1].size() - 2);
  EXPECT_GT(flat.edges.size(), 72u);
  const FlatMesh same = flat_mesh(s, unrefined(s));
  EXPECT_EQ(same.vertices, s.mesh().vertices);
  EXPECT_EQ(same.edges.size(), 72u);
}

TEST(DiscreteCad, TilesOfThePlaneAreThePatches) {
  const auto s = std::make_shared<const DiscreteSurface>(surface_of(torus(24, 12)));
  const DiscreteCad cad(s);
  BuiltGeometry built = discrete_geometry(s);
  for (const std::int32_t t : {0, 1, 23, 24, 25, 300, 575})
    for (const Vec2& p : {Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}, Vec2{0.25, 0.5}}) {
      const SurfaceJet jet = surface_at(*built.cad, 1, want_position | want_first, cad.corner_of_tile(t) + p);
      EXPECT_EQ(jet.s, s->at(t, p, want_position).s);
      EXPECT_EQ(cad.patch_of(cad.corner_of_tile(t) + p), t);
    }
  EXPECT_THROW(surface_at(*built.cad, 1, want_position, {-3, 0}), InvalidArgument);
  EXPECT_THROW(surface_at(*built.cad, 1, want_position, {0, 1e9}), InvalidArgument);
  EXPECT_TRUE(list_model_defects(built.model).empty());
}

}  // namespace
}  // namespace carreau::discrete
