// SPDX-License-Identifier: BSD-3-Clause
// The common fixture of the tests of the interface.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "carreau.h"
#include "hosts.h"

namespace abi_tests {

/// A mesh as the getters give it.
struct MeshData {
  std::vector<double> xyz, sizes, uv;
  std::vector<std::int32_t> vertex_refs, triangles, triangle_refs, edges, edge_refs;
  friend bool operator==(const MeshData&, const MeshData&) = default;

  [[nodiscard]] std::size_t vertex_count() const { return xyz.size() / 3; }
  [[nodiscard]] std::size_t triangle_count() const { return triangles.size() / 3; }
  [[nodiscard]] std::size_t edge_count() const { return edges.size() / 2; }
};

inline MeshData data_of(carreau_mesh* mesh, bool of_session = true) {
  std::int64_t n = 0, m = 0, k = 0;
  EXPECT_EQ(carreau_mesh_count(mesh, &n, &m, &k, nullptr), CARREAU_OK) << carreau_mesh_last_error(mesh);
  MeshData data;
  data.xyz.resize(3 * n), data.vertex_refs.resize(n);
  data.triangles.resize(3 * m), data.triangle_refs.resize(m);
  data.edges.resize(2 * k), data.edge_refs.resize(k);
  EXPECT_EQ(carreau_mesh_vertices(mesh, n, data.xyz.data()), CARREAU_OK);
  EXPECT_EQ(carreau_mesh_vertex_refs(mesh, n, data.vertex_refs.data()), CARREAU_OK);
  if (m > 0) {
    EXPECT_EQ(carreau_mesh_triangles(mesh, m, data.triangles.data()), CARREAU_OK);
    EXPECT_EQ(carreau_mesh_triangle_refs(mesh, m, data.triangle_refs.data()), CARREAU_OK);
  }
  if (k > 0) {
    EXPECT_EQ(carreau_mesh_edges(mesh, k, data.edges.data()), CARREAU_OK);
    EXPECT_EQ(carreau_mesh_edge_refs(mesh, k, data.edge_refs.data()), CARREAU_OK);
  }
  if (!of_session || m == 0) return data;
  data.sizes.resize(n), data.uv.resize(6 * m);
  EXPECT_EQ(carreau_mesh_vertex_sizes(mesh, n, data.sizes.data()), CARREAU_OK);
  EXPECT_EQ(carreau_mesh_corner_uv(mesh, m, data.uv.data()), CARREAU_OK);
  return data;
}

inline std::string defects_of(carreau_mesh* mesh, bool closed = false) {
  std::int64_t count = -1;
  const char* text = nullptr;
  EXPECT_EQ(carreau_mesh_defects(mesh, closed, 10, &count, &text), CARREAU_OK) << carreau_mesh_last_error(mesh);
  return text != nullptr ? text : "no text";
}

template <typename Struct>
Struct sized() {
  Struct value{};
  value.struct_size = sizeof value;
  return value;
}

class SessionTest : public testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(carreau_session_create(&session), CARREAU_OK); }
  void TearDown() override { carreau_session_free(session); }

  void use_paraboloid(double hphydef = 0.5) {
    host.session = session;
    const carreau_cad cad = paraboloid_cad(&host);
    ASSERT_EQ(carreau_set_cad(session, &cad), CARREAU_OK) << error();
    ASSERT_EQ(paraboloid_model(session), CARREAU_OK) << error();
    ASSERT_EQ(carreau_set_real(session, "hphydef", hphydef), CARREAU_OK) << error();
  }
  [[nodiscard]] std::string error() const { return carreau_last_error(session); }
  [[nodiscard]] carreau_mesh* mesh() {
    carreau_mesh* handle = nullptr;
    EXPECT_EQ(carreau_session_mesh(session, &handle), CARREAU_OK) << error();
    return handle;
  }
  carreau_report report() {
    auto result = sized<carreau_report>();
    EXPECT_EQ(carreau_session_report(session, &result), CARREAU_OK) << error();
    return result;
  }

  carreau_session* session = nullptr;
  test_host host{};
};

}  // namespace abi_tests
