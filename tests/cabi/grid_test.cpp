// SPDX-License-Identifier: BSD-3-Clause
// Structured grids through the interface: meshes, files, mistakes.
#include <carreau_geometry.h>

#include <cmath>
#include <numbers>

#include "abi_fixture.h"

namespace abi_tests {
namespace {

constexpr double pi = std::numbers::pi;

/// Two blocks that make the cylinder of radius 1 and height 2, each half of it.
struct Cylinder {
  std::array<std::int32_t, 4> counts{17, 9, 17, 9};
  std::vector<double> nodes;
  Cylinder() {
    for (int b = 0; b < 2; ++b)
      for (int j = 0; j < 9; ++j)
        for (int i = 0; i < 17; ++i) {
          const int k = (16 * b + i) % 32;
          for (const double x : {std::cos(pi * k / 16), std::sin(pi * k / 16), j / 4.0}) nodes.push_back(x);
        }
  }
};

class Grids : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(carreau_session_create(&session), CARREAU_OK); }
  void TearDown() override { carreau_session_free(session); }

  MeshData mesh_of(double size) {
    EXPECT_EQ(carreau_set_real(session, "hphydef", size), CARREAU_OK);
    EXPECT_EQ(carreau_mesh_generate(session), CARREAU_OK) << carreau_last_error(session);
    carreau_mesh* mesh = nullptr;
    EXPECT_EQ(carreau_session_mesh(session, &mesh), CARREAU_OK);
    EXPECT_EQ(defects_of(mesh), "");
    return data_of(mesh);
  }

  carreau_session* session = nullptr;
};

TEST_F(Grids, TwoBlocksMakeACylinder) {
  const Cylinder cylinder;
  carreau_grid_options options = sized<carreau_grid_options>();
  options.join_angle = 30;
  ASSERT_EQ(carreau_add_grid(session, &options, 2, cylinder.counts.data(), cylinder.nodes.data()), CARREAU_OK)
      << carreau_last_error(session);
  const MeshData data = mesh_of(0.2);
  for (std::size_t v = 0; v < data.vertex_count(); ++v)
    EXPECT_NEAR(std::hypot(data.xyz[3 * v], data.xyz[3 * v + 1]), 1, 1e-4);
  for (const std::int32_t ref : data.triangle_refs) EXPECT_TRUE(ref == 1 || ref == 2);
}

TEST_F(Grids, OptionsMayBeNullAndPointsCanBeRequested) {
  const Cylinder cylinder;
  ASSERT_EQ(carreau_add_grid(session, nullptr, 2, cylinder.counts.data(), cylinder.nodes.data()), CARREAU_OK);
  const std::array<double, 2> uv{8, 4};
  std::array<double, 3> x{};
  ASSERT_EQ(carreau_geometry_points(session, 2, 1, uv.data(), x.data()), CARREAU_OK);
  EXPECT_NEAR(x[1], -1, 1e-15);
  EXPECT_NEAR(x[2], 1, 1e-15);
}

TEST_F(Grids, AFileIsSmoothedOnRequest) {
  const std::string path = std::string(CARREAU_TEST_DATA) + "/grid/volcano.txt";
  carreau_grid_options options = sized<carreau_grid_options>();
  options.step = 10, options.smoothing_rounds = 100;
  ASSERT_EQ(carreau_load_grid(session, &options, path.c_str(), CARREAU_GRID_BY_SUFFIX), CARREAU_OK) << carreau_last_error(session);
  const std::array<double, 2> uv{86, 60};
  std::array<double, 3> x{};
  ASSERT_EQ(carreau_geometry_points(session, 1, 1, uv.data(), x.data()), CARREAU_OK);
  EXPECT_NEAR(x[0], 860, 1e-9);
  EXPECT_NEAR(x[1], 600, 1e-9);
}

/// Half an elliptic cylinder (2 cos t, y, sin t): its radius of curvature is .5 along its ridge x = 2, z = 0, between two columns.
struct EllipticCylinder {
  std::array<std::int32_t, 2> counts{32, 11};
  std::vector<double> nodes;
  EllipticCylinder() {
    for (int j = 0; j < 11; ++j)
      for (int i = 0; i < 32; ++i)
        for (const double t = -1.25 + 2.5 * i / 31; const double x : {2 * std::cos(t), j / 5.0, std::sin(t)}) nodes.push_back(x);
  }
};

TEST_F(Grids, RidgesBecomeEdges) {
  const EllipticCylinder cylinder;
  std::int64_t count = -1;
  EXPECT_EQ(carreau_model_embed_ridges(session, 0.6, &count), CARREAU_ERR_SEQUENCE);
  ASSERT_EQ(carreau_add_grid(session, nullptr, 1, cylinder.counts.data(), cylinder.nodes.data()), CARREAU_OK);
  EXPECT_EQ(carreau_model_embed_ridges(session, 0, &count), CARREAU_ERR_ARGUMENT);
  ASSERT_EQ(carreau_model_embed_ridges(session, 0.4, &count), CARREAU_OK) << carreau_last_error(session);
  EXPECT_EQ(count, 0);
  ASSERT_EQ(carreau_model_embed_ridges(session, 0.6, &count), CARREAU_OK) << carreau_last_error(session);
  EXPECT_EQ(count, 1);
  const MeshData data = mesh_of(0.25);
  double length = 0;
  for (std::size_t e = 0; e < data.edge_refs.size(); ++e) {
    const double *p = &data.xyz[3 * std::size_t(data.edges[2 * e])], *q = &data.xyz[3 * std::size_t(data.edges[2 * e + 1])];
    if (std::hypot(p[0] - 2, p[2]) < 1e-3 && std::hypot(q[0] - 2, q[2]) < 1e-3) length += std::abs(q[1] - p[1]);
  }
  EXPECT_NEAR(length, 2, 1e-6);
}

TEST_F(Grids, SplinesHaveContinuousSecondDerivatives) {
  const EllipticCylinder cylinder;
  carreau_grid_options options = sized<carreau_grid_options>();
  for (const int continuity : {1, 2}) {
    carreau_session* other = nullptr;
    ASSERT_EQ(carreau_session_create(&other), CARREAU_OK);
    options.continuity = continuity;
    ASSERT_EQ(carreau_add_grid(other, &options, 1, cylinder.counts.data(), cylinder.nodes.data()), CARREAU_OK);
    const std::array<double, 4> uv{8 - 1e-9, 4.5, 8 + 1e-9, 4.5};
    std::array<double, 18> second{};
    ASSERT_EQ(carreau_evaluate(other, 2, 1, 2, uv.data(), 2, nullptr, nullptr, second.data()), CARREAU_OK);
    const double jump = std::hypot(second[0] - second[9], second[1] - second[10], second[2] - second[11]);
    if (continuity == 2)
      EXPECT_LT(jump, 1e-9);
    else
      EXPECT_GT(jump, 1e-5);
    carreau_session_free(other);
  }
  options.continuity = 3;
  EXPECT_EQ(carreau_add_grid(session, &options, 1, cylinder.counts.data(), cylinder.nodes.data()), CARREAU_ERR_ARGUMENT);
  EXPECT_STREQ(carreau_last_error(session), "the continuity of a grid is 3; it must be 0, 1 or 2");
}

TEST_F(Grids, MistakesAreReportedAndLeaveTheSessionAsItWas) {
  const Cylinder cylinder;
  carreau_grid_options options = sized<carreau_grid_options>();
  const auto add = [&](const std::int32_t* counts, const double* nodes) -> std::string {
    EXPECT_NE(carreau_add_grid(session, &options, 2, counts, nodes), CARREAU_OK);
    return carreau_last_error(session);
  };
  const std::array<std::int32_t, 4> thin{17, 9, 17, 1}, negative{-1, 9, 17, 9};
  EXPECT_EQ(add(thin.data(), cylinder.nodes.data()), "block 2 has 17 x 1 nodes; a surface needs two rows and two columns");
  EXPECT_EQ(add(negative.data(), cylinder.nodes.data()), "block 1 has -1 x 9 nodes");
  options.measured = 3;
  EXPECT_EQ(add(cylinder.counts.data(), cylinder.nodes.data()), "the kind of measured values of a grid is 3; it must be 0, 1 or 2");
  options.measured = 0, options.join_angle = -1;
  EXPECT_EQ(add(cylinder.counts.data(), cylinder.nodes.data()), "the join_angle of a grid must lie between 0 and 180 degrees");
  options.join_angle = 0, options.smoothing_rounds = -1;
  EXPECT_EQ(add(cylinder.counts.data(), cylinder.nodes.data()), "the number of rounds of smoothing is negative");
  options.smoothing_rounds = 0;
  EXPECT_EQ(carreau_load_grid(session, &options, "no.fmt", 7), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_load_grid(session, &options, "no.fmt", 0), CARREAU_ERR_FILE);
  EXPECT_EQ(carreau_add_grid(session, &options, 2, cylinder.counts.data(), nullptr), CARREAU_ERR_ARGUMENT);
  ASSERT_EQ(carreau_add_grid(session, &options, 2, cylinder.counts.data(), cylinder.nodes.data()), CARREAU_OK);
  // The same once more stands beside the first.
  ASSERT_EQ(carreau_add_grid(session, &options, 2, cylinder.counts.data(), cylinder.nodes.data()), CARREAU_OK);
  carreau_geometry second = sized<carreau_geometry>();
  ASSERT_EQ(carreau_geometry_info(session, 1, &second), CARREAU_OK);
  EXPECT_EQ(second.kind, CARREAU_GEOMETRY_GRID);
  EXPECT_EQ(second.first_face, 3);
}

}  // namespace
}  // namespace abi_tests
