// SPDX-License-Identifier: BSD-3-Clause
// Cross-patch meshes (HDR sec. 4.5.5): like meshes of the same surface in one piece, never worse.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "euler_number.h"
#include "independent/patchworks.h"
#include "mesh/triangle_search.h"
#include "session_of_size.h"

namespace carreau {
namespace {

using namespace testing;

std::unique_ptr<Session> meshed(const AnalyticCad& cad, double size, const char* patches, Monitor& monitor,
                                double sharp_angle = 1, int threads = 1) {
  auto session = session_of_size(cad, size, monitor);
  session->parameters().set("patches", patches);
  session->parameters().set("sharp_angle", sharp_angle);
  session->parameters().set("threads", threads);
  session->make_mesh();
  return session;
}

void expect_sound(const Session& session, bool closed) {
  const std::vector<std::string> defects = find_defects(session.mesh(), {.closed = closed});
  EXPECT_TRUE(defects.empty()) << defects.front();
}

double mean_q2(const FlatMesh& mesh) { return summarise_quality(mesh).q2.mean; }

double area_of(const FlatMesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    area += norm(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a])) / 2;
  return area;
}

// Expects as many triangles as one patch has, or as equilateral triangles of that size, whichever is more. If one patch
// has few triangles, its corners determine their number.
void expect_as_many(const FlatMesh& mesh, const FlatMesh& whole, double size, double area) {
  const double ideal = area / (std::numbers::sqrt3 / 4 * size * size);
  const double of_one = static_cast<double>(whole.triangles.size());
  EXPECT_GE(static_cast<double>(mesh.triangles.size()), 0.95 * std::min(of_one, ideal));
  EXPECT_LE(static_cast<double>(mesh.triangles.size()), 1.1 * std::max(of_one, ideal));
}

TEST(Independent, SquaresOfACubeMeanNothing) {
  Monitor quiet;
  for (const int n : {4, 12}) {
    const double size = 3.0 / n;
    const auto one = meshed(cube_of_squares(1), size, "dependent", quiet),
               freed = meshed(cube_of_squares(n), size, "independent", quiet);
    expect_sound(*freed, true);
    const FlatMesh whole = one->exported(), mesh = freed->exported();
    expect_as_many(mesh, whole, size, 6);
    EXPECT_EQ(euler_number(freed->mesh()), 2);
    EXPECT_NEAR(area_of(mesh), 6, 1e-12);  // all twelve edges are exact
    for (const Vec3& p : mesh.vertices) {
      double off = 1;
      for (int k = 0; k < 3; ++k) off = std::min({off, std::abs(p[k]), std::abs(p[k] - 1)});
      EXPECT_LE(off, 1e-15);
    }
  }
}

// Four by four squares above and below, four rectangles a side between sharp lines that are much nearer than the size.
AnalyticCad plate_of_squares(double thickness) {
  AnalyticCad cad;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      const auto plane = [axis, side, thickness](Vec2 p) {
        SurfaceJet jet{};
        jet.s[axis] = side, jet.s[(axis + 1) % 3] = p.x(), jet.s[(axis + 2) % 3] = p.y();
        jet.su[(axis + 1) % 3] = jet.sv[(axis + 2) % 3] = 1;
        for (Vec3* v : {&jet.s, &jet.su, &jet.sv}) (*v)[2] *= thickness;
        return jet;
      };
      add_grid(cad, 1 + (2 * axis + side) * 16, plane, {0, 0}, {1, 1}, axis == 1 ? 1 : 4, axis == 0 ? 1 : 4);
    }
  return cad;
}

TEST(Independent, ShapesBetweenSharpLinesAreNoWorse) {
  Monitor quiet;
  for (const double thickness : {0.02, 0.05, 0.1, 0.2})
    for (const double size : {0.15, 0.3}) {
      const AnalyticCad plate = plate_of_squares(thickness);
      const auto patches = meshed(plate, size, "dependent", quiet), freed = meshed(plate, size, "independent", quiet);
      expect_sound(*freed, true);
      const FlatMesh before = patches->exported(), mesh = freed->exported();
      EXPECT_GE(mean_q2(mesh), mean_q2(before) - 1e-12) << thickness << ' ' << size;
      EXPECT_GE(worst_q2(mesh), worst_q2(before) - 1e-12) << thickness << ' ' << size;
      EXPECT_EQ(euler_number(freed->mesh()), 2);
      EXPECT_NEAR(area_of(mesh), 2 + 4 * thickness, 1e-12);
    }
}

struct Patchwork {
  AnalyticCad cut, whole;
  double size, area;
  bool closed;
  double before;  // Q2 of the worst triangle with its patches, at most
};

void expect_as_one_patch(const Patchwork& p) {
  Monitor quiet;
  const auto one = meshed(p.whole, p.size, "dependent", quiet), patches = meshed(p.cut, p.size, "dependent", quiet),
             freed = meshed(p.cut, p.size, "independent", quiet);
  expect_sound(*freed, p.closed);
  const FlatMesh whole = one->exported(), before = patches->exported(), mesh = freed->exported();
  expect_as_many(mesh, whole, p.size, p.area);
  EXPECT_GE(mean_q2(mesh), 0.95);
  EXPECT_GE(worst_q2(mesh), 0.5);
  EXPECT_LT(worst_q2(before), p.before);
  EXPECT_GT(before.triangles.size(), 2 * whole.triangles.size());
  EXPECT_EQ(euler_number(freed->mesh()), euler_number(one->mesh()));
}

TEST(Independent, CylinderOf24StripsIsAsOne) {
  // Five strips wide.
  expect_as_one_patch({cylinder_of_strips(24), cylinder_of_strips(1), 5 * 2 * std::numbers::pi / 24, 20 * std::numbers::pi, false, 0.6});
}

TEST(Independent, SphereOf320PatchesIsAsOne) {
  // A patch is about .2 wide.
  expect_as_one_patch({sphere_of_triangles(2), sphere_of_triangles(0), 1.0, 4 * std::numbers::pi, true, 0.99});
}

TEST(Independent, CornersKnowTheirPlacesOnTheSurface) {
  Monitor quiet;
  AnalyticCad cad = sphere_of_triangles(1);
  const auto session = meshed(cad, 0.15, "independent", quiet);
  const SurfaceMesh& mesh = session->mesh();
  bool several = false;
  for (const FaceMesh& face : mesh.faces)
    for (std::size_t k = 0; k < face.vertex.size(); ++k) {
      const int ref = mesh.faces[face.uv_face[k]].ref;
      several = several || ref != face.ref;
      const Vec3 s = surface_at(cad, ref, want_position, face.uv[k]).s;
      EXPECT_LE(norm(s - mesh.vertices[face.vertex[k]]), 1e-12);
    }
  EXPECT_TRUE(several);
}

// On the unit sphere the surface is farthest from a triangle over its circumcentre, and the angle at its corners is the
// largest: both in closed form.
TEST(Independent, MeasuresGoAcrossBorders) {
  Monitor quiet;
  const auto session = meshed(sphere_of_triangles(1), 0.3, "independent", quiet);
  const FlatMesh mesh = session->exported();
  const MeshEvaluation& d = session->delivered();
  ASSERT_EQ(d[EvaluationKind::deviation].values.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [i, j, k] = mesh.triangles[t];
    const Vec3 a = mesh.vertices[i], b = mesh.vertices[j], c = mesh.vertices[k], n = cross(b - a, c - a);
    const double height = std::abs(dot(a, n)) / norm(n);  // of its plane over the centre
    EXPECT_NEAR(d[EvaluationKind::angle].values[t], std::acos(height) * 180 / std::numbers::pi, 1e-6);
    EXPECT_LE(d[EvaluationKind::deviation].values[t], 1 - height + 1e-12);
    EXPECT_GE(d[EvaluationKind::deviation].values[t], 0.8 * (1 - height));
  }
  for (std::size_t e = 0; e < d.edges.vertices.size(); ++e) {
    const auto& [i, j] = d.edges.vertices[e];
    const double chord = norm(mesh.vertices[j] - mesh.vertices[i]), arc = 2 * std::asin(chord / 2);
    EXPECT_GE(d[EvaluationKind::length].values[e], chord / 0.3 * (1 - 1e-9));
    EXPECT_LE(d[EvaluationKind::length].values[e], arc / 0.3 * (1 + 1e-2));
  }
}

// The surface is as far from a triangle as its plane is from the centre, where that is over it; normals differ most at the corners.
TEST(Independent, BoundsHoldAcrossBorders) {
  Monitor quiet;
  const auto session = meshed(sphere_of_triangles(1), 0.3, "independent", quiet);
  const FlatMesh mesh = session->exported();
  const MeshEvaluation& d = session->delivered();
  std::size_t spread = 0;
  for (const FaceMesh& face : session->mesh().faces) spread += static_cast<std::size_t>(std::ranges::count(face.spread, 1));
  ASSERT_GT(spread, mesh.triangles.size() / 4);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [i, j, k] = mesh.triangles[t];
    const Vec3 a = mesh.vertices[i], b = mesh.vertices[j], c = mesh.vertices[k], n = cross(b - a, c - a);
    const double height = std::abs(dot(a, n)) / norm(n), angle = std::acos(height) * 180 / std::numbers::pi;
    const double deviation = 1 - nearest_on_triangle({0, 0, 0}, {a, b, c}).distance;
    EXPECT_GE(d[EvaluationKind::deviation_bound].values[t], deviation * (1 - 1e-6));
    EXPECT_LE(d[EvaluationKind::deviation_bound].values[t], 1.3 * deviation);
    EXPECT_GE(d[EvaluationKind::angle_bound].values[t], angle * (1 - 1e-6));
    EXPECT_LE(d[EvaluationKind::angle_bound].values[t], 1.3 * angle + 0.52);
    EXPECT_NEAR(d[EvaluationKind::bound_share].values[t],
                std::max(d[EvaluationKind::deviation_bound].values[t] / (0.3 * 0.3), d[EvaluationKind::angle_bound].values[t] / 52), 1e-9);
  }
  EXPECT_EQ(d[EvaluationKind::bound_share].limit, 1);
  EXPECT_EQ(d[EvaluationKind::bound_share].beyond, 0);
}

TEST(Independent, MeshDoesNotDependOnThreads) {
  Monitor quiet;
  const AnalyticCad cad = sphere_of_triangles(1);
  const FlatMesh one = meshed(cad, 0.2, "independent", quiet)->exported();
  for (const int threads : {2, 8}) {
    const FlatMesh other = meshed(cad, 0.2, "independent", quiet, 1, threads)->exported();
    EXPECT_EQ(one.triangles, other.triangles);
    EXPECT_EQ(one.triangle_refs, other.triangle_refs);
    EXPECT_TRUE(one.vertices == other.vertices);
  }
}

}  // namespace
}  // namespace carreau
