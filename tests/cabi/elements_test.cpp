// SPDX-License-Identifier: BSD-3-Clause
// Elements through the interface: kinds, nodes, (u, v), quality, files.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "abi_fixture.h"
#include "carreau_geometry.h"

namespace abi_tests {
namespace {

constexpr int nodes_of[] = {0, 3, 6, 4, 8};

struct Cells {
  std::vector<std::int32_t> nodes, refs;
};

Cells cells_of(carreau_mesh* mesh, std::int32_t kind) {
  std::int64_t n = -1;
  EXPECT_EQ(carreau_mesh_cell_count(mesh, kind, &n), CARREAU_OK) << carreau_mesh_last_error(mesh);
  Cells cells{std::vector<std::int32_t>(std::size_t(n * nodes_of[kind])), std::vector<std::int32_t>(std::size_t(n))};
  if (n > 0) {
    EXPECT_EQ(carreau_mesh_cells(mesh, kind, n, cells.nodes.data(), cells.refs.data()), CARREAU_OK);
  }
  return cells;
}

TEST_F(SessionTest, TrianglesOfOrderOneAreTheElementsOfP1) {
  use_paraboloid();
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  const MeshData data = data_of(mesh());
  const Cells cells = cells_of(mesh(), CARREAU_CELL_TRIANGLE3);
  EXPECT_EQ(cells.nodes, data.triangles);
  EXPECT_EQ(cells.refs, data.triangle_refs);
  for (const std::int32_t kind : {CARREAU_CELL_TRIANGLE6, CARREAU_CELL_QUAD4, CARREAU_CELL_QUAD8})
    EXPECT_TRUE(cells_of(mesh(), kind).nodes.empty());
  std::vector<std::int32_t> mids(data.edge_count());
  ASSERT_EQ(carreau_mesh_edge_mids(mesh(), std::int64_t(mids.size()), mids.data()), CARREAU_OK);
  EXPECT_EQ(std::count(mids.begin(), mids.end(), -1), std::ptrdiff_t(mids.size()));
}

TEST_F(SessionTest, NodesOfP2LieOnTheSurfaceAtTheirParameters) {
  use_paraboloid();
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  const MeshData straight = data_of(mesh());
  ASSERT_EQ(carreau_set_text(session, "element", "p2"), CARREAU_OK) << error();
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  const MeshData data = data_of(mesh());
  EXPECT_EQ(defects_of(mesh()), "");
  EXPECT_EQ(data.triangles, straight.triangles);  // the same corners
  EXPECT_TRUE(std::equal(straight.xyz.begin(), straight.xyz.end(), data.xyz.begin()));
  const Cells cells = cells_of(mesh(), CARREAU_CELL_TRIANGLE6);
  ASSERT_EQ(cells.refs, data.triangle_refs);
  std::vector<double> uv(2 * cells.nodes.size());
  ASSERT_EQ(carreau_mesh_cell_uv(mesh(), CARREAU_CELL_TRIANGLE6, std::int64_t(cells.refs.size()), uv.data()),
            CARREAU_OK);
  std::vector<std::int32_t> faces(cells.nodes.size());
  ASSERT_EQ(carreau_mesh_cell_faces(mesh(), CARREAU_CELL_TRIANGLE6, std::int64_t(cells.refs.size()), faces.data()),
            CARREAU_OK);
  for (std::size_t i = 0; i < faces.size(); ++i) ASSERT_EQ(faces[i], cells.refs[i / 6]);  // all are of one face
  for (std::size_t i = 0; i < cells.nodes.size(); ++i) {
    const double u = uv[2 * i], v = uv[2 * i + 1], *xyz = &data.xyz[3 * std::size_t(cells.nodes[i])];
    ASSERT_NEAR(xyz[0], u, 1e-14);
    ASSERT_NEAR(xyz[1], v, 1e-14);
    ASSERT_NEAR(xyz[2], (u * u + v * v) / 2, 1e-14);
  }
  // Euler: every edge has one node.
  EXPECT_EQ(data.vertex_count() - straight.vertex_count(),
            (3 * straight.triangle_count() + straight.edge_count()) / 2);
  std::vector<std::int32_t> mids(data.edge_count());
  ASSERT_EQ(carreau_mesh_edge_mids(mesh(), std::int64_t(mids.size()), mids.data()), CARREAU_OK);
  for (const std::int32_t mid : mids) ASSERT_GE(std::size_t(mid), straight.vertex_count());
}

TEST_F(SessionTest, QualityOfElementsCountsThem) {
  use_paraboloid(0.2);
  ASSERT_EQ(carreau_set_text(session, "element", "q2.1"), CARREAU_OK) << error();
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  auto quality = sized<carreau_cell_quality>();
  ASSERT_EQ(carreau_mesh_cell_quality(mesh(), &quality), CARREAU_OK);
  EXPECT_EQ(quality.quads8, std::int64_t(cells_of(mesh(), CARREAU_CELL_QUAD8).refs.size()));
  EXPECT_GT(quality.quads8, 0);
  EXPECT_EQ(quality.triangles3 + quality.triangles6 + quality.quads4, 0);
  EXPECT_EQ(quality.triangle_share, 0);
  EXPECT_EQ(quality.invalid, 0);
  EXPECT_GT(quality.least_jacobian_min, 0);
  EXPECT_GT(quality.shape_mean, 0.8);
  EXPECT_LE(quality.shape_mean, 1);
  EXPECT_EQ(defects_of(mesh()), "");
}

TEST_F(SessionTest, ElementsComeBackFromFiles) {
  use_paraboloid();
  for (const char* element : {"p2", "q1.0", "q2.0"}) {
    ASSERT_EQ(carreau_set_text(session, "element", element), CARREAU_OK) << error();
    ASSERT_EQ(carreau_set_integer(session, "flag", 1), CARREAU_OK);
    ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
    auto wanted = sized<carreau_cell_quality>();
    ASSERT_EQ(carreau_mesh_cell_quality(mesh(), &wanted), CARREAU_OK);
    for (const char* suffix : {"vtu", "msh", "msh2", "mesh", "meshb"}) {
      const std::string path = testing::TempDir() + "elements." + suffix;
      ASSERT_EQ(carreau_mesh_write(mesh(), path.c_str()), CARREAU_OK) << carreau_mesh_last_error(mesh());
      carreau_mesh* read = nullptr;
      ASSERT_EQ(carreau_mesh_create(&read), CARREAU_OK);
      EXPECT_EQ(carreau_mesh_read(read, path.c_str()), CARREAU_OK) << carreau_mesh_last_error(read);
      auto found = sized<carreau_cell_quality>();
      EXPECT_EQ(carreau_mesh_cell_quality(read, &found), CARREAU_OK);
      EXPECT_EQ(found.triangles3, wanted.triangles3) << element << suffix;
      EXPECT_EQ(found.triangles6, wanted.triangles6) << element << suffix;
      EXPECT_EQ(found.quads4, wanted.quads4) << element << suffix;
      EXPECT_EQ(found.quads8, wanted.quads8) << element << suffix;
      EXPECT_NEAR(found.area, wanted.area, 1e-12 * wanted.area) << element << suffix;
      EXPECT_EQ(defects_of(read), "") << element << suffix;
      carreau_mesh_free(read);
      std::remove(path.c_str());
    }
  }
}

/// An octahedron over the unit sphere, each side divided `times` in two.
struct Octahedron {
  std::vector<double> xyz;
  std::vector<std::int32_t> triangles;

  explicit Octahedron(int times) {
    const double corner[6][3] = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (int k = 0; k < 4; ++k)
      for (int top = 4; top < 6; ++top) {
        const int a = k, b = (k + 1) % 4;
        divide(corner[top == 4 ? a : b], corner[top == 4 ? b : a], corner[top], times);
      }
  }
  void divide(const double* a, const double* b, const double* c, int times) {
    if (times == 0) {
      for (const double* p : {a, b, c}) {
        triangles.push_back(std::int32_t(xyz.size() / 3));
        xyz.insert(xyz.end(), p, p + 3);
      }
      return;
    }
    double m[3][3];
    const double* ends[3][2] = {{a, b}, {b, c}, {c, a}};
    for (int i = 0; i < 3; ++i) {
      double size = 0;
      for (int k = 0; k < 3; ++k) m[i][k] = ends[i][0][k] + ends[i][1][k], size += m[i][k] * m[i][k];
      for (int k = 0; k < 3; ++k) m[i][k] /= std::sqrt(size);
    }
    divide(a, m[0], m[2], times - 1), divide(m[0], b, m[1], times - 1);
    divide(m[2], m[1], c, times - 1), divide(m[0], m[1], m[2], times - 1);
  }
};

TEST_F(SessionTest, SurfacesOfTrianglesHaveAllElements) {
  const Octahedron sphere(3);
  auto given = sized<carreau_triangles>();
  given.vertices = sphere.xyz.data(), given.vertex_count = std::int64_t(sphere.xyz.size() / 3);
  given.triangles = sphere.triangles.data(), given.triangle_count = std::int64_t(sphere.triangles.size() / 3);
  ASSERT_EQ(carreau_add_triangles(session, nullptr, &given), CARREAU_OK) << error();
  ASSERT_EQ(carreau_set_real(session, "hphydef", 0.2), CARREAU_OK);
  const auto off_sphere = [&] {
    const MeshData data = data_of(mesh());
    double off = 0;
    for (std::size_t v = 0; v < data.vertex_count(); ++v)
      off = std::max(off, std::abs(std::hypot(data.xyz[3 * v], data.xyz[3 * v + 1], data.xyz[3 * v + 2]) - 1));
    return off;
  };
  // How far the surface over the triangles is from the sphere, as fine straight triangles sample it.
  ASSERT_EQ(carreau_set_real(session, "hphydef", 0.05), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  const double off_surface = off_sphere();
  EXPECT_LT(off_surface, 0.003);
  ASSERT_EQ(carreau_set_real(session, "hphydef", 0.2), CARREAU_OK);
  for (const char* element : {"p2", "q1.0", "q1.1", "q2.0", "q2.1"}) {
    ASSERT_EQ(carreau_set_text(session, "element", element), CARREAU_OK) << error();
    ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
    EXPECT_EQ(defects_of(mesh()), "") << element;
    auto quality = sized<carreau_cell_quality>();
    ASSERT_EQ(carreau_mesh_cell_quality(mesh(), &quality), CARREAU_OK);
    EXPECT_EQ(quality.invalid, 0) << element;
    EXPECT_EQ(quality.quads4 > 0, element[1] == '1') << element;
    EXPECT_EQ(quality.triangles6 > 0, element[0] == 'p' || (element[1] == '2' && element[3] == '0' && quality.triangle_share > 0)) << element;
    if (element[0] == 'q' && element[3] == '1') {
      EXPECT_EQ(quality.triangle_share, 0) << element;
    }
    const bool curved = element[1] == '2';
    // The area of a sphere so much smaller or larger; straight elements lose a square of the size.
    EXPECT_NEAR(quality.area, 4 * std::acos(-1.0), 4 * std::acos(-1.0) * 2 * off_surface + (curved ? 0 : 0.15)) << element;
    EXPECT_LE(off_sphere(), 1.05 * off_surface) << element;  // nodes lie on it
  }
}

TEST_F(SessionTest, LimitsOfElementsAreReported) {
  use_paraboloid();
  ASSERT_EQ(carreau_set_text(session, "element", "p2"), CARREAU_OK) << error();
  EXPECT_EQ(carreau_set_text(session, "element", "p3"), CARREAU_ERR_ARGUMENT);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  std::int64_t n = 0;
  EXPECT_EQ(carreau_mesh_cell_count(mesh(), 5, &n), CARREAU_ERR_ARGUMENT);
  ASSERT_EQ(carreau_mesh_cell_count(mesh(), CARREAU_CELL_TRIANGLE6, &n), CARREAU_OK);
  std::vector<std::int32_t> nodes(std::size_t(6 * n));
  EXPECT_EQ(carreau_mesh_cells(mesh(), CARREAU_CELL_TRIANGLE6, n - 1, nodes.data(), nullptr), CARREAU_ERR_ARGUMENT);
  std::int64_t vertices = 0;
  ASSERT_EQ(carreau_mesh_count(mesh(), &vertices, nullptr, nullptr, nullptr), CARREAU_OK);
  const std::vector<double> sizes(std::size_t(vertices), 0.5);
  EXPECT_EQ(carreau_set_vertex_sizes(session, vertices - 1, sizes.data()), CARREAU_ERR_ARGUMENT);
  EXPECT_NE(error().find("corners"), std::string::npos) << error();
  EXPECT_EQ(carreau_set_vertex_sizes(session, vertices, sizes.data()), CARREAU_OK) << error();  // at all nodes
}

}  // namespace
}  // namespace abi_tests
