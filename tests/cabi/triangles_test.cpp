// SPDX-License-Identifier: BSD-3-Clause
// Surfaces given as triangles through the interface: arrays, files, mistakes.
#include <carreau_geometry.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "abi_fixture.h"

namespace abi_tests {
namespace {

/// The octahedron, whose edges bend by 70.5 degrees.
struct Octahedron {
  std::vector<double> vertices{1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
  std::vector<std::int32_t> triangles{0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  carreau_triangles given = sized<carreau_triangles>();
  Octahedron() {
    given.vertex_count = 6, given.triangle_count = 8;
    given.vertices = vertices.data(), given.triangles = triangles.data();
  }
};

class Triangles : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(carreau_session_create(&session), CARREAU_OK); }
  void TearDown() override { carreau_session_free(session); }

  carreau_triangles_report report() {
    auto found = sized<carreau_triangles_report>();
    EXPECT_EQ(carreau_triangles_measure(session, &found), CARREAU_OK) << carreau_last_error(session);
    return found;
  }

  carreau_session* session = nullptr;
};

TEST_F(Triangles, AnglesSayWhatIsALine) {
  const Octahedron octahedron;
  ASSERT_EQ(carreau_add_triangles(session, nullptr, &octahedron.given), CARREAU_OK) << carreau_last_error(session);
  EXPECT_EQ(report().lines, 12);
  EXPECT_EQ(report().regions, 8);
  ASSERT_EQ(carreau_model_clear(session), CARREAU_OK);
  auto options = sized<carreau_triangles_options>();
  options.sharp_angle = 80;
  ASSERT_EQ(carreau_add_triangles(session, &options, &octahedron.given), CARREAU_OK) << carreau_last_error(session);
  EXPECT_EQ(report().lines, 0);
  EXPECT_EQ(report().regions, 1);
  ASSERT_EQ(carreau_set_real(session, "hphydef", 0.2), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << carreau_last_error(session);
  carreau_mesh* mesh = nullptr;
  ASSERT_EQ(carreau_session_mesh(session, &mesh), CARREAU_OK);
  EXPECT_EQ(defects_of(mesh), "");
  // Edges of 90 degrees: radius .972272 in their middles; nothing is nearer to the centre than the triangles are.
  const MeshData data = data_of(mesh);
  for (std::size_t v = 0; v < data.vertex_count(); ++v) {
    const double r = std::hypot(data.xyz[3 * v], data.xyz[3 * v + 1], data.xyz[3 * v + 2]);
    EXPECT_GT(r, 0.9);
    EXPECT_LT(r, 1.01);
  }
  double distances[2] = {};
  ASSERT_EQ(carreau_triangles_distances(session, distances), CARREAU_OK);
  for (const double d : distances) {
    EXPECT_GT(d, 0.2);
    EXPECT_LE(d, report().deviation);
  }
}

TEST_F(Triangles, RefinementGivesLinesAndTriangles) {
  const Octahedron octahedron;
  ASSERT_EQ(carreau_add_triangles(session, nullptr, &octahedron.given), CARREAU_OK);
  carreau_mesh* mesh = nullptr;
  ASSERT_EQ(carreau_mesh_create(&mesh), CARREAU_OK);
  ASSERT_EQ(carreau_triangles_refine(session, 8, 0, mesh), CARREAU_OK) << carreau_last_error(session);
  std::int64_t n = 0, m = 0, k = 0;
  ASSERT_EQ(carreau_mesh_count(mesh, &n, &m, &k, nullptr), CARREAU_OK);
  EXPECT_EQ((std::array{n, m, k}), (std::array<std::int64_t, 3>{6, 8, 12}));
  EXPECT_EQ(carreau_triangles_refine(session, 8, -1, mesh), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_triangles_refine(session, 0, 3, mesh), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_triangles_refine(session, 8, 3, nullptr), CARREAU_ERR_ARGUMENT);
  carreau_mesh_free(mesh);
}

TEST_F(Triangles, MistakesAreTold) {
  auto unknown = sized<carreau_triangles_report>();
  EXPECT_EQ(carreau_triangles_measure(session, &unknown), CARREAU_ERR_SEQUENCE);
  Octahedron octahedron;
  octahedron.triangles[4] = 6;
  EXPECT_EQ(carreau_add_triangles(session, nullptr, &octahedron.given), CARREAU_ERR_ARGUMENT);
  EXPECT_STREQ(carreau_last_error(session), "triangle 1 (from 0) names vertex 6 of 6");
  octahedron.triangles[4] = 1;
  const std::int32_t edges[] = {0, 9};
  octahedron.given.edge_count = 1, octahedron.given.edges = edges;
  EXPECT_EQ(carreau_add_triangles(session, nullptr, &octahedron.given), CARREAU_ERR_ARGUMENT);
  EXPECT_STREQ(carreau_last_error(session), "edge 0 (from 0) names vertex 9 of 6");
  octahedron.given.edge_count = 0;
  auto options = sized<carreau_triangles_options>();
  options.sharp_angle = 300;
  EXPECT_EQ(carreau_add_triangles(session, &options, &octahedron.given), CARREAU_ERR_ARGUMENT);
  EXPECT_STREQ(carreau_last_error(session), "the sharp angle is 300 degrees; it must lie above 0 and not above 180");
  EXPECT_EQ(carreau_load_triangles(session, nullptr, "/nowhere/x.stl"), CARREAU_ERR_FILE);
  EXPECT_EQ(carreau_load_triangles(session, nullptr, nullptr), CARREAU_ERR_ARGUMENT);
  ASSERT_EQ(carreau_add_triangles(session, nullptr, &octahedron.given), CARREAU_OK);
  EXPECT_EQ(carreau_add_triangles(session, nullptr, &octahedron.given), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_add_grid(session, nullptr, 1, edges, octahedron.vertices.data()), CARREAU_ERR_ARGUMENT);
  double distances[2] = {};
  EXPECT_NE(carreau_triangles_distances(session, distances), CARREAU_OK);
}

}  // namespace
}  // namespace abi_tests
