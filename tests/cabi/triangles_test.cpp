// SPDX-License-Identifier: BSD-3-Clause
// Surfaces given as triangles through the interface: arrays, files, mistakes.
#include <carreau_geometry.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

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

TEST_F(Triangles, AnglesDefineLines) {
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

// A cube, opposite sides with different diagonals: three pairs of faces, twelve edges in three classes, eight corners in one.
TEST_F(Triangles, OppositeSidesMayBePeriodic) {
  const std::vector<double> vertices{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
  const std::vector<std::int32_t> triangles{0, 2, 1, 0, 3, 2, 4, 5, 7, 5, 6, 7, 0, 1, 5, 0, 5, 4, 3, 7, 2, 7, 6, 2, 0, 4, 3, 4, 7, 3, 1, 2, 6, 1, 6, 5};
  auto given = sized<carreau_triangles>();
  given.vertex_count = 8, given.triangle_count = 12;
  given.vertices = vertices.data(), given.triangles = triangles.data();
  ASSERT_EQ(carreau_add_triangles(session, nullptr, &given), CARREAU_OK) << carreau_last_error(session);
  for (const std::array<double, 3>& along : {std::array<double, 3>{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
    ASSERT_EQ(carreau_model_add_period(session, along.data()), CARREAU_OK);
  ASSERT_EQ(carreau_set_real(session, "hphydef", 0.15), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << carreau_last_error(session);
  carreau_mesh* mesh = nullptr;
  ASSERT_EQ(carreau_session_mesh(session, &mesh), CARREAU_OK);
  EXPECT_EQ(defects_of(mesh), "");
  std::int64_t pairs = 0, nodes = 0;
  ASSERT_EQ(carreau_mesh_periodic_count(mesh, &pairs, &nodes), CARREAU_OK);
  std::vector<std::int32_t> dimension(pairs), refs(2 * pairs), node(2 * nodes);
  std::vector<double> map(12 * pairs);
  std::vector<std::int64_t> count(pairs);
  ASSERT_EQ(carreau_mesh_periodic(mesh, pairs, nodes, dimension.data(), refs.data(), map.data(), count.data(), node.data()), CARREAU_OK);
  EXPECT_EQ(std::count(dimension.begin(), dimension.end(), 2), 3);
  EXPECT_EQ(std::count(dimension.begin(), dimension.end(), 1), 9);
  EXPECT_EQ(std::count(dimension.begin(), dimension.end(), 0), 7);
  const MeshData data = data_of(mesh);
  const std::int32_t* next = node.data();
  for (std::int64_t i = 0; i < pairs; ++i)
    for (std::int64_t k = 0; k < count[i]; ++k, next += 2)
      for (std::size_t r = 0; r < 3; ++r)
        EXPECT_NEAR(data.xyz[3 * std::size_t(next[0]) + r], data.xyz[3 * std::size_t(next[1]) + r] + map[std::size_t(12 * i) + 4 * r + 3], 1e-15);
}

// Without a partner: the distance, and the place.
TEST_F(Triangles, SidesThatDoNotMatchAreReported) {
  const std::vector<double> vertices{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const std::vector<std::int32_t> triangles{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  auto given = sized<carreau_triangles>();
  given.vertex_count = 4, given.triangle_count = 4;
  given.vertices = vertices.data(), given.triangles = triangles.data();
  ASSERT_EQ(carreau_add_triangles(session, nullptr, &given), CARREAU_OK) << carreau_last_error(session);
  const double along[3] = {1, 0, 0};
  ASSERT_EQ(carreau_model_add_period(session, along), CARREAU_OK);
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_MODEL);
  EXPECT_NE(std::string(carreau_last_error(session)).find("do not match: their boundaries are"), std::string::npos) << carreau_last_error(session);
  EXPECT_NE(std::string(carreau_last_error(session)).find("apart at ("), std::string::npos);
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

TEST_F(Triangles, MistakesAreReported) {
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

TEST_F(Triangles, DistancesAreBounded) {
  const Octahedron octahedron;
  auto options = sized<carreau_triangles_options>();
  options.sharp_angle = 80;
  ASSERT_EQ(carreau_add_triangles(session, &options, &octahedron.given), CARREAU_OK);
  double bounds[4] = {}, distances[2] = {};
  EXPECT_EQ(carreau_triangles_bounds(session, 0, bounds), CARREAU_ERR_SEQUENCE);
  ASSERT_EQ(carreau_set_real(session, "hphydef", 0.2), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << carreau_last_error(session);
  ASSERT_EQ(carreau_triangles_distances(session, distances), CARREAU_OK);
  for (const double share : {0.0, 1e-3}) {
    ASSERT_EQ(carreau_triangles_bounds(session, share, bounds), CARREAU_OK) << carreau_last_error(session);
    for (int k = 0; k < 2; ++k) {
      EXPECT_LE(distances[k], bounds[2 * k + 1]);
      EXPECT_LE(bounds[2 * k], bounds[2 * k + 1]);
      EXPECT_LE(bounds[2 * k + 1], bounds[2 * k] * (1 + (share > 0 ? share : 0.01)) + 4e-6);
    }
  }
  auto delivered = sized<carreau_delivered>();
  ASSERT_EQ(carreau_session_delivered(session, &delivered), CARREAU_OK);
  EXPECT_LE(delivered.input_distance, bounds[1]);
  EXPECT_GE(delivered.input_bound, bounds[0]);
  EXPECT_LE(delivered.input_back_distance, bounds[3]);
  EXPECT_GE(delivered.input_back_bound, bounds[2]);
  auto measure = sized<carreau_measure>();
  ASSERT_EQ(carreau_delivered_measure(session, CARREAU_MEASURE_INPUT_BOUND, &measure), CARREAU_OK);
  EXPECT_STREQ(measure.name, "input_bound");
  EXPECT_EQ(measure.count, delivered.triangles);
  EXPECT_EQ(measure.max, delivered.input_bound);
  for (const double wrong : {-1.0, std::nan("")}) EXPECT_EQ(carreau_triangles_bounds(session, wrong, bounds), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_triangles_bounds(session, 0, nullptr), CARREAU_ERR_ARGUMENT);
  ASSERT_EQ(carreau_set_integer(session, "measure_distances", 0), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK);
  ASSERT_EQ(carreau_session_delivered(session, &delivered), CARREAU_OK);
  EXPECT_TRUE(std::isnan(delivered.input_bound) && std::isnan(delivered.input_back_bound));
  ASSERT_EQ(carreau_set_text(session, "element", "p2"), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK);
  EXPECT_EQ(carreau_triangles_bounds(session, 0, bounds), CARREAU_ERR_ARGUMENT);
}

// The faces of a mesh of a session, ascending.
std::vector<std::int32_t> faces_of(carreau_session* session) {
  carreau_mesh* mesh = nullptr;
  EXPECT_EQ(carreau_session_mesh(session, &mesh), CARREAU_OK);
  std::vector<std::int32_t> refs = data_of(mesh).triangle_refs;
  std::sort(refs.begin(), refs.end());
  refs.erase(std::unique(refs.begin(), refs.end()), refs.end());
  return refs;
}

// The weights of a place in a needle, and normals at its corners, are lost to rounding.
TEST_F(Triangles, ANeedleHasAMesh) {
  for (const double width : {1e-3, 1e-6, 1e-8, 9.080692e-10})
    for (const double share : {0.03, 0.2}) {
      const double vertices[] = {1 + width, 0, 0, 0, 0, 1, 1, 0, 0};
      const std::int32_t corners[] = {0, 1, 2};
      auto given = sized<carreau_triangles>();
      given.vertex_count = 3, given.triangle_count = 1, given.vertices = vertices, given.triangles = corners;
      ASSERT_EQ(carreau_model_clear(session), CARREAU_OK);
      ASSERT_EQ(carreau_add_triangles(session, nullptr, &given), CARREAU_OK) << carreau_last_error(session);
      ASSERT_EQ(carreau_set_real(session, "hphydef", share), CARREAU_OK);
      ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << carreau_last_error(session);
      carreau_mesh* mesh = nullptr;
      ASSERT_EQ(carreau_session_mesh(session, &mesh), CARREAU_OK);
      EXPECT_EQ(defects_of(mesh), "") << width;
    }
}

TEST_F(Triangles, HalvesOfACubeAreOneMesh) {
  for (const char* name : {"lower.off", "upper.off"})
    ASSERT_EQ(carreau_load_triangles(session, nullptr, (std::string(CARREAU_TEST_DATA "/triangles/") + name).c_str()), CARREAU_OK)
        << carreau_last_error(session);
  std::int64_t count = 0;
  ASSERT_EQ(carreau_geometry_count(session, &count), CARREAU_OK);
  EXPECT_EQ(count, 2);
  auto second = sized<carreau_geometry>();
  ASSERT_EQ(carreau_geometry_info(session, 1, &second), CARREAU_OK);
  EXPECT_EQ(second.kind, CARREAU_GEOMETRY_TRIANGLES);
  EXPECT_EQ((std::array{second.first_face, second.last_face, second.faces}), (std::array{6, 10, 5}));
  EXPECT_EQ(report().border_edges, 0);
  EXPECT_EQ(report().euler_number, 2);
  EXPECT_EQ(report().lines, 20);
  ASSERT_EQ(carreau_set_real(session, "hphydef", 0.25), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << carreau_last_error(session);
  carreau_mesh* mesh = nullptr;
  ASSERT_EQ(carreau_session_mesh(session, &mesh), CARREAU_OK);
  EXPECT_EQ(defects_of(mesh, true), "");
  EXPECT_EQ(faces_of(session).size(), 10u);
  const double uv[] = {0.25, 0.25};  // of the first triangle of all
  double p[3] = {};
  ASSERT_EQ(carreau_geometry_points(session, 1, 1, uv, p), CARREAU_OK);
  EXPECT_LE(p[2], 0);
}

/// Two rows and columns of control points over [3, 4] x [0, 1].
struct Patch {
  std::vector<double> controls{3, 0, 0, 3, 1, 0, 4, 0, 0, 4, 1, 1};
  std::int32_t degrees[2] = {1, 1};
  carreau_bezier given = sized<carreau_bezier>();
  Patch() { given.patch_count = 1, given.degrees = degrees, given.controls = controls.data(); }
};

TEST_F(Triangles, LieBesidePatchesAndFacesOfAHost) {
  const Octahedron octahedron;
  const Patch patch;
  test_host host{};
  host.session = session;
  const carreau_cad cad = paraboloid_cad(&host);
  ASSERT_EQ(carreau_set_cad(session, &cad), CARREAU_OK);
  ASSERT_EQ(paraboloid_model(session), CARREAU_OK);
  ASSERT_EQ(carreau_add_triangles(session, nullptr, &octahedron.given), CARREAU_OK) << carreau_last_error(session);
  ASSERT_EQ(carreau_add_bezier(session, &patch.given), CARREAU_OK) << carreau_last_error(session);
  std::vector<double> far = octahedron.vertices;
  for (std::size_t k = 0; k < far.size(); k += 3) far[k] += 10;
  Octahedron again;
  again.given.vertices = far.data();
  ASSERT_EQ(carreau_add_triangles(session, nullptr, &again.given), CARREAU_OK) << carreau_last_error(session);
  EXPECT_EQ(report().shells, 2);
  ASSERT_EQ(carreau_set_real(session, "hphydef", 0.3), CARREAU_OK);
  ASSERT_EQ(carreau_set_integer(session, "measure", 1), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << carreau_last_error(session);
  carreau_mesh* mesh = nullptr;
  ASSERT_EQ(carreau_session_mesh(session, &mesh), CARREAU_OK);
  EXPECT_EQ(defects_of(mesh), "");
  const std::vector<std::int32_t> faces = faces_of(session);
  EXPECT_EQ(faces.size(), 1u + 8 + 1 + 8);
  EXPECT_EQ(faces.back() - faces.front(), 17);
  const MeshData data = data_of(mesh);
  std::map<std::int32_t, std::set<std::int32_t>> curves;  // by reference: vertices
  for (std::size_t e = 0; e < data.edge_count(); ++e)
    for (std::size_t k = 0; k < 2; ++k) curves[data.edge_refs[e]].insert(data.edges[2 * e + k]);
  EXPECT_EQ(curves.size(), 4u + 12 + 4 + 12);
  double bounds[4] = {};
  ASSERT_EQ(carreau_triangles_bounds(session, 0, bounds), CARREAU_OK) << carreau_last_error(session);
  EXPECT_LT(bounds[1], 0.3);  // of the octahedra alone
  auto fields = sized<carreau_exr_options>();
  EXPECT_EQ(carreau_write_exr(session, "nowhere.exr", &fields), CARREAU_ERR_ARGUMENT);
  ASSERT_EQ(carreau_model_clear(session), CARREAU_OK);
  auto none = sized<carreau_triangles_report>();
  EXPECT_EQ(carreau_triangles_measure(session, &none), CARREAU_ERR_SEQUENCE);
  ASSERT_EQ(carreau_add_triangles(session, nullptr, &octahedron.given), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << carreau_last_error(session);
  EXPECT_EQ(faces_of(session).size(), 8u);
}

TEST_F(Triangles, ASurfaceThatIsThereAlreadyIsRejected) {
  const Octahedron octahedron;
  ASSERT_EQ(carreau_add_triangles(session, nullptr, &octahedron.given), CARREAU_OK);
  EXPECT_EQ(carreau_add_triangles(session, nullptr, &octahedron.given), CARREAU_ERR_ARGUMENT);
  EXPECT_STREQ(carreau_last_error(session), "all triangles belong to surfaces of the session already");
  EXPECT_EQ(report().triangles, 8);
  std::int64_t count = 0;
  ASSERT_EQ(carreau_geometry_count(session, &count), CARREAU_OK);
  EXPECT_EQ(count, 1);
}

}  // namespace
}  // namespace abi_tests
