// SPDX-License-Identifier: BSD-3-Clause
// carreau_remesh as a host sees it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "carreau_remesh.h"

namespace {

/// A square of n x n cells of side 1.
struct Square {
  std::vector<double> vertices;
  std::vector<std::int32_t> triangles;
  explicit Square(int n) {
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) vertices.push_back(i), vertices.push_back(j);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const std::int32_t v = j * (n + 1) + i;
        triangles.insert(triangles.end(), {v, v + 1, v + n + 2, v, v + n + 2, v + n + 1});
      }
  }
};

class Remesh : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(carreau_mesh_create(&mesh_), CARREAU_OK);
    input_.struct_size = sizeof input_;
    input_.vertex_count = std::int64_t(square_.vertices.size() / 2);
    input_.triangle_count = std::int64_t(square_.triangles.size() / 3);
    input_.vertices = square_.vertices.data(), input_.triangles = square_.triangles.data();
    input_.h_min = 0.5, input_.h_max = 1;
    summary_.struct_size = sizeof summary_;
  }
  void TearDown() override { carreau_mesh_free(mesh_); }
  std::int64_t triangles() {
    std::int64_t m = 0;
    EXPECT_EQ(carreau_mesh_count(mesh_, nullptr, &m, nullptr, nullptr), CARREAU_OK);
    return m;
  }
  std::string refusal(carreau_status status = CARREAU_ERR_ARGUMENT) {
    EXPECT_EQ(carreau_remesh(mesh_, &input_, &summary_), status);
    return carreau_mesh_last_error(mesh_);
  }

  Square square_{8};
  carreau_mesh* mesh_ = nullptr;
  carreau_remesh_input input_ = {};
  carreau_remesh_summary summary_ = {};
};

TEST_F(Remesh, GivesMeshKindsAndFields) {
  std::vector<double> nodal, elements, damage(std::size_t(input_.triangle_count), 0);
  for (std::int64_t v = 0; v < input_.vertex_count; ++v)
    nodal.insert(nodal.end(), {2 * square_.vertices[std::size_t(2 * v)], 1 - square_.vertices[std::size_t(2 * v + 1)]});
  for (std::int64_t t = 0; t < input_.triangle_count; ++t) elements.insert(elements.end(), {7, double(t)});
  damage[40] = damage[41] = 1;
  const std::int32_t kinds[] = {CARREAU_ELEMENT_MEAN, CARREAU_ELEMENT_CONSERVED};
  const double points[] = {20, -0.01, -20, -0.01};  // a plane below
  const std::int64_t starts[] = {0, 2};
  input_.nodal_components = 2, input_.nodal_values = nodal.data();
  input_.element_components = 2, input_.element_values = elements.data(), input_.element_kinds = kinds;
  input_.damage = damage.data();
  input_.tool_count = 1, input_.tool_starts = starts, input_.tool_points = points, input_.step = 0.05;
  ASSERT_EQ(carreau_remesh(mesh_, &input_, &summary_), CARREAU_OK) << carreau_mesh_last_error(mesh_);
  EXPECT_EQ(summary_.removed_damaged, 2);
  EXPECT_EQ(summary_.parts_kept, 1);
  EXPECT_GE(summary_.bound_vertices, 9);
  EXPECT_NEAR(summary_.area, 64 - summary_.area_removed + summary_.area_bound, 0.2);
  const auto n = std::size_t(summary_.vertices), m = std::size_t(summary_.triangles);
  std::vector<double> xyz(3 * n), there(2 * n), values(2 * m), d(m);
  std::vector<std::int32_t> refs(n), t(3 * m);
  ASSERT_EQ(carreau_mesh_vertices(mesh_, summary_.vertices, xyz.data()), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_vertex_refs(mesh_, summary_.vertices, refs.data()), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_triangles(mesh_, summary_.triangles, t.data()), CARREAU_OK);
  ASSERT_EQ(carreau_remesh_nodal_values(mesh_, summary_.vertices, there.data()), CARREAU_OK);
  ASSERT_EQ(carreau_remesh_element_values(mesh_, summary_.triangles, values.data()), CARREAU_OK);
  ASSERT_EQ(carreau_remesh_damage(mesh_, summary_.triangles, d.data()), CARREAU_OK);
  for (std::size_t v = 0; v < n; ++v) {
    EXPECT_NEAR(there[2 * v], 2 * xyz[3 * v], 1e-12);
    EXPECT_NEAR(there[2 * v + 1], 1 - xyz[3 * v + 1], 1e-12);
    if (refs[v] >= CARREAU_NODE_BOUND) {
      EXPECT_NEAR(xyz[3 * v + 1], -0.01, 1e-12);
    }
  }
  double sum = 0, before = 0;
  for (std::size_t k = 0; k < m; ++k) {
    const double *a = &xyz[3 * std::size_t(t[3 * k])], *b = &xyz[3 * std::size_t(t[3 * k + 1])],
                 *c = &xyz[3 * std::size_t(t[3 * k + 2])];
    sum += values[2 * k + 1] * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
    EXPECT_NEAR(values[2 * k], 7, 1e-12);
  }
  for (int k = 0; k < input_.triangle_count; ++k) before += k == 40 || k == 41 ? 0 : 0.5 * k;
  EXPECT_NEAR(sum / before, 1, 1e-12);
}

TEST_F(Remesh, KeepsTheStateOnErrors) {
  ASSERT_EQ(carreau_remesh(mesh_, &input_, &summary_), CARREAU_OK);
  const std::int64_t before = triangles();
  const carreau_remesh_summary told = summary_;
  input_.step = 0.7;
  EXPECT_NE(refusal().find("larger than the smallest size"), std::string::npos);
  input_.step = 0;
  input_.tool_count = -1;
  EXPECT_NE(refusal().find("tool_count"), std::string::npos);
  input_.tool_count = 0;
  input_.vertices = nullptr;
  EXPECT_NE(refusal().find("input->vertices is NULL"), std::string::npos);
  input_.vertices = square_.vertices.data();
  input_.error_source = 4;
  EXPECT_NE(refusal().find("error_source"), std::string::npos);
  input_.error_source = CARREAU_ERROR_HESSIAN;
  EXPECT_NE(refusal().find("error_component"), std::string::npos);
  input_.error_source = CARREAU_ERROR_NONE;
  input_.has_reach = 1, input_.reach = 1;
  EXPECT_NE(refusal().find("reach"), std::string::npos);
  EXPECT_EQ(triangles(), before);
  EXPECT_EQ(std::memcmp(&told, &summary_, sizeof told), 0);
  double none = 0;
  EXPECT_EQ(carreau_remesh_damage(mesh_, before, &none), CARREAU_ERR_SEQUENCE);
}

TEST_F(Remesh, FieldsAreWritten) {
  EXPECT_EQ(carreau_mesh_add_field(mesh_, "x", 1, 1, square_.vertices.data()), CARREAU_ERR_SEQUENCE);
  ASSERT_EQ(carreau_remesh(mesh_, &input_, nullptr), CARREAU_OK);
  const std::vector<double> values(std::size_t(triangles()), 0.5);
  EXPECT_EQ(carreau_mesh_add_field(mesh_, "", 0, 1, values.data()), CARREAU_ERR_ARGUMENT);
  ASSERT_EQ(carreau_mesh_add_field(mesh_, "damage", 0, 1, values.data()), CARREAU_OK);
  const auto path = std::filesystem::temp_directory_path() / ("carreau_remesh_" + std::to_string(::getpid()) + ".vtu");
  ASSERT_EQ(carreau_mesh_write(mesh_, path.string().c_str()), CARREAU_OK) << carreau_mesh_last_error(mesh_);
  ASSERT_EQ(carreau_mesh_read(mesh_, path.string().c_str()), CARREAU_OK) << carreau_mesh_last_error(mesh_);
  std::filesystem::remove(path);
  double none = 0;
  EXPECT_EQ(carreau_remesh_damage(mesh_, 1000000, &none), CARREAU_ERR_SEQUENCE);  // another mesh
}

TEST_F(Remesh, RunsAThousandTimes) {
  std::vector<double> xyz, xy;
  std::vector<std::int32_t> t;
  for (int i = 0; i < 1000; ++i) {
    input_.h_max = 1 + 0.3 * (i % 3);
    ASSERT_EQ(carreau_remesh(mesh_, &input_, &summary_), CARREAU_OK) << i << carreau_mesh_last_error(mesh_);
    ASSERT_NEAR(summary_.area, 64, 1e-9);
    xyz.resize(std::size_t(3 * summary_.vertices)), t.resize(std::size_t(3 * summary_.triangles)), xy.clear();
    carreau_mesh_vertices(mesh_, summary_.vertices, xyz.data());
    carreau_mesh_triangles(mesh_, summary_.triangles, t.data());
    for (std::size_t v = 0; v < xyz.size(); v += 3) xy.push_back(xyz[v]), xy.push_back(xyz[v + 1]);
    input_.vertices = xy.data(), input_.triangles = t.data();
    input_.vertex_count = summary_.vertices, input_.triangle_count = summary_.triangles;
  }
}

}  // namespace
