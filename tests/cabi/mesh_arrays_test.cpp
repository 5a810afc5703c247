// SPDX-License-Identifier: BSD-3-Clause
// Meshes from arrays of the caller.
#include <carreau.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace {

struct Mesh {
  Mesh() { carreau_mesh_create(&handle); }
  ~Mesh() { carreau_mesh_free(handle); }
  Mesh(const Mesh&) = delete;
  Mesh& operator=(const Mesh&) = delete;
  operator carreau_mesh*() const { return handle; }  // NOLINT: as the C interface takes it
  carreau_mesh* handle = nullptr;
};

/// A regular tetrahedron in the corners of a cube of side 2: edges of 2 sqrt(2).
class Tetrahedron : public testing::Test {
 protected:
  Tetrahedron() {
    arrays.struct_size = sizeof arrays;
    arrays.dimension = 3;
    arrays.vertex_count = 4, arrays.triangle_count = 4;
    arrays.vertices = vertices.data(), arrays.triangles = triangles.data();
  }
  [[nodiscard]] std::string sentence() const { return carreau_mesh_last_error(mesh); }

  std::vector<double> vertices{1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1};
  std::vector<std::int32_t> triangles{0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};
  std::vector<std::int32_t> vertex_refs{5, 6, 7, 8}, triangle_refs{1, 2, 3, 3}, edges{0, 1, 1, 2}, edge_refs{9, 4};
  carreau_mesh_arrays arrays{};
  Mesh mesh;
};

TEST_F(Tetrahedron, IsCheckedAndMeasured) {
  ASSERT_EQ(carreau_mesh_from_arrays(mesh, &arrays), CARREAU_OK) << sentence();
  carreau_quality quality{};
  quality.struct_size = sizeof quality;
  ASSERT_EQ(carreau_mesh_quality(mesh, &quality), CARREAU_OK);
  EXPECT_EQ(quality.open_edges, 0);
  EXPECT_NEAR(quality.q1_min, 1, 1e-15);
  EXPECT_NEAR(quality.area, 8 * std::sqrt(3), 1e-14);
  std::int64_t count = -1;
  const char* text = nullptr;
  ASSERT_EQ(carreau_mesh_defects(mesh, 1, 10, &count, &text), CARREAU_OK);
  EXPECT_EQ(count, 0) << text;
  triangles[3] = 1, triangles[5] = 0;  // turned over, twice the same side
  ASSERT_EQ(carreau_mesh_from_arrays(mesh, &arrays), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_defects(mesh, 1, 10, &count, &text), CARREAU_OK);
  EXPECT_GT(count, 0);
}

TEST_F(Tetrahedron, IsARegionWithAPointInside) {
  ASSERT_EQ(carreau_mesh_from_arrays(mesh, &arrays), CARREAU_OK) << sentence();
  std::int64_t count = 0;
  ASSERT_EQ(carreau_mesh_regions(mesh, 0, &count, nullptr, nullptr), CARREAU_OK) << sentence();
  EXPECT_EQ(count, 1);
  std::int32_t solid = 0;
  std::array<double, 3> inside{};
  ASSERT_EQ(carreau_mesh_regions(mesh, 1, &count, &solid, inside.data()), CARREAU_OK);
  EXPECT_EQ(solid, 1);
  // Sides of the tetrahedron lie in the planes +-x +-y +-z = 1 whose product of signs is negative.
  for (const std::array<int, 3>& s : {std::array{1, 1, -1}, {1, -1, 1}, {-1, 1, 1}, {-1, -1, -1}}) {
    const double sum = s[0] * inside[0] + s[1] * inside[1] + s[2] * inside[2];
    EXPECT_LT(sum, 1);
  }
  std::array<std::int32_t, 8> sides{};
  ASSERT_EQ(carreau_mesh_triangle_sides(mesh, 4, sides.data()), CARREAU_OK);
  EXPECT_EQ(sides[0] + sides[1], 1);
  for (std::size_t t = 1; t < 4; ++t) EXPECT_EQ(sides[2 * t], sides[0]);
  EXPECT_EQ(carreau_mesh_triangle_sides(mesh, 3, sides.data()), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_mesh_triangle_sides(mesh, 4, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_mesh_regions(mesh, -1, &count, nullptr, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_mesh_regions(mesh, 0, nullptr, nullptr, nullptr), CARREAU_ERR_ARGUMENT);
}

TEST_F(Tetrahedron, GoesToFilesAndBack) {
  arrays.edge_count = 2;
  arrays.edges = edges.data(), arrays.edge_refs = edge_refs.data();
  arrays.vertex_refs = vertex_refs.data(), arrays.triangle_refs = triangle_refs.data();
  ASSERT_EQ(carreau_mesh_from_arrays(mesh, &arrays), CARREAU_OK) << sentence();
  std::int64_t n = 0, m = 0, k = 0, f = 0;
  ASSERT_EQ(carreau_mesh_count(mesh, &n, &m, &k, &f), CARREAU_OK);
  EXPECT_EQ((std::array{n, m, k, f}), (std::array<std::int64_t, 4>{4, 4, 2, 3}));
  for (const char* suffix : {".mesh", ".meshb", ".vtu", ".msh", ".msh2"}) {
    const std::string path = testing::TempDir() + "carreau_tetrahedron" + suffix;
    ASSERT_EQ(carreau_mesh_write(mesh, path.c_str()), CARREAU_OK) << sentence();
    const Mesh back;
    ASSERT_EQ(carreau_mesh_read(back, path.c_str()), CARREAU_OK) << carreau_mesh_last_error(back);
    std::vector<double> xyz(12);
    std::vector<std::int32_t> corners(12), refs(4);
    ASSERT_EQ(carreau_mesh_vertices(back, 4, xyz.data()), CARREAU_OK);
    ASSERT_EQ(carreau_mesh_triangles(back, 4, corners.data()), CARREAU_OK);
    ASSERT_EQ(carreau_mesh_triangle_refs(back, 4, refs.data()), CARREAU_OK);
    EXPECT_EQ(xyz, vertices) << suffix;
    EXPECT_EQ(corners, triangles) << suffix;
    EXPECT_EQ(refs, triangle_refs) << suffix;
    std::filesystem::remove(path);
  }
}

TEST_F(Tetrahedron, KeepsTheParametersOfItsCorners) {
  std::vector<double> uv(24), out(24);
  for (std::size_t i = 0; i < uv.size(); ++i) uv[i] = 0.5 * double(i);
  ASSERT_EQ(carreau_mesh_from_arrays(mesh, &arrays), CARREAU_OK);
  EXPECT_EQ(carreau_mesh_corner_uv(mesh, 4, out.data()), CARREAU_ERR_SEQUENCE);
  arrays.corner_uv = uv.data();
  ASSERT_EQ(carreau_mesh_from_arrays(mesh, &arrays), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_corner_uv(mesh, 4, out.data()), CARREAU_OK);
  EXPECT_EQ(out, uv);
}

TEST_F(Tetrahedron, MistakesAreReportedAndTheOldContentStays) {
  ASSERT_EQ(carreau_mesh_from_arrays(mesh, &arrays), CARREAU_OK);
  const auto refused = [&](const std::string& why) {
    EXPECT_EQ(carreau_mesh_from_arrays(mesh, &arrays), CARREAU_ERR_ARGUMENT);
    EXPECT_NE(sentence().find(why), std::string::npos) << sentence();
  };
  triangles[7] = 4;
  refused("triangle 2 has the vertex 4; there are 4");
  triangles[7] = -1;
  refused("triangle 2 has the vertex -1");
  triangles[7] = 2;
  arrays.edge_count = 2, arrays.edges = nullptr;
  refused("arrays->edges is NULL");
  edges[3] = 17, arrays.edges = edges.data();
  refused("edge 1 has the vertex 17");
  arrays.edge_count = 0;
  vertices[4] = std::numeric_limits<double>::infinity();
  refused("vertex 1 is not finite");
  vertices[4] = -1;
  arrays.triangle_count = 0;
  refused("number of triangles is 0");
  arrays.triangle_count = -4;
  refused("number of triangles is -4");
  arrays.triangle_count = 4, arrays.dimension = 4;
  refused("dimension of a mesh is 4");
  arrays.dimension = 3, arrays.struct_size = 1;
  refused("struct_size");
  EXPECT_EQ(carreau_mesh_from_arrays(nullptr, &arrays), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_mesh_from_arrays(mesh, nullptr), CARREAU_ERR_ARGUMENT);
  std::int64_t m = 0;
  EXPECT_EQ(carreau_mesh_count(mesh, nullptr, &m, nullptr, nullptr), CARREAU_OK);
  EXPECT_EQ(m, 4);
}

TEST_F(Tetrahedron, PlaneMeshesHaveDimensionTwo) {
  const std::vector<double> square{0, 0, 1, 0, 1, 1, 0, 1};
  const std::vector<std::int32_t> halves{0, 1, 2, 0, 2, 3};
  arrays.dimension = 2;
  arrays.triangle_count = 2;
  arrays.vertices = square.data(), arrays.triangles = halves.data();
  ASSERT_EQ(carreau_mesh_from_arrays(mesh, &arrays), CARREAU_OK) << sentence();
  std::int32_t dimension = 0;
  EXPECT_EQ(carreau_mesh_dimension(mesh, &dimension), CARREAU_OK);
  EXPECT_EQ(dimension, 2);
  carreau_quality quality{};
  quality.struct_size = sizeof quality;
  ASSERT_EQ(carreau_mesh_quality(mesh, &quality), CARREAU_OK);
  EXPECT_DOUBLE_EQ(quality.area, 1);
}

}  // namespace
