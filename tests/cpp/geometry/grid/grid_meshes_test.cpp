// SPDX-License-Identifier: BSD-3-Clause
// Grids through the ordinary pipeline.
#include <gtest/gtest.h>

#include <limits>

#include "grid_test_support.h"
#include "mesh/quality.h"
#include "session/session.h"

namespace carreau::grid {
namespace {

constexpr double pi = std::numbers::pi;

SurfaceMesh mesh_of(const BuiltGeometry& built, double size, bool closed, int threads = 1) {
  Monitor silent;
  Session session(silent);
  session.set_cad(built.cad);
  session.set_model(built.model);
  session.parameters().set("threads", threads);
  session.parameters().set("hphy_flag", 1);
  session.parameters().set("hphydef", size);
  session.make_mesh();
  SurfaceMesh mesh = session.mesh();
  EXPECT_EQ(find_defects(mesh, {.closed = closed}), std::vector<std::string>{});
  return mesh;
}

int euler_number_of(const SurfaceMesh& mesh) {
  return static_cast<int>(mesh.vertices.size()) - static_cast<int>(mesh.triangle_count() / 2);
}

TEST(GridMeshes, ASphereIsClosedAndItsVerticesLieOnIt) {
  const SurfaceMesh mesh = mesh_of(build({sphere(48, 24)}).built, 0.2, true);
  EXPECT_EQ(euler_number_of(mesh), 2);
  for (const Vec3& p : mesh.vertices) EXPECT_NEAR(norm(p), 1, 2e-4);
}

TEST(GridMeshes, ATorusIsClosedAndTheSameForAnyNumberOfThreads) {
  const GridGeometry made = build({block_of(41, 21, [](int i, int j) -> Vec3 {
    const double a = 2 * pi * (i % 40) / 40, b = 2 * pi * (j % 20) / 20;
    return {(3 + std::cos(b)) * std::cos(a), (3 + std::cos(b)) * std::sin(a), std::sin(b)};
  })});
  const SurfaceMesh one = mesh_of(made.built, 0.5, true, 1), four = mesh_of(made.built, 0.5, true, 4);
  EXPECT_EQ(euler_number_of(one), 0);
  EXPECT_EQ(one.vertices, four.vertices);
}

TEST(GridMeshes, HolesAreKeptAndPartsAreTheBlocks) {
  Block block = block_of(30, 20, [](int i, int j) -> Vec3 { return {i * 1.0, j * 1.0, std::sin(0.3 * i) + std::cos(0.3 * j)}; });
  for (int j = 0; j < 20; ++j) block.nodes[block.index(14, j)].z() = std::numeric_limits<double>::quiet_NaN();
  block.nodes[block.index(7, 7)].z() = std::numeric_limits<double>::quiet_NaN();
  const SurfaceMesh mesh = mesh_of(build({block}).built, 1, false);
  int seen = 0;
  for (const FaceMesh& face : mesh.faces) seen += face.triangles.empty() ? 0 : 1;
  EXPECT_EQ(seen, 2);
}

/// Worst Q2 of the mesh of a grid with steps of 1 and 20.
double worst_of_abrupt_grid(bool lengths) {
  const Block block = block_of(9, 9, [](int i, int j) -> Vec3 {
    const auto x = [](int k) { return k <= 4 ? k * 1.0 : 4 + 20.0 * (k - 4); };
    return {x(i), x(j), 4 * std::sin(x(i) / 25) * std::cos(x(j) / 25)};
  });
  const SurfaceMesh mesh = mesh_of(build({block}, {.lengths = lengths}).built, 2, false);
  double worst = 1;
  for (const FaceMesh& face : mesh.faces)
    for (const auto& t : face.triangles)
      worst = std::min(worst, quality_q2(mesh.vertices[face.vertex[t[0]]], mesh.vertices[face.vertex[t[1]]],
                                               mesh.vertices[face.vertex[t[2]]]));
  return worst;
}

TEST(GridMeshes, LengthsAsParametersMendAbruptSteps) {
  EXPECT_GE(worst_of_abrupt_grid(true), 0.3);
  EXPECT_LT(worst_of_abrupt_grid(false), worst_of_abrupt_grid(true));
}

}  // namespace
}  // namespace carreau::grid
