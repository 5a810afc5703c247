// SPDX-License-Identifier: BSD-3-Clause
// Places of the model through the C interface: evaluation and projection.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "abi_fixture.h"
#include "carreau_geometry.h"

namespace abi_tests {
namespace {

class PlacesTest : public SessionTest {
 protected:
  void use_torus() {
    const carreau_cad cad = torus_cad(&host);
    ASSERT_EQ(carreau_set_cad(session, &cad), CARREAU_OK);
    ASSERT_EQ(torus_model(session), CARREAU_OK);
  }
};

TEST_F(PlacesTest, ProjectsToATorusBeforeAndAfterAMesh) {
  use_torus();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at(-5, 5);
  constexpr std::int64_t n = 300;
  std::vector<double> x(3 * n), uv(2 * n), closest(3 * n), distance(n), back(3 * n);
  std::vector<std::int32_t> refs(n);
  for (double& c : x) c = at(random);
  for (const bool meshed : {false, true}) {
    if (meshed) {
      ASSERT_EQ(carreau_set_real(session, "hphydef", 1), CARREAU_OK);
      ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
    }
    ASSERT_EQ(carreau_project(session, 2, 0, n, x.data(), refs.data(), uv.data(), closest.data(), distance.data()), CARREAU_OK) << error();
    ASSERT_EQ(carreau_evaluate(session, 2, 5, n, uv.data(), 0, back.data(), nullptr, nullptr), CARREAU_OK) << error();
    for (std::int64_t i = 0; i < n; ++i) {
      const double around = std::hypot(x[3 * i], x[3 * i + 1]);
      EXPECT_NEAR(distance[i], std::abs(std::hypot(around - 3, x[3 * i + 2]) - 1), 1e-11);
      EXPECT_EQ(refs[i], 5);
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(back[3 * i + k], closest[3 * i + k], 1e-11);
    }
  }
}

TEST_F(PlacesTest, VerticesOfAMeshLieOnItsModel) {
  use_paraboloid(0.5);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  const MeshData data = data_of(mesh());
  const auto n = std::int64_t(data.vertex_count());
  std::vector<double> distance(data.vertex_count());
  ASSERT_EQ(carreau_project(session, 2, 1, n, data.xyz.data(), nullptr, nullptr, nullptr, distance.data()), CARREAU_OK) << error();
  for (const double d : distance) EXPECT_LT(d, 1e-12);
  // The corners of the model are the vertices with a reference.
  ASSERT_EQ(carreau_project(session, 0, 0, n, data.xyz.data(), nullptr, nullptr, nullptr, distance.data()), CARREAU_OK) << error();
  for (std::size_t v = 0; v < distance.size(); ++v) EXPECT_EQ(distance[v] < 1e-12, data.vertex_refs[v] != 0);
}

TEST_F(PlacesTest, EvaluatesCurvesWithDerivatives) {
  use_paraboloid();
  const double t[2] = {0.25, 1};
  double xyz[6], first[6], second[6];
  ASSERT_EQ(carreau_evaluate(session, 1, 1, 2, t, 2, xyz, first, second), CARREAU_OK) << error();
  EXPECT_NEAR(xyz[0], -1.25, 1e-14);
  EXPECT_NEAR(xyz[2], (1.25 * 1.25 + 6.25) / 2, 1e-14);
  EXPECT_NEAR(first[2], 5 * -1.25, 1e-13);  // z' = x x'
  EXPECT_NEAR(second[2], 25, 1e-12);
}

TEST_F(PlacesTest, NodesKnowTheirEntities) {
  use_torus();
  for (const char* element : {"p1", "p2"}) {
    ASSERT_EQ(carreau_set_text(session, "element", element), CARREAU_OK);
    ASSERT_EQ(carreau_set_real(session, "hphydef", 1), CARREAU_OK);
    ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
    const MeshData data = data_of(mesh());
    const std::size_t n = data.vertex_count(), k = data.edge_count();
    std::vector<std::int32_t> dimensions(n), refs(n), faces(k), ics(k);
    std::vector<double> t(2 * k);
    ASSERT_EQ(carreau_mesh_vertex_entities(mesh(), std::int64_t(n), dimensions.data(), refs.data()), CARREAU_OK);
    ASSERT_EQ(carreau_mesh_edge_parameters(mesh(), std::int64_t(k), t.data(), faces.data(), ics.data()), CARREAU_OK);
    // A torus has one corner; each edge of its two seams has one more vertex, and with p2 a node.
    EXPECT_EQ(std::count(dimensions.begin(), dimensions.end(), 0), 1);
    EXPECT_EQ(std::count(dimensions.begin(), dimensions.end(), 1), std::int64_t(k * (element[1] == '2' ? 2 : 1)) - 2);
    std::vector<double> distance(1);
    for (std::size_t v = 0; v < n; ++v) {
      ASSERT_EQ(carreau_project(session, dimensions[v], refs[v], 1, &data.xyz[3 * v], nullptr, nullptr, nullptr, distance.data()), CARREAU_OK) << error();
      EXPECT_LT(distance[0], 1e-11);
    }
    for (std::size_t e = 0; e < k; ++e)
      for (std::size_t end = 0; end < 2; ++end) {
        double xyz[3];
        ASSERT_EQ(carreau_evaluate(session, 1, data.edge_refs[e], 1, &t[2 * e + end], 0, xyz, nullptr, nullptr), CARREAU_OK) << error();
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(xyz[c], data.xyz[3 * std::size_t(data.edges[2 * e + end]) + std::size_t(c)], 1e-12);
        EXPECT_EQ(faces[e], 5);
        EXPECT_GE(ics[e], 1);
      }
    EXPECT_EQ(carreau_mesh_vertex_entities(mesh(), 0, dimensions.data(), nullptr), CARREAU_ERR_ARGUMENT);
    EXPECT_EQ(carreau_mesh_edge_parameters(mesh(), 0, nullptr, nullptr, ics.data()), CARREAU_ERR_ARGUMENT);
  }
  carreau_mesh* other = nullptr;
  ASSERT_EQ(carreau_mesh_create(&other), CARREAU_OK);
  EXPECT_EQ(carreau_mesh_vertex_entities(other, 0, nullptr, nullptr), CARREAU_ERR_SEQUENCE);
  EXPECT_EQ(carreau_mesh_edge_parameters(other, 0, nullptr, nullptr, nullptr), CARREAU_ERR_SEQUENCE);
  carreau_mesh_free(other);
}

TEST_F(PlacesTest, EmbedsPlacesOfSpace) {
  use_paraboloid(0.5);
  const double point[3] = {0.3, 0.4, 0.125};
  std::int32_t ref = 0, curve = 0;
  EXPECT_EQ(carreau_model_embed_point(session, point, "probe", &ref), CARREAU_OK) << error();
  std::vector<double> line;  // the parabola y = x over the diagonal, from corner to corner
  for (int k = 0; k <= 20; ++k) {
    const double x = -2.5 + 0.25 * k;
    line.insert(line.end(), {x, x, x * x});
  }
  ASSERT_EQ(carreau_model_embed_polyline(session, 21, line.data(), "diagonal", &curve), CARREAU_OK) << error();
  std::int64_t wires = -1;
  EXPECT_EQ(carreau_model_embed_wires(session, &wires), CARREAU_OK) << error();
  EXPECT_EQ(wires, 0);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  EXPECT_EQ(defects_of(mesh()), "");
  const MeshData data = data_of(mesh());
  EXPECT_EQ(std::count(data.vertex_refs.begin(), data.vertex_refs.end(), ref), 1);
  EXPECT_GE(std::count(data.edge_refs.begin(), data.edge_refs.end(), curve), 14);
  double apart = 0;
  for (std::size_t e = 0; e < data.edge_count(); ++e)
    for (const std::int32_t v : {data.edges[2 * e], data.edges[2 * e + 1]})
      if (data.edge_refs[e] == curve) apart = std::max(apart, std::abs(data.xyz[3 * std::size_t(v)] - data.xyz[3 * std::size_t(v) + 1]));
  EXPECT_LT(apart, 1e-7);
  EXPECT_EQ(carreau_model_embed_polyline(session, 0, nullptr, nullptr, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_model_embed_polyline(session, 2, nullptr, nullptr, nullptr), CARREAU_ERR_ARGUMENT);
  const double far[3] = {0, 0, 1};
  EXPECT_EQ(carreau_model_embed_point(session, far, nullptr, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_NE(error().find("embed_tolerance"), std::string::npos) << error();
  ASSERT_EQ(carreau_set_real(session, "embed_tolerance", 2), CARREAU_OK);
  EXPECT_EQ(carreau_model_embed_point(session, far, nullptr, nullptr), CARREAU_OK) << error();
}

TEST_F(PlacesTest, NamesErrorsAndRejectsCallsFromCallbacks) {
  const double x[3] = {0, 0, 1}, uv[2] = {0, 0};
  double out[3];
  EXPECT_EQ(carreau_project(session, 2, 0, 1, x, nullptr, nullptr, out, nullptr), CARREAU_ERR_SEQUENCE);
  use_paraboloid();
  EXPECT_EQ(carreau_project(session, 3, 0, 1, x, nullptr, nullptr, out, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_project(session, 2, 9, 1, x, nullptr, nullptr, out, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_NE(error().find("9"), std::string::npos);
  EXPECT_EQ(carreau_project(session, 2, 0, -1, x, nullptr, nullptr, out, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_project(session, 2, 0, 1, nullptr, nullptr, nullptr, out, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_project(session, 2, 0, 0, nullptr, nullptr, nullptr, nullptr, nullptr), CARREAU_OK) << error();
  const double infinite[3] = {0, std::numeric_limits<double>::infinity(), 0};
  EXPECT_EQ(carreau_project(session, 2, 0, 1, infinite, nullptr, nullptr, out, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_evaluate(session, 0, 1, 1, uv, 0, out, nullptr, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_evaluate(session, 2, 1, 1, uv, 3, out, nullptr, nullptr), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_evaluate(session, 2, 1, 1, uv, 0, out, out, nullptr), CARREAU_ERR_ARGUMENT);
  host.probe_busy = 1;
  EXPECT_EQ(carreau_project(session, 2, 0, 1, x, nullptr, nullptr, out, nullptr), CARREAU_OK) << error();
  EXPECT_EQ(host.busy_status, CARREAU_ERR_BUSY);
  host.misbehaviour = HOST_NAN, host.misbehave_from = 0;
  const carreau_cad cad = paraboloid_cad(&host);
  ASSERT_EQ(carreau_set_cad(session, &cad), CARREAU_OK);
  EXPECT_EQ(carreau_project(session, 2, 0, 1, x, nullptr, nullptr, out, nullptr), CARREAU_ERR_CALLBACK);
  host.misbehaviour = HOST_FINE, host.stop_at = host.calls + 10;
  EXPECT_EQ(carreau_project(session, 2, 0, 1, x, nullptr, nullptr, out, nullptr), CARREAU_ERR_CANCELLED);
  host.stop_at = 0;
  EXPECT_EQ(carreau_project(session, 2, 0, 1, x, nullptr, nullptr, out, nullptr), CARREAU_OK) << error();
}

}  // namespace
}  // namespace abi_tests
