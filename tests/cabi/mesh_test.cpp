// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>

#include "abi_fixture.h"

namespace abi_tests {
namespace {

// Length of the parabola z = (u^2 + 2.5^2) / 2 over [-2.5, 2.5], each side of the paraboloid's square.
double side_length() { return 2.5 * std::sqrt(1 + 2.5 * 2.5) + std::asinh(2.5); }

TEST_F(SessionTest, MeshesTheParaboloidFromMemory) {
  use_paraboloid();
  ASSERT_EQ(carreau_reset_parameter(session, "hphydef"), CARREAU_OK);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  const MeshData data = data_of(mesh());
  EXPECT_EQ(data.edge_count(), 216u);  // RT-0232 sec. 6.1, with diag / 50
  const double diag = std::sqrt(25 + 25 + 3.125 * 3.125);
  EXPECT_NEAR(report().diag, diag, 1e-3 * diag);
  double hphydef = 0;
  ASSERT_EQ(carreau_get_real(session, "hphydef", &hphydef), CARREAU_OK) << error();
  EXPECT_NEAR(hphydef, report().diag / 50, 1e-12);
  for (const double h : data.sizes) ASSERT_NEAR(h, hphydef, 0.02 * hphydef);

  // Every corner's (u, v) gives the vertex, and triangles are counterclockwise in (u, v).
  for (std::size_t t = 0; t < data.triangle_count(); ++t) {
    const double* uv = &data.uv[6 * t];
    for (int i = 0; i < 3; ++i) {
      const double u = uv[2 * i], v = uv[2 * i + 1];
      const double* xyz = &data.xyz[3 * std::size_t(data.triangles[3 * t + i])];
      ASSERT_EQ(xyz[0], u);
      ASSERT_EQ(xyz[1], v);
      ASSERT_EQ(xyz[2], (u * u + v * v) / 2);
    }
    ASSERT_GT((uv[2] - uv[0]) * (uv[5] - uv[1]) - (uv[3] - uv[1]) * (uv[4] - uv[0]), 0) << "triangle " << t;
    ASSERT_EQ(data.triangle_refs[t], 1);
  }
  // Corners have their references, and the curves run from their first end to their second.
  std::map<int, int> corners;
  for (const std::int32_t ref : data.vertex_refs)
    if (ref != 0) ++corners[ref];
  EXPECT_EQ(corners, (std::map<int, int>{{1, 1}, {2, 1}, {3, 1}, {4, 1}}));
  std::map<int, double> lengths;
  for (std::size_t e = 0; e < data.edge_count(); ++e) {
    const double* p = &data.xyz[3 * std::size_t(data.edges[2 * e])];
    const double* q = &data.xyz[3 * std::size_t(data.edges[2 * e + 1])];
    lengths[data.edge_refs[e]] += std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
    if (e + 1 < data.edge_count() && data.edge_refs[e] == data.edge_refs[e + 1]) {
      ASSERT_EQ(data.edges[2 * e + 1], data.edges[2 * e + 2]);
    } else {
      ASSERT_EQ(data.vertex_refs[std::size_t(data.edges[2 * e + 1])], data.edge_refs[e] % 4 + 1);
    }
  }
  ASSERT_EQ(lengths.size(), 4u);
  for (const auto& [ref, length] : lengths) EXPECT_NEAR(length, side_length(), 2e-3 * side_length());
}

TEST_F(SessionTest, GivesQualityFacesAndDefects) {
  use_paraboloid(0.3);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  const MeshData data = data_of(mesh());
  std::int64_t n = 0, m = 0, k = 0, f = 0;
  ASSERT_EQ(carreau_mesh_count(mesh(), &n, &m, &k, &f), CARREAU_OK);
  EXPECT_EQ(f, 1);
  auto quality = sized<carreau_quality>();
  ASSERT_EQ(carreau_mesh_quality(mesh(), &quality), CARREAU_OK);
  EXPECT_EQ(quality.vertices, n);
  EXPECT_EQ(quality.triangles, m);
  EXPECT_EQ(quality.open_edges, k);
  EXPECT_EQ(quality.vertices - quality.edges + quality.triangles, 1);  // a disc
  EXPECT_GT(quality.q2_mean, 0.97);
  EXPECT_LE(quality.q2_max, 1 + 1e-12);
  EXPECT_LE(quality.q2_min, quality.q2_p1);
  EXPECT_GT(quality.angle_min, 20);
  EXPECT_LT(quality.edge_min, 0.3);
  EXPECT_GT(quality.edge_max, 0.3);
  // Area of the paraboloid over the square, by Gauss's formula of 20 points a side on the integrand sqrt(1 + u^2 +
  // v^2).
  double area = 0;
  constexpr int cells = 400;
  constexpr double step = 5.0 / cells;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      area += step * step * std::hypot(1.0, -2.5 + (i + 0.5) * step, -2.5 + (j + 0.5) * step);
  EXPECT_NEAR(quality.area, area, 5e-3 * area);
  EXPECT_LT(quality.area, area);
  auto face = sized<carreau_face>();
  ASSERT_EQ(carreau_mesh_face(mesh(), 0, &face), CARREAU_OK);
  EXPECT_EQ(face.ref, 1);
  EXPECT_EQ(face.status, CARREAU_FACE_MESHED);
  EXPECT_EQ(face.triangles, m);
  EXPECT_STREQ(face.why, "");
  EXPECT_EQ(carreau_mesh_face(mesh(), 1, &face), CARREAU_ERR_ARGUMENT);
  EXPECT_STREQ(carreau_mesh_last_error(mesh()), "there is no face of index 1: the mesh has 1");
  EXPECT_EQ(defects_of(mesh()), "");
  EXPECT_NE(defects_of(mesh(), true), "");  // it has a border
  std::vector<double> xyz(3 * std::size_t(n), -5);
  EXPECT_EQ(carreau_mesh_vertices(mesh(), n - 1, xyz.data()), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(xyz[0], -5);
  EXPECT_EQ(carreau_mesh_vertices(mesh(), n, nullptr), CARREAU_ERR_ARGUMENT);
}

TEST_F(SessionTest, ReportsTrianglesThatCross) {
  use_paraboloid(0.3);
  std::int64_t count = -1;
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  ASSERT_EQ(carreau_mesh_intersections(mesh(), 0, 0, &count, nullptr, nullptr), CARREAU_OK);
  EXPECT_EQ(count, 0);
  // A square of two triangles, and three more through its middle.
  const std::string path = testing::TempDir() + "carreau_crossing.mesh";
  std::ofstream(path) << "MeshVersionFormatted 2\nDimension 3\nVertices 10\n0 0 0 0\n2 0 0 0\n2 2 0 0\n0 2 0 0\n"
                         "1 .5 -1 0\n1 .5 1 0\n1.25 .5 1 0\n.5 1.5 1 0\n.5 1.75 1 0\n.5 1.5 -1 0\nTriangles 4\n"
                         "1 2 3 1\n1 3 4 1\n5 6 7 2\n10 8 9 3\nEnd\n";
  carreau_mesh* file = nullptr;
  ASSERT_EQ(carreau_mesh_create(&file), CARREAU_OK);
  EXPECT_EQ(carreau_mesh_intersections(file, 1, 0, &count, nullptr, nullptr), CARREAU_ERR_SEQUENCE);
  ASSERT_EQ(carreau_mesh_read(file, path.c_str()), CARREAU_OK) << carreau_mesh_last_error(file);
  std::array<std::int32_t, 6> triangles{-1, -1, -1, -1, -1, -1};
  std::array<double, 9> xyz{};
  ASSERT_EQ(carreau_mesh_intersections(file, 2, 3, &count, triangles.data(), xyz.data()), CARREAU_OK);
  EXPECT_EQ(count, 2);
  EXPECT_EQ(triangles, (std::array<std::int32_t, 6>{0, 2, 1, 3, -1, -1}));
  EXPECT_NEAR(xyz[1], 0.5, 1e-15);
  EXPECT_NEAR(xyz[2], 0, 1e-15);
  triangles.fill(-1);
  ASSERT_EQ(carreau_mesh_intersections(file, 1, 1, &count, triangles.data(), nullptr), CARREAU_OK);
  EXPECT_EQ(count, 2);
  EXPECT_EQ(triangles, (std::array<std::int32_t, 6>{0, 2, -1, -1, -1, -1}));
  EXPECT_EQ(carreau_mesh_intersections(file, -1, 0, &count, nullptr, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_mesh_intersections(file, 1, -1, &count, nullptr, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_mesh_intersections(file, 1, 0, nullptr, nullptr, nullptr), CARREAU_ERR_ARGUMENT);
  carreau_mesh_free(file);
  std::remove(path.c_str());
}

TEST_F(SessionTest, FindsReferencesByGluingAndGivesThemBack) {
  const carreau_cad cad = paraboloid_cad(&host);
  ASSERT_EQ(carreau_set_cad(session, &cad), CARREAU_OK);
  ASSERT_EQ(carreau_model_add_face(session, 1, 1), CARREAU_OK);
  for (int ic = 1; ic <= 4; ++ic) ASSERT_EQ(carreau_model_add_curve(session, 1, 1, 0, 0, 0), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  std::array<std::int32_t, 4> refs{};
  std::array<std::int32_t, 8> ends{};
  ASSERT_EQ(carreau_model_curves(session, 4, nullptr, nullptr, refs.data(), ends.data()), CARREAU_OK);
  for (int ic = 0; ic < 4; ++ic) {
    EXPECT_GT(refs[ic], 0);
    EXPECT_GT(ends[2 * ic], 0);
    EXPECT_EQ(ends[2 * ic + 1], ends[(2 * ic + 2) % 8]);  // the boundary closes
  }
  EXPECT_EQ(data_of(mesh()).edge_count(), 216u);
}

TEST_F(SessionTest, MeshesATorusWithItsSeams) {
  const carreau_cad cad = torus_cad(&host);
  ASSERT_EQ(carreau_set_cad(session, &cad), CARREAU_OK);
  ASSERT_EQ(torus_model(session), CARREAU_OK);
  ASSERT_EQ(carreau_set_real(session, "hphydef", 0.2), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  EXPECT_EQ(defects_of(mesh(), true), "");
  auto quality = sized<carreau_quality>();
  ASSERT_EQ(carreau_mesh_quality(mesh(), &quality), CARREAU_OK);
  EXPECT_EQ(quality.open_edges, 0);
  EXPECT_EQ(quality.vertices - quality.edges + quality.triangles, 0);  // Euler number of a torus
  const double area = 4 * std::numbers::pi * std::numbers::pi * 3;
  EXPECT_NEAR(quality.area, area, 0.01 * area);
  // A vertex of a seam has its own (u, v) at each corner.
  const MeshData data = data_of(mesh());
  for (std::size_t c = 0; c < data.triangles.size(); ++c) {
    const double u = data.uv[2 * c], v = data.uv[2 * c + 1], w = 3 + std::cos(v);
    const double* p = &data.xyz[3 * std::size_t(data.triangles[c])];
    ASSERT_NEAR(std::hypot(p[0] - w * std::cos(u), p[1] - w * std::sin(u), p[2] - std::sin(v)), 0, 1e-9);
  }
}

TEST_F(SessionTest, ListsTheInterfacesOfATorusAndOfASheet) {
  std::int64_t n = -1;
  auto each = sized<carreau_interface>();
  EXPECT_EQ(carreau_session_interface_count(session, &n), CARREAU_ERR_SEQUENCE);
  EXPECT_EQ(carreau_session_interface(session, 0, &each), CARREAU_ERR_SEQUENCE);
  use_paraboloid();
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  ASSERT_EQ(carreau_session_interface_count(session, &n), CARREAU_OK);
  ASSERT_EQ(n, 4);
  for (std::int64_t i = 0; i < n; ++i) {
    ASSERT_EQ(carreau_session_interface(session, i, &each), CARREAU_OK);
    EXPECT_EQ(each.curve, i + 1);
    EXPECT_EQ(each.uses, 1);
    EXPECT_EQ(each.boundary, 1);
    EXPECT_EQ(each.face, 1);
    EXPECT_EQ(each.ic, i + 1);
    EXPECT_EQ(each.other_face, 1);
    EXPECT_EQ(each.gap, 0);
  }
  EXPECT_EQ(carreau_session_interface(session, 4, &each), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_session_interface(session, -1, &each), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_session_interface(session, 0, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_session_interface_count(session, nullptr), CARREAU_ERR_ARGUMENT);

  ASSERT_EQ(carreau_model_clear(session), CARREAU_OK);
  const carreau_cad torus = torus_cad(&host);
  ASSERT_EQ(carreau_set_cad(session, &torus), CARREAU_OK);
  ASSERT_EQ(torus_model(session), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  ASSERT_EQ(carreau_session_interface_count(session, &n), CARREAU_OK);
  ASSERT_EQ(n, 2);
  for (std::int64_t i = 0; i < n; ++i) {
    ASSERT_EQ(carreau_session_interface(session, i, &each), CARREAU_OK);
    EXPECT_EQ(each.uses, 2);
    EXPECT_EQ(each.face, 5);
    EXPECT_EQ(each.other_face, 5);
    EXPECT_NE(each.ic, each.other_ic);
    EXPECT_EQ(each.glued, 0);
    EXPECT_LT(each.gap, 1e-12);
  }
}

TEST_F(SessionTest, BothRegistrationsGiveTheSameMesh) {
  use_paraboloid(0.2);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  const MeshData by_value = data_of(mesh());
  const carreau_cad batch = paraboloid_batch_cad(&host);
  ASSERT_EQ(carreau_set_cad(session, &batch), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  EXPECT_TRUE(data_of(mesh()) == by_value);
  const carreau_cad_m by_reference = paraboloid_cad_m();
  ASSERT_EQ(carreau_set_cad_m(session, &by_reference), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  EXPECT_TRUE(data_of(mesh()) == by_value);
}

TEST_F(SessionTest, DerivativesThatAreNotGivenAreFound) {
  use_paraboloid(0.3);
  ASSERT_EQ(carreau_set_integer(session, "hgeo_flag", 1), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  const MeshData exact = data_of(mesh());
  carreau_cad cad = paraboloid_cad(&host);
  cad.surface_order = 0;
  cad.curve_order = 0;
  ASSERT_EQ(carreau_set_cad(session, &cad), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  const MeshData found = data_of(mesh());
  EXPECT_EQ(defects_of(mesh()), "");
  EXPECT_EQ(found.edge_count(), exact.edge_count());
  EXPECT_NEAR(double(found.triangle_count()), double(exact.triangle_count()), 0.02 * double(exact.triangle_count()));
}

// Calls of surf0, surf1 and surf2 a vertex, on 10 000 triangles or more.
double calls_a_vertex(carreau_session* session) {
  carreau_mesh* mesh = nullptr;
  std::int64_t n = 0, m = 0;
  EXPECT_EQ(carreau_session_mesh(session, &mesh), CARREAU_OK);
  EXPECT_EQ(carreau_mesh_count(mesh, &n, &m, nullptr, nullptr), CARREAU_OK);
  EXPECT_GE(m, 10000);
  auto report = sized<carreau_report>();
  EXPECT_EQ(carreau_session_report(session, &report), CARREAU_OK);
  EXPECT_EQ(report.surf0_calls, count_cad_m_calls(0));
  EXPECT_EQ(report.surf1_calls, count_cad_m_calls(1));
  EXPECT_EQ(report.surf2_calls, count_cad_m_calls(2));
  const double calls = double(count_cad_m_calls(0) + count_cad_m_calls(1) + count_cad_m_calls(2)) / double(n);
  testing::Test::RecordProperty("calls_a_vertex", std::to_string(calls));
  std::printf("%lld triangles, %.2f calls a vertex\n", static_cast<long long>(m), calls);
  return calls;
}

TEST(Callbacks, AreAtMostThreeAVertexForAUniformMesh) {
  carreau_session* session = nullptr;
  reset_cad_m_calls();
  ASSERT_EQ(mesh_paraboloid(0.1, &session), CARREAU_OK) << carreau_last_error(session);
  EXPECT_LE(calls_a_vertex(session), 3);
  carreau_session_free(session);
}

TEST(Callbacks, AreAtMostFiveAVertexForAGeometricMesh) {
  carreau_session* session = nullptr;
  ASSERT_EQ(carreau_session_create(&session), CARREAU_OK);
  const carreau_cad_m cad = paraboloid_cad_m();
  ASSERT_EQ(carreau_set_cad_m(session, &cad), CARREAU_OK);
  ASSERT_EQ(paraboloid_model(session), CARREAU_OK);
  ASSERT_EQ(carreau_set_integer(session, "hphy_flag", 0), CARREAU_OK);
  ASSERT_EQ(carreau_set_integer(session, "hgeo_flag", 1), CARREAU_OK);
  ASSERT_EQ(carreau_set_real(session, "angle_mesh", 1.5), CARREAU_OK);
  reset_cad_m_calls();
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << carreau_last_error(session);
  EXPECT_LE(calls_a_vertex(session), 5);
  carreau_session_free(session);
}

// ---- files ----

class MeshFileTest : public SessionTest {
 protected:
  void SetUp() override {
    SessionTest::SetUp();
    ASSERT_EQ(carreau_mesh_create(&read), CARREAU_OK);
    path = testing::TempDir() + "carreau_abi_" + testing::UnitTest::GetInstance()->current_test_info()->name();
  }
  void TearDown() override {
    carreau_mesh_free(read);
    for (const char* suffix : {".mesh", ".meshb", ".vtu", ".stl", ".msh", ".msh2"})
      std::remove((path + suffix).c_str());
    SessionTest::TearDown();
  }
  [[nodiscard]] std::string read_error() const { return carreau_mesh_last_error(read); }
  void write_text(const std::string& text) const {
    std::FILE* file = std::fopen((path + ".mesh").c_str(), "w");
    ASSERT_NE(file, nullptr);
    std::fputs(text.c_str(), file);
    std::fclose(file);
  }

  carreau_mesh* read = nullptr;
  std::string path;
};

TEST_F(MeshFileTest, AMeshWrittenIsReadBackBitForBit) {
  use_paraboloid(0.4);
  ASSERT_EQ(carreau_set_integer(session, "flag", 1), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  MeshData written = data_of(mesh());
  written.uv.clear(), written.sizes.clear();
  for (const char* suffix : {".mesh", ".meshb"}) {
    SCOPED_TRACE(suffix);
    ASSERT_EQ(carreau_mesh_write(mesh(), (path + suffix).c_str()), CARREAU_OK) << carreau_mesh_last_error(mesh());
    ASSERT_EQ(carreau_mesh_read(read, (path + suffix).c_str()), CARREAU_OK) << read_error();
    EXPECT_TRUE(data_of(read, false) == written);
    EXPECT_EQ(defects_of(read), "");
    std::int32_t dimension = 0;
    EXPECT_EQ(carreau_mesh_dimension(read, &dimension), CARREAU_OK);
    EXPECT_EQ(dimension, 3);
    auto face = sized<carreau_face>();
    EXPECT_EQ(carreau_mesh_face(read, 0, &face), CARREAU_OK);
    EXPECT_EQ(face.ref, 1);
    EXPECT_EQ(std::size_t(face.triangles), written.triangle_count());
  }
  std::vector<double> sizes(written.vertex_count());
  EXPECT_EQ(carreau_mesh_vertex_sizes(read, std::int64_t(sizes.size()), sizes.data()), CARREAU_ERR_SEQUENCE);
  EXPECT_EQ(read_error(), "a mesh that was read from a file has no prescribed sizes");
  for (const char* suffix : {".vtu", ".stl", ".msh", ".msh2"})
    EXPECT_EQ(carreau_mesh_write(read, (path + suffix).c_str()), CARREAU_OK) << read_error();
}

TEST_F(SessionTest, SizesThatAreNotPositiveAreErrorsOfTheCallback) {
  ASSERT_EQ(paraboloid_model(session), CARREAU_OK);
  ASSERT_EQ(carreau_set_integer(session, "hphy_flag", 2), CARREAU_OK);
  for (const double size : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    carreau_cad cad = paraboloid_cad(&host);
    static double given;
    given = size;
    cad.surface_size = [](std::int32_t, double, double, double* value, void*) { return *value = given, 0; };
    ASSERT_EQ(carreau_set_cad(session, &cad), CARREAU_OK);
    EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_CALLBACK) << size;
    auto place = sized<carreau_error_place>();
    ASSERT_EQ(carreau_last_error_place(session, &place), CARREAU_OK);
    EXPECT_EQ(place.face, 1);
    EXPECT_TRUE(std::isfinite(place.uv[0]) && std::isfinite(place.uv[1]));
  }
  carreau_cad cad = paraboloid_cad(&host);
  cad.surface_size = [](std::int32_t, double, double, double* value, void*) { return *value = CARREAU_HVIDE, 0; };
  ASSERT_EQ(carreau_set_cad(session, &cad), CARREAU_OK);
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
}

TEST_F(SessionTest, AHostExplainsTheFailureOfItsCallback) {
  carreau_cad cad = paraboloid_cad(&host);
  cad.failure = [](std::int32_t face, void* user) {
    return face == 1 && user != nullptr ? "the knots of the spline descend" : "";
  };
  ASSERT_EQ(carreau_set_cad(session, &cad), CARREAU_OK);
  ASSERT_EQ(paraboloid_model(session), CARREAU_OK);
  host.misbehaviour = HOST_STATUS;
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_CALLBACK);
  EXPECT_NE(error().find("(the knots of the spline descend)"), std::string::npos) << error();
  // The only face: there is no mesh without it.
  ASSERT_EQ(carreau_set_text(session, "failing_faces", "leave_out"), CARREAU_OK);
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_DOMAIN);
  EXPECT_NE(error().find("no face could be meshed: face 1"), std::string::npos) << error();
  auto place = sized<carreau_error_place>();
  ASSERT_EQ(carreau_last_error_place(session, &place), CARREAU_OK);
  EXPECT_EQ(place.face, 1);
  EXPECT_NE(error().find("(the knots of the spline descend)"), std::string::npos) << error();
}

// A second face that the host does not know.
TEST_F(MeshFileTest, FacesThatAreLeftOutAreInTheMeshAndInFiles) {
  use_paraboloid(0.8);
  EXPECT_EQ(carreau_model_leave_out_face(session, 2, "why"), CARREAU_ERR_ARGUMENT);
  ASSERT_EQ(carreau_model_add_face(session, 2, 1), CARREAU_OK);
  ASSERT_EQ(carreau_model_name_face(session, 2, "lid"), CARREAU_OK);
  ASSERT_EQ(carreau_model_leave_out_face(session, 2, "face 2: its file is lost"), CARREAU_OK) << error();
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_ERR_PARTIAL) << error();
  ASSERT_EQ(carreau_mesh_write(mesh(), (path + ".vtu").c_str()), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_read(read, (path + ".vtu").c_str()), CARREAU_OK) << read_error();
  for (carreau_mesh* each : {mesh(), read}) {
    auto face = sized<carreau_face>();
    ASSERT_EQ(carreau_mesh_face(each, 1, &face), CARREAU_OK);
    EXPECT_EQ(face.ref, 2);
    EXPECT_EQ(face.status, CARREAU_FACE_FAILED);
    EXPECT_EQ(face.triangles, 0);
    EXPECT_STREQ(face.why, "face 2: its file is lost");
    EXPECT_STREQ(face.name, "lid");
  }
  ASSERT_EQ(carreau_model_leave_out_face(session, 2, nullptr), CARREAU_OK);
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_MODEL);
  EXPECT_EQ(error(), "face 2: the face has no curve");
}

TEST_F(MeshFileTest, EntitiesHaveNamesAndFacesHaveSides) {
  use_paraboloid(0.8);
  const auto name_entity = [this](std::int32_t dimension, std::int32_t ref, const char* name) {
    return carreau_model_name_entities(session, dimension, 1, &ref, name);
  };
  EXPECT_EQ(carreau_model_name_entities(session, 1, -1, nullptr, "rim"), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_model_name_entities(session, 1, 1, nullptr, "rim"), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_model_name_entities(session, 1, 0, nullptr, "rim"), CARREAU_OK);
  EXPECT_EQ(name_entity(3, 7, "bowl"), CARREAU_ERR_ARGUMENT);  // no face has it
  EXPECT_EQ(carreau_model_set_face_sides(session, 1, -1, 0), CARREAU_ERR_ARGUMENT);
  ASSERT_EQ(carreau_model_set_face_sides(session, 1, 7, 0), CARREAU_OK) << error();
  ASSERT_EQ(name_entity(3, 7, "bowl"), CARREAU_OK) << error();
  ASSERT_EQ(name_entity(2, 1, "dish"), CARREAU_OK) << error();
  ASSERT_EQ(name_entity(1, 1, "rim"), CARREAU_OK) << error();
  EXPECT_EQ(name_entity(1, 99, "rim"), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(name_entity(4, 1, "rim"), CARREAU_ERR_ARGUMENT);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  std::array<std::int32_t, 2> sides{};
  ASSERT_EQ(carreau_mesh_face_sides(mesh(), 1, sides.data()), CARREAU_OK);
  EXPECT_EQ(sides, (std::array<std::int32_t, 2>{7, 0}));
  std::int64_t regions = 0;
  EXPECT_EQ(carreau_mesh_regions(mesh(), 0, &regions, nullptr, nullptr), CARREAU_ERR_ARGUMENT);  // the bowl is open
  EXPECT_STREQ(carreau_mesh_entity_name(mesh(), 3, 7), "bowl");
  EXPECT_STREQ(carreau_mesh_entity_name(mesh(), 2, 1), "dish");
  EXPECT_STREQ(carreau_mesh_entity_name(mesh(), 1, 1), "rim");
  EXPECT_STREQ(carreau_mesh_entity_name(mesh(), 0, 1), "");
}

TEST_F(MeshFileTest, NamesOfFacesAreInTheMeshAndInFiles) {
  use_paraboloid(0.8);
  EXPECT_EQ(carreau_model_name_face(session, 2, "dish"), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_model_name_face(session, 1, nullptr), CARREAU_ERR_ARGUMENT);
  ASSERT_EQ(carreau_model_name_face(session, 1, "dish"), CARREAU_OK) << error();
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  auto face = sized<carreau_face>();
  ASSERT_EQ(carreau_mesh_face(mesh(), 0, &face), CARREAU_OK);
  EXPECT_STREQ(face.name, "dish");
  EXPECT_STREQ(face.why, "");
  EXPECT_EQ(face.rgb, -1);
  const auto content = [&](const char* suffix) {
    EXPECT_EQ(carreau_mesh_write(mesh(), (path + suffix).c_str()), CARREAU_OK) << carreau_mesh_last_error(mesh());
    std::ifstream file(path + suffix, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_EQ(content(".stl").substr(0, 11), "solid dish\n");
  EXPECT_NE(content(".msh").find("\n2 1 \"dish\"\n"), std::string::npos);
  EXPECT_NE(content(".msh2").find("\n2 1 \"dish\"\n"), std::string::npos);
  EXPECT_NE(content(".vtu").find(">\n100 105 115 104 0\n<"), std::string::npos);
  for (const char* suffix : {".vtu", ".msh", ".msh2", ".stl"}) {
    ASSERT_EQ(carreau_mesh_read(read, (path + suffix).c_str()), CARREAU_OK) << read_error();
    ASSERT_EQ(carreau_mesh_face(read, 0, &face), CARREAU_OK);
    EXPECT_STREQ(face.name, "dish") << suffix;
    EXPECT_EQ(face.ref, 1) << suffix;
    EXPECT_EQ(face.rgb, -1) << suffix;
  }
}

TEST_F(MeshFileTest, ColoursOfFacesAreInTheMeshAndInVtu) {
  use_paraboloid(0.8);
  EXPECT_EQ(carreau_model_color_face(session, 2, 0), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_model_color_face(session, 1, 0x1000000), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_model_color_face(session, 1, -2), CARREAU_ERR_ARGUMENT);
  ASSERT_EQ(carreau_model_color_face(session, 1, 0xFF8001), CARREAU_OK) << error();
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  auto face = sized<carreau_face>();
  ASSERT_EQ(carreau_mesh_face(mesh(), 0, &face), CARREAU_OK);
  EXPECT_EQ(face.rgb, 0xFF8001);
  ASSERT_EQ(carreau_mesh_write(mesh(), (path + ".vtu").c_str()), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_read(read, (path + ".vtu").c_str()), CARREAU_OK) << read_error();
  ASSERT_EQ(carreau_mesh_face(read, 0, &face), CARREAU_OK);
  EXPECT_EQ(face.rgb, 0xFF8001);
  EXPECT_EQ(face.status, CARREAU_FACE_MESHED);
}

TEST_F(MeshFileTest, ExportsByTheParameters) {
  use_paraboloid(0.4);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  const std::string file = path + ".mesh";
  ASSERT_EQ(carreau_set_text(session, "option", "onesurf2d"), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_write(mesh(), file.c_str()), CARREAU_OK) << carreau_mesh_last_error(mesh());
  ASSERT_EQ(carreau_mesh_read(read, file.c_str()), CARREAU_OK) << read_error();
  std::int32_t dimension = 0;
  EXPECT_EQ(carreau_mesh_dimension(read, &dimension), CARREAU_OK);
  EXPECT_EQ(dimension, 2);
  auto quality = sized<carreau_quality>();
  ASSERT_EQ(carreau_mesh_quality(read, &quality), CARREAU_OK);
  EXPECT_NEAR(quality.area, 25, 1e-9);
  std::int64_t edges = -1;
  EXPECT_EQ(carreau_mesh_count(read, nullptr, nullptr, &edges, nullptr), CARREAU_OK);
  EXPECT_EQ(edges, 0);  // flag is 0
  ASSERT_EQ(carreau_set_integer(session, "refs", 9), CARREAU_OK);
  EXPECT_EQ(carreau_mesh_write(mesh(), file.c_str()), CARREAU_ERR_ARGUMENT);
  ASSERT_EQ(carreau_mesh_read(read, file.c_str()), CARREAU_OK) << "the older file is gone";
}

TEST_F(MeshFileTest, BadFilesHaveASentenceAndChangeNothing) {
  EXPECT_EQ(carreau_mesh_count(read, nullptr, nullptr, nullptr, nullptr), CARREAU_ERR_SEQUENCE);
  EXPECT_EQ(read_error(), "the mesh is empty: call carreau_mesh_read or carreau_mesh_from_arrays first");
  const std::string file = path + ".mesh";
  EXPECT_EQ(carreau_mesh_read(read, file.c_str()), CARREAU_ERR_FILE);
  EXPECT_NE(read_error().find(file), std::string::npos) << read_error();
  write_text("MeshVersionFormatted 2\nDimension 3\nVertices 3\n0 0 0 1\n1 0 0 2\n0 1 0 3\nTriangles 1\n1 2 3 4\nEnd\n");
  ASSERT_EQ(carreau_mesh_read(read, file.c_str()), CARREAU_OK) << read_error();
  for (const char* text : {"", "MeshVersionFormatted 2\nDimension 3\nVertices 3\n0 0 0 1\n1 0 0", "\x01\x02\x03",
                           "MeshVersionFormatted 2\nDimension 3\nVertices -1\nEnd\n"}) {
    write_text(text);
    EXPECT_EQ(carreau_mesh_read(read, file.c_str()), CARREAU_ERR_FILE) << text;
    EXPECT_NE(read_error(), "") << text;
    std::int64_t n = 0;
    EXPECT_EQ(carreau_mesh_count(read, &n, nullptr, nullptr, nullptr), CARREAU_OK);
    EXPECT_EQ(n, 3);
  }
  EXPECT_EQ(carreau_mesh_write(read, "x.doc"), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_mesh_write(read, "/nonexistent/x.mesh"), CARREAU_ERR_FILE);
}

TEST_F(MeshFileTest, DefectsOfAFileAreFound) {
  const std::string head =
      "MeshVersionFormatted 2\nDimension 3\nVertices 5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n1 1 0 0\n2 2 2 0\n";
  const auto defects = [&](const std::string& rest) {
    write_text(head + rest + "End\n");
    EXPECT_EQ(carreau_mesh_read(read, (path + ".mesh").c_str()), CARREAU_OK) << read_error();
    return defects_of(read);
  };
  EXPECT_EQ(defects("Triangles 2\n1 2 3 1\n3 2 4 1\n"), "vertex 4: it belongs to no triangle");
  EXPECT_EQ(defects("Triangles 3\n1 2 3 1\n3 2 4 1\n2 5 4 1\n"), "");
  const std::string turned = " share it and are turned against each other";
  EXPECT_EQ(defects("Triangles 3\n1 2 3 1\n2 3 4 1\n2 4 5 1\n"), "edge 1-2: 2 triangles of reference 1" + turned);
  EXPECT_EQ(defects("Triangles 3\n1 2 3 1\n2 3 4 2\n2 4 5 2\n"), "");  // another face may be turned otherwise
  EXPECT_EQ(defects("Triangles 3\n1 2 3 1\n2 3 4 1\n2 4 5 1\nEdges 1\n2 3 9\n"), "");  // so may a curve's other side
  EXPECT_EQ(defects("Triangles 4\n1 2 3 1\n3 2 4 1\n2 5 4 1\n3 1 2 1\n"),
            "triangle 3: the same vertices as triangle 0\nedge 0-1: 2 triangles of reference 1" + turned +
                "\nedge 0-2: 2 triangles of reference 1" + turned + "\nedge 1-2: 3 triangles of reference 1 share it");
  EXPECT_EQ(defects("Triangles 3\n1 2 3 1\n3 2 4 1\n5 5 4 1\n"), "triangle 2: it repeats a vertex");
}

TEST_F(SessionTest, RunsABlsurfEnv) {
  const std::string folder = testing::TempDir() + "carreau_abi_env_";
  const std::string env = folder + "blsurf.env", pref = "carreau_abi_env_out",
                    out = testing::TempDir() + pref + ".mesh";
  std::FILE* file = std::fopen(env.c_str(), "w");
  ASSERT_NE(file, nullptr);
  std::fprintf(file, "hphydef 0.5 ! coarse\ncall inimesh\n\npref = '%s'\nflag 1\ncall export\ncall exit\n",
               pref.c_str());
  std::fclose(file);
  use_paraboloid(0.1);
  ASSERT_EQ(carreau_run_env(session, env.c_str()), CARREAU_OK) << error();
  carreau_mesh* read = nullptr;
  ASSERT_EQ(carreau_mesh_create(&read), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_read(read, out.c_str()), CARREAU_OK) << carreau_mesh_last_error(read);
  MeshData made = data_of(mesh());
  made.uv.clear(), made.sizes.clear();
  EXPECT_TRUE(data_of(read, false) == made);
  EXPECT_NEAR(double(made.edge_count()), 4 * side_length() / 0.5, 4);
  carreau_mesh_free(read);

  file = std::fopen(env.c_str(), "w");
  ASSERT_NE(file, nullptr);
  std::fputs("hphydef 0.5\nhphyminn 0.1\ncall inimesh\n", file);
  std::fclose(file);
  EXPECT_EQ(carreau_run_env(session, env.c_str()), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(error(), env + ", line 2: there is no parameter 'hphyminn'; did you mean 'hphymin'?");
  auto place = sized<carreau_error_place>();
  EXPECT_EQ(carreau_last_error_place(session, &place), CARREAU_OK);
  EXPECT_EQ(place.line, 2);
  double hphydef = 0;
  ASSERT_EQ(carreau_reset_parameter(session, "hphydef"), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  EXPECT_EQ(carreau_run_env(session, env.c_str()), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_get_real(session, "hphydef", &hphydef), CARREAU_OK);
  EXPECT_LT(hphydef, 0.16);  // the default again (diag / 50), not the value of line 1
  ASSERT_EQ(carreau_set_real(session, "hphydef", 0.25), CARREAU_OK);
  EXPECT_EQ(carreau_run_env(session, "/nonexistent/blsurf.env"), CARREAU_ERR_FILE);
  EXPECT_EQ(carreau_get_real(session, "hphydef", &hphydef), CARREAU_OK);
  EXPECT_EQ(hphydef, 0.25);  // nothing was run
  std::remove(env.c_str());
  std::remove(out.c_str());
}

TEST_F(SessionTest, TheParametersOfAnEnvFileCanBeTakenWithoutItsActions) {
  const std::string env = testing::TempDir() + "carreau_abi_read.env";
  const auto write = [&](const char* text) {
    std::FILE* file = std::fopen(env.c_str(), "w");
    ASSERT_NE(file, nullptr);
    std::fputs(text, file);
    std::fclose(file);
  };
  write("hphydef 0.5 ! coarse\nflag 1\nbackground_mesh bg.mesh\ncall inimesh\nhphydef 7\ncall export\n");
  ASSERT_EQ(carreau_set_real(session, "hphymax", 3), CARREAU_OK);
  ASSERT_EQ(carreau_read_env(session, env.c_str()), CARREAU_OK) << error();
  double hphydef = 0, hphymax = 0;
  int32_t flag = 0;
  const char* background = nullptr;
  EXPECT_EQ(carreau_get_real(session, "hphydef", &hphydef), CARREAU_OK);
  EXPECT_EQ(carreau_get_real(session, "hphymax", &hphymax), CARREAU_OK);
  EXPECT_EQ(carreau_get_integer(session, "flag", &flag), CARREAU_OK);
  EXPECT_EQ(hphydef, 0.5);
  EXPECT_EQ(hphymax, 3);  // not named in the file
  EXPECT_EQ(flag, 1);
  ASSERT_EQ(carreau_get_text(session, "background_mesh", &background), CARREAU_OK);
  EXPECT_EQ(background, testing::TempDir() + "bg.mesh");
  carreau_mesh* none = nullptr;
  EXPECT_EQ(carreau_session_mesh(session, &none), CARREAU_ERR_SEQUENCE);

  write("hphydef 0.25\nhphyminn 0.1\n");
  EXPECT_EQ(carreau_read_env(session, env.c_str()), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(error(), env + ", line 2: there is no parameter 'hphyminn'; did you mean 'hphymin'?");
  EXPECT_EQ(carreau_read_env(session, "/nonexistent/blsurf.env"), CARREAU_ERR_FILE);
  EXPECT_EQ(carreau_get_real(session, "hphydef", &hphydef), CARREAU_OK);
  EXPECT_EQ(hphydef, 0.5);  // as before
  std::remove(env.c_str());
}

// A model that the host has given, built or read, is the model of every `call inimesh`; else each reads its own.
TEST_F(SessionTest, ABlsurfEnvReadsAPardomUnlessTheHostHasDone) {
  const std::string folder = testing::TempDir() + "carreau_abi_pardom_";
  const std::string env = folder + "blsurf.env", theirs = folder + "point.pardom", ours = folder + "plain.pardom";
  const auto write = [](const std::string& path, const std::string& text) {
    std::FILE* file = std::fopen(path.c_str(), "w");
    ASSERT_NE(file, nullptr);
    std::fputs(text.c_str(), file);
    std::fclose(file);
  };
  const std::string face = "1\n1 1 4\n1 1 1 2\n1 2 2 3\n1 3 3 4\n1 4 4 1\n";
  write(theirs, face + "1\n77 0.3 0.2\n");  // an imposed point of reference 77
  write(ours, face + "0\n");
  write(env, "hphydef 0.5\npref carreau_abi_pardom_point\ncall inimesh\n");
  const auto has_point = [&] {
    const std::vector<std::int32_t> refs = data_of(mesh()).vertex_refs;
    return std::count(refs.begin(), refs.end(), 77) == 1;
  };
  test_host host{};
  const carreau_cad cad = paraboloid_cad(&host);
  ASSERT_EQ(carreau_set_cad(session, &cad), CARREAU_OK);
  for (int run = 0; run < 2; ++run) {  // the second does not take the model of the first for the host's
    ASSERT_EQ(carreau_run_env(session, env.c_str()), CARREAU_OK) << error();
    EXPECT_TRUE(has_point());
    write(theirs, face + (run == 0 ? "1\n77 0.4 0.2\n" : "0\n"));
  }
  ASSERT_EQ(carreau_run_env(session, env.c_str()), CARREAU_OK) << error();
  EXPECT_FALSE(has_point());

  write(theirs, face + "1\n77 0.3 0.2\n");
  ASSERT_EQ(carreau_model_read_pardom(session, ours.c_str()), CARREAU_OK) << error();
  for (int run = 0; run < 2; ++run) {
    ASSERT_EQ(carreau_run_env(session, env.c_str()), CARREAU_OK) << error();
    EXPECT_FALSE(has_point());
  }
  ASSERT_EQ(carreau_model_clear(session), CARREAU_OK);
  ASSERT_EQ(carreau_run_env(session, env.c_str()), CARREAU_OK) << error();
  EXPECT_TRUE(has_point());
  for (const std::string& path : {env, theirs, ours}) std::remove(path.c_str());
}

}  // namespace
}  // namespace abi_tests
