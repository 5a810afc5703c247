// SPDX-License-Identifier: BSD-3-Clause
// Elements through the interface: kinds, nodes, (u, v), quality, files.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "abi_fixture.h"

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

TEST_F(SessionTest, WhatElementsCannotDoIsTold) {
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
