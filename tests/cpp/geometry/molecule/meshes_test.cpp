// Molecular surfaces through the ordinary pipeline.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include "balls_from_files.h"
#include "geometry/molecule/molecule.h"
#include "mesh/quality.h"
#include "session/session.h"

namespace carreau::molecule {
namespace {

constexpr double pi = std::numbers::pi;

double area_of(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const FaceMesh& face : mesh.faces)
    for (const auto& t : face.triangles) {
      const Vec3& p = mesh.vertices[face.vertex[t[0]]];
      sum += norm(cross(mesh.vertices[face.vertex[t[1]]] - p, mesh.vertices[face.vertex[t[2]]] - p)) / 2;
    }
  return sum;
}

/// Of a closed mesh.
int euler_number_of(const SurfaceMesh& mesh) {
  return static_cast<int>(mesh.vertices.size()) - static_cast<int>(mesh.triangle_count() / 2);
}

/// Meshes with edges of one length; every face has a mesh without defects, closed.
SurfaceMesh mesh_of(const BuiltGeometry& built, double size) {
  Monitor silent;
  Session session(silent);
  session.set_cad(built.cad);
  session.set_model(built.model);
  session.parameters().set("hphy_flag", 1);
  session.parameters().set("hphydef", size);
  session.make_mesh();
  const SurfaceMesh mesh = session.mesh();
  EXPECT_EQ(find_defects(mesh, {.closed = true}), std::vector<std::string>{});
  return mesh;
}

BuiltGeometry built(const std::vector<Ball>& balls, SurfaceKind kind) {
  Monitor silent;
  return build_surface({balls}, {.kind = kind}, silent);
}

TEST(MolecularSurfaces, TwoBallsConvergeToTheirAreaAtSecondOrder) {
  const std::vector<Ball> balls{{{0, 0, 0}, 1.7}, {{1.5, 0, 0}, 1.7}};
  for (const auto& [kind, exact] : {std::pair{SurfaceKind::vws, 52.338933}, {SurfaceKind::sas, 149.979556}}) {
    double error[2];
    for (const int fine : {0, 1}) {
      const SurfaceMesh mesh = mesh_of(built(balls, kind), fine == 0 ? 0.3 : 0.15);
      EXPECT_EQ(euler_number_of(mesh), 2);
      error[fine] = exact - area_of(mesh);
    }
    EXPECT_GT(error[1], 0);
    EXPECT_NEAR(error[0] / error[1], 4, 0.6);
  }
}

TEST(MolecularSurfaces, ALoneBallIsTwoCharts) {
  const SurfaceMesh mesh = mesh_of(built({{{1, 2, 3}, 2}}, SurfaceKind::vws), 0.2);
  EXPECT_EQ(euler_number_of(mesh), 2);
  ASSERT_EQ(mesh.faces.size(), 2U);
  EXPECT_EQ(mesh.faces[1].shown_ref(), 1);
  for (const Vec3& p : mesh.vertices) EXPECT_NEAR(norm(p - Vec3{1, 2, 3}), 2, 1e-12);
  EXPECT_NEAR(area_of(mesh), 16 * pi, 0.2);
}

/// Vertices of each face at the radius of its atom, and in no other ball by more than a chord allows.
void check_distances(const SurfaceMesh& mesh, const std::vector<Ball>& balls, double size) {
  for (const FaceMesh& face : mesh.faces) {
    const Ball& ball = balls[face.shown_ref() - 1];
    for (const std::int32_t v : face.vertex) EXPECT_NEAR(norm(mesh.vertices[v] - ball.centre), ball.radius, 1e-12);
  }
  for (const Vec3& p : mesh.vertices)
    for (const Ball& ball : balls) EXPECT_GT(norm(p - ball.centre), ball.radius - size * size / (8 * ball.radius));
}

TEST(MolecularSurfaces, CaffeineIsClosedAndOnItsSpheres) {
  for (const auto& [kind, probe] : {std::pair{SurfaceKind::vws, 0.0}, {SurfaceKind::sas, 1.4}}) {
    const std::vector<Ball> balls = read_balls("caffeine.xyzr");
    Monitor silent;
    const SurfaceOptions options{.kind = kind};
    const Arrangement a = arrange(Molecule{balls}, options, silent);
    const SurfaceMesh mesh = mesh_of(build_surface({balls}, options, silent), 0.3);
    EXPECT_EQ(euler_number_of(mesh), a.euler_number());
    check_distances(mesh, a.balls, 0.3);
    EXPECT_NEAR(area_of(mesh), measure(a).area, 0.01 * measure(a).area);
  }
}

}  // namespace
}  // namespace carreau::molecule
