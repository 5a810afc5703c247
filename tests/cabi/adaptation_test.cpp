// SPDX-License-Identifier: BSD-3-Clause
// Background meshes, estimators, transfer and the loop of adaptation through the interface.
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <random>

#include "abi_fixture.h"

namespace {

namespace fs = std::filesystem;

// The square [-1, 1]^2 of the plane z = 0.
int32_t plane(int32_t, double u, double v, int32_t order, double* S, double* Su, double* Sv, double* Suu, double* Suv,
              double* Svv, void*) {
  S[0] = u, S[1] = v, S[2] = 0;
  if (order >= 1) Su[0] = Sv[1] = 1, Su[1] = Su[2] = Sv[0] = Sv[2] = 0;
  if (order >= 2)
    for (int k = 0; k < 3; ++k) Suu[k] = Suv[k] = Svv[k] = 0;
  return 0;
}
int32_t interval(int32_t, int32_t, double* a, double* b, void*) { return *a = -1, *b = 1, 0; }
int32_t side(int32_t, int32_t ic, double t, int32_t order, double* C, double* Ct, double* Ctt, void*) {
  const double sign = ic <= 2 ? 1 : -1;
  const int along = ic % 2 == 1 ? 0 : 1;
  C[along] = sign * t, C[1 - along] = ic == 2 || ic == 3 ? 1 : -1;
  if (order >= 1) Ct[along] = sign, Ct[1 - along] = 0;
  if (order >= 2) Ctt[0] = Ctt[1] = 0;
  return 0;
}

struct Field {
  std::function<double(double, double)> at;
  int32_t status = 0;
  carreau_session* stop = nullptr;
  int64_t calls = 0;
};
int32_t evaluate(int64_t n, const double* xyz, double* values, void* user) {
  auto& field = *static_cast<Field*>(user);
  ++field.calls;
  for (int64_t i = 0; i < n; ++i) values[i] = field.at(xyz[3 * i], xyz[3 * i + 1]);
  if (field.stop != nullptr) carreau_stop(field.stop);
  return field.status;
}

class Adaptation : public abi_tests::SessionTest {
 protected:
  void SetUp() override {
    SessionTest::SetUp();
    auto cad = abi_tests::sized<carreau_cad>();
    cad.surface_order = cad.curve_order = 2;
    cad.surface = plane;
    cad.curve_interval = interval;
    cad.curve = side;
    ASSERT_EQ(carreau_set_cad(session, &cad), CARREAU_OK);
    ASSERT_EQ(carreau_model_add_face(session, 1, 1), CARREAU_OK);
    for (int32_t ic = 1; ic <= 4; ++ic)
      ASSERT_EQ(carreau_model_add_curve(session, 1, CARREAU_BOUNDARY, ic, ic, ic % 4 + 1), CARREAU_OK);
    set("hphydef", 0.2);
    set("hphymin", 1e-3);
    folder = fs::temp_directory_path() / ("carreau adaptation " + std::to_string(std::random_device{}()));
    fs::create_directories(folder);
  }
  void TearDown() override {
    SessionTest::TearDown();
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }

  void set(const char* name, double value) { ASSERT_EQ(carreau_set_real(session, name, value), CARREAU_OK); }
  abi_tests::MeshData run() {
    EXPECT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
    EXPECT_EQ(abi_tests::defects_of(mesh()), "");
    return abi_tests::data_of(mesh());
  }
  carreau_background_report background_report() {
    auto report = abi_tests::sized<carreau_background_report>();
    EXPECT_EQ(carreau_session_background(session, &report), CARREAU_OK) << error();
    return report;
  }
  std::string file(const std::string& name, const std::string& text) {
    std::ofstream(folder / name) << text;
    return (folder / name).string();
  }
  /// A background mesh of the square, in two triangles.
  carreau_background square(int dimension) {
    auto b = abi_tests::sized<carreau_background>();
    b.dimension = dimension;
    b.vertex_count = 4;
    b.triangle_count = 2;
    b.vertices = dimension == 3 ? xyz : xy;
    b.triangles = triangles;
    return b;
  }
  carreau_adaptation adaptation(const carreau_estimator& estimator, Field& field) {
    auto a = abi_tests::sized<carreau_adaptation>();
    a.estimator = &estimator;
    a.field = evaluate;
    a.user = &field;
    return a;
  }

  const double xyz[12] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}, xy[8] = {-1, -1, 1, -1, 1, 1, -1, 1};
  const int32_t triangles[6] = {0, 1, 2, 0, 2, 3};
  fs::path folder;
};

/// The number of unit triangles that a density of sizes prescribes over the square: integral of dx dy / (h1 h2) over
/// sqrt(3) / 4.
double wanted(const std::function<double(double)>& h1h2_of_x) {
  double sum = 0;
  for (int i = 0; i < 1000; ++i) sum += 2 * 0.002 / h1h2_of_x(-1 + 0.002 * (i + 0.5));
  return sum / (std::sqrt(3.0) / 4);
}

TEST_F(Adaptation, SizesOfABackgroundMeshAreFollowed) {
  const double sizes[4] = {0.05, 0.2, 0.2, 0.05};
  for (const int dimension : {2, 3}) {
    carreau_background b = square(dimension);
    b.sizes = sizes;
    ASSERT_EQ(carreau_set_background(session, &b), CARREAU_OK) << error();
    const auto data = run();
    const double expected = wanted([](double x) { return std::pow(0.125 + 0.075 * x, 2); });
    EXPECT_NEAR(double(data.triangle_count()) / expected, 1, 0.08);
    for (std::size_t v = 0; v < data.vertex_count(); ++v)
      EXPECT_NEAR(data.sizes[v], 0.125 + 0.075 * data.xyz[3 * v], 0.012);
    EXPECT_GT(background_report().asked, 100);
    EXPECT_EQ(background_report().outside, 0);
  }
  const std::size_t with = run().triangle_count();
  ASSERT_EQ(carreau_clear_background(session), CARREAU_OK);
  EXPECT_LT(run().triangle_count(), with / 2);
  EXPECT_EQ(background_report().asked, 0);
}

// The square has sides of length 2; two of them have rows of heights .01, .012, ...
TEST_F(Adaptation, LayersGrowFromCurves) {
  const std::int32_t sides[1] = {1}, unknown[1] = {77};
  EXPECT_EQ(carreau_add_layers(nullptr, 1, sides, 0.01, 1.2, 8), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_add_layers(session, 1, nullptr, 0.01, 1.2, 8), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_add_layers(session, 0, sides, 0.01, 1.2, 8), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_add_layers(session, -1, sides, 0.01, 1.2, 8), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_add_layers(session, 1, sides, 0, 1.2, 8), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_add_layers(session, 1, sides, 0.01, 0.9, 8), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_add_layers(session, 1, sides, 0.01, 1.2, 0), CARREAU_ERR_ARGUMENT);
  auto report = abi_tests::sized<carreau_layers_report>();
  EXPECT_EQ(carreau_session_layers(session, 0, &report), CARREAU_ERR_SEQUENCE);
  ASSERT_EQ(carreau_add_layers(session, 1, sides, 0.01, 1.2, 8), CARREAU_OK) << error();
  (void)run();
  EXPECT_EQ(carreau_session_layers(session, 1, &report), CARREAU_ERR_ARGUMENT);
  ASSERT_EQ(carreau_session_layers(session, 0, &report), CARREAU_OK) << error();
  EXPECT_EQ(report.rows, 8);
  EXPECT_EQ(report.fewest_rows, 8);
  EXPECT_NEAR(report.first_min, 0.01, 1e-4);
  EXPECT_NEAR(report.first_max, 0.01, 1e-4);
  EXPECT_NEAR(report.growth_mean, 1.2, 1e-3);
  EXPECT_EQ(report.cells % 8, 0);
  ASSERT_EQ(carreau_clear_layers(session), CARREAU_OK);
  ASSERT_EQ(carreau_add_layers(session, 1, unknown, 0.01, 1.2, 8), CARREAU_OK);
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_ARGUMENT);
  EXPECT_NE(error().find("77"), std::string::npos) << error();
  ASSERT_EQ(carreau_clear_layers(session), CARREAU_OK);
}

// Sizes .02 + .36 (x + 1) from the side x = -1 of the square, up to .2 at x = -.5.
TEST_F(Adaptation, AttractorsPrescribeSizes) {
  const double vertices[6] = {-1, -1, 0, -1, 1, 0};
  const std::int32_t edge[3] = {0, 1, 1}, outside[3] = {0, 1, 2};
  EXPECT_EQ(carreau_add_attractor(nullptr, 2, vertices, 1, edge, 0.02, 0.2, 0.5), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_add_attractor(session, 2, vertices, 1, outside, 0.02, 0.2, 0.5), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_add_attractor(session, 2, nullptr, 1, edge, 0.02, 0.2, 0.5), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_add_attractor(session, 2, vertices, -1, edge, 0.02, 0.2, 0.5), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_add_attractor(session, 2, vertices, 1, edge, 0.3, 0.2, 0.5), CARREAU_ERR_ARGUMENT);
  const std::size_t without = run().triangle_count();
  ASSERT_EQ(carreau_add_attractor(session, 2, vertices, 1, edge, 0.02, 0.2, 0.5), CARREAU_OK) << error();
  const auto data = run();
  const double expected = wanted([](double x) { return std::pow(std::min(0.2, 0.02 + 0.36 * (x + 1)), 2); });
  EXPECT_NEAR(double(data.triangle_count()) / expected, 1, 0.15);
  for (std::size_t v = 0; v < data.vertex_count(); ++v)
    EXPECT_NEAR(data.sizes[v], std::min(0.2, 0.02 + 0.36 * (data.xyz[3 * v] + 1)), 0.02);
  ASSERT_EQ(carreau_clear_attractors(session), CARREAU_OK);
  EXPECT_EQ(run().triangle_count(), without);
}

// A cube around the square, in the five tetrahedra of a corner each and the tetrahedron between; sizes that are linear
// in x.
TEST_F(Adaptation, SizesOfTetrahedraAreFollowed) {
  const double corners[24] = {-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1, -1, -1, 1, 1, -1, 1, -1, 1, 1, 1, 1, 1};
  const int32_t tetrahedra[20] = {0, 1, 2, 4, 3, 2, 1, 7, 5, 4, 7, 1, 6, 7, 4, 2, 1, 2, 4, 7};
  double sizes[8];
  for (int v = 0; v < 8; ++v) sizes[v] = 0.1 + 0.05 * corners[3 * v];
  auto b = abi_tests::sized<carreau_background>();
  b.dimension = 3;
  b.vertex_count = 8, b.vertices = corners, b.sizes = sizes;
  b.tetrahedron_count = 5, b.tetrahedra = tetrahedra;
  ASSERT_EQ(carreau_set_background(session, &b), CARREAU_OK) << error();
  const auto data = run();
  EXPECT_NEAR(double(data.triangle_count()) / wanted([](double x) { return std::pow(0.1 + 0.05 * x, 2); }), 1, 0.05);
  EXPECT_GT(background_report().asked, 100);
  EXPECT_EQ(background_report().outside, 0);
}

// Sizes along the border alone, linear in x: so they are inside.
TEST_F(Adaptation, SizesOfEdgesOfCurvesAreInterpolatedInFaces) {
  const double sizes[4] = {0.05, 0.15, 0.15, 0.05};
  const int32_t edges[8] = {0, 1, 1, 2, 2, 3, 3, 0};
  for (const int dimension : {2, 3}) {
    carreau_background b = square(dimension);
    b.triangle_count = 0, b.triangles = nullptr;
    b.edge_count = 4, b.edges = edges, b.sizes = sizes;
    ASSERT_EQ(carreau_set_background(session, &b), CARREAU_OK) << error();
    EXPECT_NEAR(double(run().triangle_count()) / wanted([](double x) { return std::pow(0.1 + 0.05 * x, 2); }), 1, 0.05);
    EXPECT_EQ(background_report().outside, 0);
  }
}

TEST_F(Adaptation, MetricsOfABackgroundMeshAreFollowed) {
  // Sizes 0.03 and 0.3, turned by 30 degrees.
  const double c = std::cos(0.5235987755982988), s = std::sin(0.5235987755982988), p = 1 / 0.0009, q = 1 / 0.09;
  const double xx = p * c * c + q * s * s, xy_ = (p - q) * c * s, yy = p * s * s + q * c * c;
  std::vector<double> space, parameter;
  for (int i = 0; i < 4; ++i) {
    space.insert(space.end(), {xx, xy_, 0, yy, 0, 100});
    parameter.insert(parameter.end(), {xx, xy_, yy});
  }
  for (const int dimension : {2, 3}) {
    carreau_background b = square(dimension);
    b.metrics = dimension == 2 ? parameter.data() : space.data();
    ASSERT_EQ(carreau_set_background(session, &b), CARREAU_OK) << error();
    const auto data = run();
    EXPECT_NEAR(double(data.triangle_count()) / wanted([](double) { return 0.009; }), 1, 0.1);
    double sum = 0;
    for (std::size_t t = 0; t < data.triangles.size(); ++t) {
      const auto from = std::size_t(data.triangles[t]), to = std::size_t(data.triangles[t % 3 == 2 ? t - 2 : t + 1]);
      const double dx = data.xyz[3 * to] - data.xyz[3 * from], dy = data.xyz[3 * to + 1] - data.xyz[3 * from + 1];
      sum += std::sqrt(xx * dx * dx + 2 * xy_ * dx * dy + yy * dy * dy);
    }
    EXPECT_NEAR(sum / double(data.triangles.size()), 1, 0.05) << "mean length of edges in the metric";
  }
}

TEST_F(Adaptation, FilesAreReadAndTheirErrorsName) {
  set("hphydef", 0.5);
  run();
  const std::string mesh_path = (folder / "old.mesh").string();
  ASSERT_EQ(carreau_mesh_write(mesh(), mesh_path.c_str()), CARREAU_OK);
  const std::size_t n = abi_tests::data_of(mesh()).vertex_count();
  const auto sol = [&](std::size_t count, const std::string& type, const std::string& value, int dimension = 3) {
    std::string text = "MeshVersionFormatted 2\nDimension " + std::to_string(dimension) + "\nSolAtVertices\n" +
                       std::to_string(count) + "\n" + type + "\n";
    for (std::size_t i = 0; i < count; ++i) text += value + "\n";
    return file("x.sol", text + "End\n");
  };
  const auto set_files = [&](const std::string& path) {
    return carreau_set_background_mesh(session, mesh_path.c_str(), path.c_str());
  };
  ASSERT_EQ(set_files(sol(n, "1 1", "0.1")), CARREAU_OK) << error();
  EXPECT_NEAR(double(run().triangle_count()) / wanted([](double) { return 0.01; }), 1, 0.1);
  // A wrong file leaves the background mesh as it was.
  const std::string path = (folder / "x.sol").string();
  EXPECT_EQ(set_files(sol(n + 1, "1 1", "0.1")), CARREAU_ERR_FILE);
  EXPECT_EQ(error(), path + ": it has values at " + std::to_string(n + 1) + " vertices, but " + mesh_path + " has " +
                         std::to_string(n));
  EXPECT_EQ(set_files(sol(n, "1 2", "0.1 0 0")), CARREAU_ERR_FILE);
  EXPECT_NE(error().find("x.sol, line 5: the values are vectors"), std::string::npos) << error();
  EXPECT_EQ(set_files(sol(n, "1 1", "nan")), CARREAU_ERR_FILE);
  EXPECT_NE(error().find("x.sol, line 6: a value is not finite"), std::string::npos) << error();
  EXPECT_EQ(set_files(sol(n, "1 3", "1 2 1 0 0 1")), CARREAU_ERR_FILE);
  EXPECT_NE(error().find("x.sol, line 6: vertex 1 has a metric that is not positive definite"), std::string::npos);
  EXPECT_EQ(set_files(sol(n, "1 1", "0.1", 2)), CARREAU_ERR_FILE);
  EXPECT_NE(error().find("its dimension is 2"), std::string::npos) << error();
  EXPECT_EQ(set_files((folder / "none.sol").string()), CARREAU_ERR_FILE);
  const std::string empty = file("empty.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices 0\nTriangles 0\nEnd\n");
  sol(0, "1 1", "1");
  EXPECT_EQ(carreau_set_background_mesh(session, empty.c_str(), path.c_str()), CARREAU_ERR_FILE);
  EXPECT_EQ(error(), empty + ": a background mesh needs triangles, tetrahedra or edges; it has none");
  EXPECT_EQ(carreau_set_background_mesh(session, nullptr, path.c_str()), CARREAU_ERR_ARGUMENT);
  EXPECT_NEAR(double(run().triangle_count()) / wanted([](double) { return 0.01; }), 1, 0.1);
}

TEST_F(Adaptation, ParametersNameFilesAndEnvFilesFindThemBesideThem) {
  file("b.mesh",
       "MeshVersionFormatted 2\nDimension 2\nVertices 4\n-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\nTriangles 2\n"
       "1 2 3 1\n1 3 4 1\nEnd\n");
  file("b.sol", "MeshVersionFormatted 2\nDimension 2\nSolAtVertices 4\n1 1\n0.1 0.1 0.1 0.1\nEnd\n");
  const std::string env = file("blsurf.env",
                               "background_mesh b.mesh background_sol b.sol\ncall inimesh\n"
                               "background_mesh b.mesh\ncall inimesh\n");
  // The second action forgets one of the two.
  EXPECT_EQ(carreau_run_env(session, env.c_str()), CARREAU_ERR_ARGUMENT);
  EXPECT_NE(error().find("background_mesh and background_sol name two files of one field, but only background_mesh"),
            std::string::npos)
      << error();
  EXPECT_NEAR(double(abi_tests::data_of(mesh()).triangle_count()) / wanted([](double) { return 0.01; }), 1, 0.1);
  EXPECT_GT(background_report().asked, 100);
}

TEST_F(Adaptation, AnActionOfEnvFilesAdaptsToAFieldOfAFile) {
  // y^2 on a grid: size sqrt(4.5 tolerance / 2) across, the largest one along (HDR eq. 3.3).
  const int n = 20;
  std::string points = "Vertices " + std::to_string((n + 1) * (n + 1)) + "\n", values, triangles_text;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = -1 + 2.0 * i / n, y = -1 + 2.0 * j / n;
      points += std::to_string(x) + " " + std::to_string(y) + " 0\n";
      values += std::to_string(y * y) + "\n";
      const int at = j * (n + 1) + i + 1;
      if (i < n && j < n)
        triangles_text += std::to_string(at) + " " + std::to_string(at + 1) + " " + std::to_string(at + n + 2) +
                          " 1\n" + std::to_string(at) + " " + std::to_string(at + n + 2) + " " +
                          std::to_string(at + n + 1) + " 1\n";
    }
  const std::string head = "MeshVersionFormatted 2\nDimension 2\n";
  file("f.mesh", head + points + "Triangles " + std::to_string(2 * n * n) + "\n" + triangles_text + "End\n");
  file("f.sol", head + "SolAtVertices " + std::to_string((n + 1) * (n + 1)) + "\n1 1\n" + values + "End\n");
  const auto env = [&](const std::string& text) { return file("blsurf.env", text + "\ncall adapt\n"); };
  const std::string good =
      "adapt_mesh f.mesh adapt_sol f.sol adapt_shape anisotropic adapt_tolerance 0.01\nadapt_hmin 0.01 adapt_hmax 0.45 "
      "adapt_out moved.sol hphymin 0.01 hphymax 1";
  ASSERT_EQ(carreau_run_env(session, env(good).c_str()), CARREAU_OK) << error();
  const auto data = abi_tests::data_of(mesh());
  EXPECT_NEAR(double(data.triangle_count()) / wanted([](double) { return 0.15 * 0.45; }), 1, 0.2);
  // The field on the new mesh is its linear interpolation: not below y^2, and not farther above than an old edge
  // allows.
  std::ifstream moved(folder / "moved.sol");
  std::string word;
  while (moved >> word && word != "SolAtVertices") {
  }
  std::size_t count = 0;
  int one = 0, type = 0;
  moved >> count >> one >> type;
  ASSERT_EQ(count, data.vertex_count());
  for (std::size_t v = 0; v < count; ++v) {
    double value = 0;
    moved >> value;
    const double y = data.xyz[3 * v + 1];
    EXPECT_GE(value, y * y - 1e-6);
    EXPECT_LE(value, y * y + 0.0025 + 1e-6);
  }
  // Once more, on the mesh that was made, with its own field.
  std::string again = "MeshVersionFormatted 2\nDimension 3\nSolAtVertices " + std::to_string(count) + "\n1 1\n";
  for (std::size_t v = 0; v < count; ++v) again += std::to_string(std::pow(data.xyz[3 * v], 2)) + "\n";
  file("g.sol", again + "End\n");
  ASSERT_EQ(carreau_run_env(session, env("adapt_sol g.sol adapt_hmax 0.5 adapt_hmin 0.1").c_str()), CARREAU_OK)
      << error();
  EXPECT_NEAR(double(abi_tests::data_of(mesh()).triangle_count()) / wanted([](double) { return 0.0225; }), 1, 0.25);
  EXPECT_EQ(background_report().outside, 0);
  EXPECT_EQ(carreau_run_env(session, env("adapt_mesh f.mesh").c_str()), CARREAU_ERR_ARGUMENT);
  EXPECT_NE(error().find("adapt_sol names no file"), std::string::npos) << error();
  EXPECT_EQ(carreau_run_env(session, env("adapt_sol f.sol").c_str()), CARREAU_ERR_FILE);
  EXPECT_NE(error().find("but the mesh made last has"), std::string::npos) << error();
  EXPECT_EQ(carreau_run_env(session, env("adapt_mesh f.mesh adapt_sol f.mesh").c_str()), CARREAU_ERR_FILE);
}

TEST_F(Adaptation, PointsOutsideAreCounted) {
  carreau_background b = square(2);
  const double half[8] = {-1, -1, 0, -1, 0, 1, -1, 1}, sizes[4] = {0.1, 0.1, 0.1, 0.1};
  b.vertices = half;
  b.sizes = sizes;
  ASSERT_EQ(carreau_set_background(session, &b), CARREAU_OK);
  EXPECT_NEAR(double(run().triangle_count()) / wanted([](double) { return 0.01; }), 1, 0.1);
  const carreau_background_report report = background_report();
  EXPECT_GT(report.outside, report.asked / 5);
  EXPECT_LT(report.outside, report.asked);
  EXPECT_NEAR(report.farthest, 1, 1e-12);
}

TEST_F(Adaptation, SizesAreHandedBackOnTheSessionsMesh) {
  const auto first = run();
  std::vector<double> sizes(first.vertex_count(), 0.05), metrics;
  for (std::size_t v = 0; v < first.vertex_count(); ++v) metrics.insert(metrics.end(), {400, 0, 0, 25, 0, 400});
  const auto n = int64_t(first.vertex_count());
  EXPECT_EQ(carreau_set_vertex_sizes(session, n - 1, sizes.data()), CARREAU_ERR_ARGUMENT);
  ASSERT_EQ(carreau_set_vertex_sizes(session, n, sizes.data()), CARREAU_OK) << error();
  EXPECT_NEAR(double(run().triangle_count()) / wanted([](double) { return 0.0025; }), 1, 0.06);
  std::vector<double> bad = metrics;
  bad.resize(6 * abi_tests::data_of(mesh()).vertex_count(), 1);
  EXPECT_EQ(carreau_set_vertex_metrics(session, int64_t(bad.size() / 6), bad.data()), CARREAU_ERR_ARGUMENT);
  EXPECT_NE(error().find("has a metric that is not positive definite"), std::string::npos) << error();
  ASSERT_EQ(carreau_clear_background(session), CARREAU_OK);
  run();
  ASSERT_EQ(carreau_set_vertex_metrics(session, n, metrics.data()), CARREAU_OK) << error();
  EXPECT_NEAR(double(run().triangle_count()) / wanted([](double) { return 0.05 * 0.2; }), 1, 0.1);
}

TEST_F(Adaptation, FieldsAreTransferredFromTheMeshBefore) {
  double value = 0;
  EXPECT_EQ(carreau_transfer(session, 1, 1, &value, 1, &value, nullptr), CARREAU_ERR_SEQUENCE);
  const auto old = run();
  EXPECT_EQ(carreau_transfer(session, 1, int64_t(old.vertex_count()), old.xyz.data(), 1, &value, nullptr),
            CARREAU_ERR_SEQUENCE);
  EXPECT_EQ(error(), "there is no mesh before this one: fields are transferred from it");
  set("hphydef", 0.07);
  const auto now = run();
  // Coordinates are a linear field: the interpolation is exact.
  std::vector<double> moved(now.xyz.size());
  int64_t outside = -1;
  ASSERT_EQ(carreau_transfer(session, 3, int64_t(old.vertex_count()), old.xyz.data(), int64_t(now.vertex_count()),
                             moved.data(), &outside),
            CARREAU_OK)
      << error();
  EXPECT_EQ(outside, 0);
  for (std::size_t i = 0; i < moved.size(); ++i) EXPECT_NEAR(moved[i], now.xyz[i], 1e-14);
  EXPECT_EQ(carreau_transfer(session, 3, int64_t(old.vertex_count()), old.xyz.data(), 1, moved.data(), nullptr),
            CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_transfer(session, 3, 7, old.xyz.data(), int64_t(now.vertex_count()), moved.data(), nullptr),
            CARREAU_ERR_ARGUMENT);
  EXPECT_NE(error().find("mesh before this one"), std::string::npos) << error();
}

TEST_F(Adaptation, EstimatesOfAQuadraticAreExact) {
  const auto data = run();
  const auto n = int64_t(data.vertex_count());
  std::vector<double> values, sizes(data.vertex_count()), metrics(6 * data.vertex_count());
  for (std::size_t v = 0; v < data.vertex_count(); ++v) {
    const double x = data.xyz[3 * v], y = data.xyz[3 * v + 1];
    values.push_back(2 * x * x + 0.5 * y * y);
  }
  auto estimator = abi_tests::sized<carreau_estimator>();
  estimator.tolerance = 0.01;
  estimator.hmin = 1e-3, estimator.hmax = 10;
  ASSERT_EQ(carreau_estimate(session, &estimator, n, values.data(), sizes.data(), nullptr), CARREAU_OK) << error();
  for (const double h : sizes) EXPECT_NEAR(h, std::sqrt(4.5 * 0.01 / 4), 1e-8);  // 2/9 M h^2 (HDR eq. 3.3)
  estimator.shape = CARREAU_ANISOTROPIC;
  EXPECT_EQ(carreau_estimate(session, &estimator, n, values.data(), sizes.data(), nullptr), CARREAU_ERR_ARGUMENT);
  ASSERT_EQ(carreau_estimate(session, &estimator, n, values.data(), sizes.data(), metrics.data()), CARREAU_OK);
  for (std::size_t v = 0; v < sizes.size(); ++v) {
    EXPECT_NEAR(metrics[6 * v], 4 / 0.045, 1e-5);
    EXPECT_NEAR(metrics[6 * v + 1], 0, 1e-5);
    EXPECT_NEAR(metrics[6 * v + 3], 1 / 0.045, 1e-5);
    EXPECT_NEAR(sizes[v], std::sqrt(0.045 / 4), 1e-8);
  }
  estimator.source = 3;
  EXPECT_EQ(carreau_estimate(session, &estimator, n, values.data(), sizes.data(), metrics.data()),
            CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(error(), "estimator->source is 3; it must be 0, 1 or 2");
}

// The graph of z is a sphere of radius 2: circles of radius 2 R sin(8 degrees) in its tangent planes are ellipses of the plane, whose short
// axes have that length times z / R (HDR sec. 3.4.3 a.2).
TEST_F(Adaptation, QuadricsFindTheCurvatureOfASphere) {
  set("hphydef", 0.1);
  const auto data = run();
  const auto n = int64_t(data.vertex_count());
  std::vector<double> values, sizes(data.vertex_count()), fitted(data.vertex_count()), metrics(6 * data.vertex_count());
  for (std::size_t v = 0; v < data.vertex_count(); ++v)
    values.push_back(std::sqrt(4 - std::pow(data.xyz[3 * v], 2) - std::pow(data.xyz[3 * v + 1], 2)));
  auto estimator = abi_tests::sized<carreau_estimator>();
  estimator.source = CARREAU_CURVATURE, estimator.shape = CARREAU_GRAPH, estimator.tolerance = 8;
  estimator.hmin = 1e-3, estimator.hmax = 10;
  estimator.recovery = CARREAU_QUADRIC;
  ASSERT_EQ(carreau_estimate(session, &estimator, n, values.data(), sizes.data(), metrics.data()), CARREAU_OK) << error();
  estimator.recovery = CARREAU_FIT;
  ASSERT_EQ(carreau_estimate(session, &estimator, n, values.data(), fitted.data(), metrics.data()), CARREAU_OK) << error();
  EXPECT_NE(sizes, fitted);
  double sum = 0, worst = 0, count = 0;
  for (std::size_t v = 0; v < values.size(); ++v) {
    if (std::max(std::abs(data.xyz[3 * v]), std::abs(data.xyz[3 * v + 1])) > 0.8) continue;
    const double ratio = sizes[v] / (2 * std::sin(8 * std::numbers::pi / 180) * values[v]);
    sum += ratio, worst = std::max(worst, std::abs(ratio - 1)), ++count;
  }
  EXPECT_NEAR(sum / count, 1, 0.1);
  EXPECT_LT(worst, 0.3);
  estimator.recovery = 3;
  EXPECT_EQ(carreau_estimate(session, &estimator, n, values.data(), sizes.data(), metrics.data()), CARREAU_ERR_ARGUMENT);
}

// A file of values at all nodes of the mesh that was made last.
TEST_F(Adaptation, ElementsOfSecondOrderAreAdaptedByValuesAtAllTheirNodes) {
  for (const char* element : {"p2", "q2.0", "q2.1"}) {
    set("hphydef", 0.2);
    ASSERT_EQ(carreau_set_text(session, "element", element), CARREAU_OK);
    const auto before = run();
    const auto n = before.vertex_count();
    std::vector<double> values, sizes(n);
    std::string text = "MeshVersionFormatted 2\nDimension 3\nSolAtVertices " + std::to_string(n) + "\n1 1\n";
    for (std::size_t v = 0; v < n; ++v) {
      values.push_back(std::pow(before.xyz[3 * v], 2));
      text += std::to_string(values.back()) + "\n";
    }
    file("p.sol", text + "End\n");
    auto estimator = abi_tests::sized<carreau_estimator>();
    estimator.tolerance = 0.01, estimator.hmin = 1e-3, estimator.hmax = 10;
    ASSERT_EQ(carreau_estimate(session, &estimator, int64_t(n), values.data(), sizes.data(), nullptr), CARREAU_OK) << error();
    for (const double h : sizes) EXPECT_NEAR(h, std::sqrt(4.5 * 0.01 / 2), 1e-7) << element;
    const std::string env =
        std::string("element ") + element +
        " adapt_sol p.sol adapt_out moved.sol adapt_tolerance 0.005 adapt_hmin 0.01 adapt_hmax 1\ncall adapt\n";
    ASSERT_EQ(carreau_run_env(session, file("blsurf.env", env).c_str()), CARREAU_OK) << element << error();
    const auto now = abi_tests::data_of(mesh());
    // All edges have the prescribed length between straight nodes, 0.106, and values at all nodes agree with the field.
    EXPECT_NEAR(double(now.triangle_count()) / wanted([](double) { return 4.5 * 0.005 / 2; }), 1, 0.25) << element;
    std::ifstream moved(folder / "moved.sol");
    std::string word;
    while (moved >> word && word != "SolAtVertices") {
    }
    std::size_t count = 0;
    int one = 0, type = 0;
    moved >> count >> one >> type;
    ASSERT_EQ(count, now.vertex_count()) << element;
    EXPECT_GT(count, now.triangle_count());  // there are nodes on edges
    for (std::size_t v = 0; v < count; ++v) {
      double value = 0;
      moved >> value;
      EXPECT_NEAR(value, std::pow(now.xyz[3 * v], 2), 2e-3) << element;  // Q2 on cells that are no parallelograms
    }
  }
}

TEST_F(Adaptation, SizesAtAllNodesAreFollowed) {
  ASSERT_EQ(carreau_set_text(session, "element", "p2"), CARREAU_OK);
  const auto before = run();
  std::vector<double> sizes;
  for (std::size_t v = 0; v < before.vertex_count(); ++v) sizes.push_back(0.15 + 0.05 * before.xyz[3 * v]);
  ASSERT_EQ(carreau_set_vertex_sizes(session, int64_t(sizes.size()), sizes.data()), CARREAU_OK) << error();
  const auto now = run();
  EXPECT_NEAR(double(now.triangle_count()) / wanted([](double x) { return std::pow(0.15 + 0.05 * x, 2); }), 1, 0.1);
  EXPECT_EQ(background_report().outside, 0);
  EXPECT_EQ(carreau_set_vertex_sizes(session, int64_t(now.vertex_count()) - 1, sizes.data()), CARREAU_ERR_ARGUMENT);
  EXPECT_NE(error().find("nodes with those on edges"), std::string::npos) << error();
}

// For a cubic the error falls by eight a halving of elements of second order, by four of straight ones.
TEST_F(Adaptation, TheLoopMeasuresCurvedElementsByTheirShapeFunctions) {
  Field field{[](double x, double) { return x * x * x; }};
  std::map<std::string, std::array<double, 2>> errors;
  for (const char* element : {"p1", "p2"})
    for (const int k : {0, 1}) {
      ASSERT_EQ(carreau_set_text(session, "element", element), CARREAU_OK);
      const double h = k == 0 ? 0.2 : 0.1;
      auto estimator = abi_tests::sized<carreau_estimator>();
      estimator.hmin = h, estimator.hmax = h * (1 + 1e-9);  // the bounds determine the size
      carreau_adaptation a = adaptation(estimator, field);
      a.iterations = 1;
      auto report = abi_tests::sized<carreau_adaptation_report>();
      ASSERT_EQ(carreau_adapt(session, &a, &report), CARREAU_OK) << error();
      EXPECT_EQ(report.vertices, int64_t(abi_tests::data_of(mesh()).vertex_count()));
      errors[element][k] = report.error_rms;
    }
  EXPECT_NEAR(std::log2(errors["p1"][0] / errors["p1"][1]), 2, 0.35);
  EXPECT_NEAR(std::log2(errors["p2"][0] / errors["p2"][1]), 3, 0.35);
}

TEST_F(Adaptation, TheLoopHalvesTheErrorWithTheTolerance) {
  Field field{[](double x, double y) { return std::tanh(10 * (y - 0.3 * std::sin(3 * x))); }};
  double before = 0;
  for (const bool differences : {true, false})
    for (const double tolerance : {0.04, 0.01}) {
      auto estimator = abi_tests::sized<carreau_estimator>();
      estimator.shape = CARREAU_ANISOTROPIC;
      estimator.tolerance = tolerance;
      estimator.hmin = 1e-3, estimator.hmax = 0.5, estimator.ratio = 20;
      carreau_adaptation a = adaptation(estimator, field);
      a.iterations = 4;
      a.differences = differences;
      auto report = abi_tests::sized<carreau_adaptation_report>();
      ASSERT_EQ(carreau_adapt(session, &a, &report), CARREAU_OK) << error();
      EXPECT_EQ(abi_tests::defects_of(mesh()), "");
      EXPECT_EQ(report.iterations, 4);
      EXPECT_EQ(report.converged, 0);
      EXPECT_EQ(report.triangles, int64_t(abi_tests::data_of(mesh()).triangle_count()));
      EXPECT_LT(report.error_rms, tolerance);
      EXPECT_GT(report.stretch_max, 2);
      if (tolerance < 0.02) {
        EXPECT_LT(report.error_rms, before / 2);
      }
      before = report.error_rms;
    }
}

// A bump between coarse triangles: no mesh of the loop loses it, wherever it is.
TEST_F(Adaptation, BumpsAmidLargeSizesAreNotLost) {
  for (const double x0 : {0.0, 0.0371, 0.253}) {
    Field field{[x0](double x, double y) { return std::exp(-100 * ((x - x0) * (x - x0) + y * y)); }};
    auto estimator = abi_tests::sized<carreau_estimator>();
    estimator.shape = CARREAU_ANISOTROPIC;
    estimator.tolerance = 0.01;
    estimator.hmin = 0.004;
    carreau_adaptation a = adaptation(estimator, field);
    a.iterations = 1;
    a.differences = 1;
    for (int i = 0; i < 6; ++i) {
      auto report = abi_tests::sized<carreau_adaptation_report>();
      ASSERT_EQ(carreau_adapt(session, &a, &report), CARREAU_OK) << error();
      EXPECT_LT(report.error_rms, estimator.tolerance) << x0 << ", mesh " << i;
      EXPECT_LT(report.error_max, 10 * estimator.tolerance) << x0 << ", mesh " << i;
    }
  }
}

// A front twenty times as steep as high, of the kind of HDR eq. 4.95. Between its wall and the plains around it sizes
// jump, and neighbours beyond a bend hide it: with a gradation values alone lead to the meshes of the field's own
// derivatives.
TEST_F(Adaptation, SteepFrontsAreFoundFromValuesAloneWithAGradation) {
  set("gradation", 2);
  Field field{[](double x, double y) { return std::tanh((0.5 * std::sin(3 * x) - y) / 0.05); }};
  for (const int32_t shape : {CARREAU_GRAPH, CARREAU_ANISOTROPIC}) {
    carreau_adaptation_report reports[2];
    for (const int32_t differences : {0, 1}) {
      auto estimator = abi_tests::sized<carreau_estimator>();
      estimator.source = CARREAU_CURVATURE;
      estimator.shape = shape;
      estimator.tolerance = 8;
      estimator.hmin = 0.004, estimator.hmax = 0.4;
      carreau_adaptation a = adaptation(estimator, field);
      a.iterations = 7;
      a.differences = differences;
      ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
      reports[differences] = abi_tests::sized<carreau_adaptation_report>();
      ASSERT_EQ(carreau_adapt(session, &a, &reports[differences]), CARREAU_OK) << error();
    }
    EXPECT_NEAR(double(reports[0].triangles) / double(reports[1].triangles), 1, 0.15) << shape;
    EXPECT_LT(reports[0].error_rms, 1.2 * reports[1].error_rms) << shape;
  }
}

// A front tanh(k x), k = 10, bends by at most 4 k^2 / (3 sqrt 3), so the interpolation error on triangles of edges h, one direction of
// bending, is at most that times h^2 / 6.
TEST_F(Adaptation, TheFirstMeshWithinTheToleranceEndsTheLoop) {
  constexpr double k = 10, h = 0.03;
  Field field{[](double x, double) { return std::tanh(k * (x - 0.3)); }};
  auto estimator = abi_tests::sized<carreau_estimator>();
  estimator.hmin = h, estimator.hmax = h * (1 + 1e-9);  // the bounds determine the size
  const double bound = 4 * k * k / (3 * std::sqrt(3)) * h * h / 6;
  estimator.tolerance = 2 * bound;  // edges are up to sqrt 2 longer than h
  carreau_adaptation a = adaptation(estimator, field);
  auto report = abi_tests::sized<carreau_adaptation_report>();
  ASSERT_EQ(carreau_adapt(session, &a, &report), CARREAU_OK) << error();
  EXPECT_EQ(report.iterations, 1);
  EXPECT_EQ(report.best, 1);
  EXPECT_EQ(report.within, 1);
  EXPECT_EQ(report.tolerance, estimator.tolerance);
  EXPECT_EQ(report.estimated_error, report.error_max);
  EXPECT_LE(report.estimated_error, report.tolerance);
  EXPECT_GT(report.estimated_error, 0.5 * bound);
  // A mesh is always made, and a share of the field's value is another scale: here it is 1 / 200 of the error to within 1 %.
  field.at = [](double x, double) { return 200 + std::tanh(k * (x - 0.3)); };
  estimator.relative = 1, estimator.tolerance = 1;
  ASSERT_EQ(carreau_adapt(session, &a, &report), CARREAU_OK) << error();
  EXPECT_EQ(report.iterations, 1);
  EXPECT_NEAR(200 * report.estimated_error / report.error_max, 1, 0.01);
}

// Meshes of single steps: the loop over all of them returns the best.
TEST_F(Adaptation, TheBestMeshOfTheLoopIsReturned) {
  Field field{[](double x, double y) { return std::tanh(20 * (y - x * x / 2)); }};
  auto estimator = abi_tests::sized<carreau_estimator>();
  estimator.shape = CARREAU_ANISOTROPIC;
  estimator.tolerance = 1e-9;  // out of reach
  estimator.hmin = 0.02, estimator.hmax = 0.4;
  carreau_adaptation a = adaptation(estimator, field);
  auto report = abi_tests::sized<carreau_adaptation_report>();
  const auto start = run();
  a.iterations = 1;
  std::vector<double> errors;
  std::vector<std::vector<double>> meshes;
  constexpr int steps = 5;
  for (int i = 0; i < steps; ++i) {
    ASSERT_EQ(carreau_adapt(session, &a, &report), CARREAU_OK) << error();
    errors.push_back(report.estimated_error);
    meshes.push_back(abi_tests::data_of(mesh()).xyz);
  }
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  ASSERT_EQ(abi_tests::data_of(mesh()).xyz, start.xyz);
  bool last_is_best = true;
  for (int n = 1; n <= steps; ++n) {
    ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
    a.iterations = n;
    ASSERT_EQ(carreau_adapt(session, &a, &report), CARREAU_OK) << error();
    const auto best = std::min_element(errors.begin(), errors.begin() + n) - errors.begin();
    last_is_best = last_is_best && best == n - 1;
    EXPECT_EQ(report.iterations, n);
    EXPECT_EQ(report.best, best + 1);
    EXPECT_EQ(report.within, 0);
    EXPECT_EQ(report.estimated_error, errors[std::size_t(best)]);
    EXPECT_EQ(abi_tests::data_of(mesh()).xyz, meshes[std::size_t(best)]);
    EXPECT_EQ(report.vertices, int64_t(meshes[std::size_t(best)].size() / 3));
    EXPECT_EQ(abi_tests::defects_of(mesh()), "");
    auto delivered = abi_tests::sized<carreau_delivered>();
    EXPECT_EQ(carreau_session_delivered(session, &delivered), CARREAU_OK) << error();
  }
  EXPECT_FALSE(last_is_best);
}

TEST_F(Adaptation, TheLoopEndsWhenTheMeshNoLongerChanges) {
  // The size is the same everywhere: one mesh, and one to see it.
  Field field{[](double x, double y) { return x * x + y * y; }};
  auto estimator = abi_tests::sized<carreau_estimator>();
  estimator.tolerance = 0.01;
  estimator.hmin = 0.01, estimator.hmax = 1;
  carreau_adaptation a = adaptation(estimator, field);
  a.convergence = 0.05;
  a.iterations = 10;
  auto report = abi_tests::sized<carreau_adaptation_report>();
  ASSERT_EQ(carreau_adapt(session, &a, &report), CARREAU_OK) << error();
  EXPECT_EQ(report.converged, 1);
  EXPECT_LE(report.iterations, 3);
  const double h = std::sqrt(4.5 * 0.01 / 2);
  EXPECT_NEAR(report.size_min, h, 1e-6);
  EXPECT_NEAR(double(report.triangles) / wanted([h](double) { return h * h; }), 1, 0.1);
  // 2/9 M h^2 bounds the error on triangles of edges h; the worst of a real mesh are a little larger.
  EXPECT_LT(report.error_max, 1.5 * 0.01);
  EXPECT_GT(report.error_max, 0.5 * 0.01);
}

TEST_F(Adaptation, FailuresOfTheFieldEndTheLoop) {
  Field field{[](double x, double) { return x; }};
  const auto estimator = abi_tests::sized<carreau_estimator>();
  carreau_adaptation a = adaptation(estimator, field);
  field.status = 17;
  EXPECT_EQ(carreau_adapt(session, &a, nullptr), CARREAU_ERR_CALLBACK);
  EXPECT_EQ(error(), "the callback of the field returned the status 17");
  field.status = 0;
  field.at = [](double x, double) { return x > 0.5 ? std::nan("") : x; };
  EXPECT_EQ(carreau_adapt(session, &a, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_NE(error().find("nan"), std::string::npos) << error();
  // Squares of such curvatures overflow.
  for (const int differences : {0, 1}) {
    a.differences = differences;
    field.at = [](double x, double) { return 1e200 * x * x; };
    EXPECT_EQ(carreau_adapt(session, &a, nullptr), CARREAU_ERR_ARGUMENT);
    EXPECT_NE(error().find("values up to 1e+100 can be used"), std::string::npos) << error();
  }
  a.differences = 0;
  field.at = [](double x, double) { return x; };
  field.stop = session;
  EXPECT_EQ(carreau_adapt(session, &a, nullptr), CARREAU_ERR_CANCELLED);
  field.stop = nullptr;
  EXPECT_EQ(carreau_adapt(session, &a, nullptr), CARREAU_OK) << error();
  a.field = nullptr;
  EXPECT_EQ(carreau_adapt(session, &a, nullptr), CARREAU_ERR_ARGUMENT);
  a.field = evaluate;
  a.iterations = -1;
  EXPECT_EQ(carreau_adapt(session, &a, nullptr), CARREAU_ERR_ARGUMENT);
  a.iterations = 1;
  ASSERT_EQ(carreau_set_integer(session, "hphy_flag", 0), CARREAU_OK);
  ASSERT_EQ(carreau_set_integer(session, "hgeo_flag", 1), CARREAU_OK);
  EXPECT_EQ(carreau_adapt(session, &a, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_NE(error().find("hphy_flag is 0"), std::string::npos) << error();
}

TEST_F(Adaptation, WrongBackgroundMeshesAreRejected) {
  const double sizes[4] = {0.1, 0.1, 0.1, 0.1};
  const auto refused = [&](const carreau_background& b) {
    EXPECT_EQ(carreau_set_background(session, &b), CARREAU_ERR_ARGUMENT);
    return error();
  };
  EXPECT_NE(refused(square(3)).find("either sizes or metrics"), std::string::npos);
  carreau_background b = square(3);
  b.sizes = sizes;
  b.triangle_count = 0;
  EXPECT_EQ(refused(b), "the background mesh has no triangle, no tetrahedron and no edge");
  b.edge_count = 1;
  EXPECT_EQ(refused(b), "the argument background->edges is NULL");
  b.edge_count = 0;
  b.tetrahedron_count = -2;
  EXPECT_NE(refused(b).find("background->tetrahedron_count is -2"), std::string::npos);
  b = square(3);
  b.sizes = sizes;
  b.dimension = 4;
  EXPECT_EQ(refused(b), "background->dimension is 4; it must be 2 or 3");
  b = square(3);
  b.sizes = sizes;
  b.vertex_count = 3;
  EXPECT_NE(refused(b).find("names vertex 3, but there are 3"), std::string::npos);
  const double negative[4] = {0.1, -0.1, 0.1, 0.1};
  b = square(3);
  b.sizes = negative;
  EXPECT_NE(refused(b).find("vertex 1 (from 0) has the size -0.1"), std::string::npos);
  b.vertex_count = -1;
  EXPECT_NE(refused(b).find("background->vertex_count is -1"), std::string::npos);
  EXPECT_EQ(carreau_set_background(session, nullptr), CARREAU_ERR_ARGUMENT);
}

class AdaptationOfATorus : public abi_tests::SessionTest {
 protected:
  void SetUp() override {
    SessionTest::SetUp();
    const carreau_cad cad = torus_cad(&host);
    ASSERT_EQ(carreau_set_cad(session, &cad), CARREAU_OK);
    ASSERT_EQ(torus_model(session), CARREAU_OK);
    ASSERT_EQ(carreau_set_real(session, "hphydef", 0.3), CARREAU_OK);
    ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
    old = abi_tests::data_of(mesh());
    for (std::size_t v = 0; v < old.vertex_count(); ++v) sizes.push_back(size_at(old.xyz[3 * v + 2]));
  }
  static double size_at(double z) { return 0.2 + 0.1 * z; }  // -1 <= z <= 1
  void expect_sizes() {
    ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
    EXPECT_EQ(abi_tests::defects_of(mesh(), true), "");
    const auto data = abi_tests::data_of(mesh());
    for (std::size_t v = 0; v < data.vertex_count(); ++v)
      EXPECT_NEAR(data.sizes[v], size_at(data.xyz[3 * v + 2]), 0.02);
    auto report = abi_tests::sized<carreau_background_report>();
    ASSERT_EQ(carreau_session_background(session, &report), CARREAU_OK);
    EXPECT_GT(report.asked, 100);
    EXPECT_EQ(report.outside, 0);
  }

  abi_tests::MeshData old;
  std::vector<double> sizes;
};

TEST_F(AdaptationOfATorus, SizesHandedBackCrossTheSeams) {
  ASSERT_EQ(carreau_set_vertex_sizes(session, int64_t(sizes.size()), sizes.data()), CARREAU_OK) << error();
  expect_sizes();
  // z is smooth across the seams, and so is the transferred field.
  const auto data = abi_tests::data_of(mesh());
  std::vector<double> z, moved(data.vertex_count());
  for (std::size_t v = 0; v < old.vertex_count(); ++v) z.push_back(old.xyz[3 * v + 2]);
  int64_t outside = -1;
  ASSERT_EQ(carreau_transfer(session, 1, int64_t(z.size()), z.data(), int64_t(moved.size()), moved.data(), &outside),
            CARREAU_OK)
      << error();
  EXPECT_EQ(outside, 0);
  for (std::size_t v = 0; v < moved.size(); ++v) EXPECT_NEAR(moved[v], data.xyz[3 * v + 2], 0.3 * 0.3 / 4);
}

// Elements of second order carry values at all their nodes.
TEST_F(AdaptationOfATorus, CurvedElementsCarryValuesAtAllTheirNodes) {
  ASSERT_EQ(carreau_set_text(session, "element", "p2"), CARREAU_OK) << error();
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  const auto from = abi_tests::data_of(mesh());
  ASSERT_EQ(carreau_set_real(session, "hphydef", 0.21), CARREAU_OK) << error();
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  const auto to = abi_tests::data_of(mesh());
  const auto field = [](const double* p) { return std::sin(2 * p[0]) + p[1] * p[2]; };
  std::vector<double> values, moved(to.vertex_count());
  for (std::size_t v = 0; v < from.vertex_count(); ++v) values.push_back(field(&from.xyz[3 * v]));
  ASSERT_EQ(carreau_transfer(session, 1, int64_t(values.size()), values.data(), int64_t(moved.size()), moved.data(), nullptr),
            CARREAU_OK)
      << error();
  double curved = 0;
  for (std::size_t v = 0; v < moved.size(); ++v) curved = std::max(curved, std::abs(moved[v] - field(&to.xyz[3 * v])));
  EXPECT_LT(curved, 0.3 * 0.3 * 0.3 / 4);
  EXPECT_EQ(carreau_transfer(session, 1, int64_t(values.size()), values.data(), int64_t(moved.size()) - 1, moved.data(), nullptr),
            CARREAU_ERR_ARGUMENT);
}

TEST_F(AdaptationOfATorus, SizesOnASurfaceInSpaceAreFoundAtItsNearestPoint) {
  auto b = abi_tests::sized<carreau_background>();
  b.dimension = 3;
  b.vertex_count = int64_t(old.vertex_count());
  b.triangle_count = int64_t(old.triangle_count());
  b.vertices = old.xyz.data();
  b.triangles = old.triangles.data();
  b.sizes = sizes.data();
  ASSERT_EQ(carreau_set_background(session, &b), CARREAU_OK) << error();
  expect_sizes();
}

}  // namespace
