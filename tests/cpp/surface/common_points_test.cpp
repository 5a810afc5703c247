// SPDX-License-Identifier: BSD-3-Clause
// Where surfaces cross in the geometry itself: what Newton's method finds over triangles that cross.
#include "surface/crossings/common_points.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/analytic_cad.h"

namespace carreau {
namespace {

/// A paraboloid z = x^2 + y^2 over its own (x, y), and a plane x = at over (y, z).
testing::AnalyticCad paraboloid_and_plane(double at) {
  testing::AnalyticCad cad;
  cad.faces[1].at = [](Vec2 p) {
    SurfaceJet jet;
    jet.s = {p.x(), p.y(), p.x() * p.x() + p.y() * p.y()};
    jet.su = {1, 0, 2 * p.x()}, jet.sv = {0, 1, 2 * p.y()};
    return jet;
  };
  cad.faces[2].at = [at](Vec2 p) {
    SurfaceJet jet;
    jet.s = {at, p.x(), p.y()}, jet.su = {0, 1, 0}, jet.sv = {0, 0, 1};
    return jet;
  };
  return cad;
}

/// One triangle on each, whose faces have no vertex in common but for the first `shared` ones.
SurfaceMesh two_triangles(Cad& cad, int shared) {
  SurfaceMesh mesh;
  const auto add = [&](int ref, const std::array<Vec2, 3>& uv) {
    FaceMesh face;
    face.ref = ref;
    for (const Vec2& p : uv) {
      face.uv.push_back(p);
      face.vertex.push_back(static_cast<std::int32_t>(mesh.vertices.size()));
      mesh.vertices.push_back(surface_at(cad, ref, want_position, p).s);
    }
    face.triangles = {{0, 1, 2}};
    mesh.faces.push_back(face);
  };
  add(1, {Vec2{0.3, -0.3}, Vec2{0.9, -0.1}, Vec2{0.3, 0.5}});
  add(2, {Vec2{-0.4, -0.1}, Vec2{0.6, 0.1}, Vec2{0, 0.9}});
  for (std::size_t k = 0; k < static_cast<std::size_t>(shared); ++k) mesh.faces[1].vertex[k] = mesh.faces[0].vertex[k];
  return mesh;
}

TEST(CommonPoints, LieOnBothSurfaces) {
  testing::AnalyticCad cad = paraboloid_and_plane(0.5);
  const SurfaceMesh mesh = two_triangles(cad, 0);
  CommonPoints common(mesh, 0, 1);
  EXPECT_FALSE(common.any_near({0.5, 0, 0.25}, 10));
  const PatchTriangle s(mesh, 0, 0), t(mesh, 1, 0);
  common.look(cad, s, t, {0.5, 0, 0.4});
  // The curve x = 1/2, z = 1/4 + y^2 has a point within the triangle's edge of where they cross; none is a unit away.
  EXPECT_TRUE(common.any_near({0.5, 0, 0.25}, 0.2));
  EXPECT_FALSE(common.any_near({1.5, 0, 0.25}, 0.9));
}

TEST(CommonPoints, AreNotThereWhereSurfacesAreApartOrMeetAtTheirVertices) {
  testing::AnalyticCad apart = paraboloid_and_plane(1.5), cad = paraboloid_and_plane(0.5);
  const SurfaceMesh away = two_triangles(apart, 0), sharing = two_triangles(cad, 1);
  CommonPoints none(away, 0, 1), at_vertex(sharing, 0, 1);
  none.look(apart, {away, 0, 0}, {away, 1, 0}, {0.6, 0, 0.4});
  EXPECT_FALSE(none.any_near({0.5, 0, 0.25}, 100));
  at_vertex.look(cad, {sharing, 0, 0}, {sharing, 1, 0}, {0.5, 0, 0.4});
  EXPECT_FALSE(at_vertex.any_near({0.5, 0, 0.25}, 100));
}

}  // namespace
}  // namespace carreau
