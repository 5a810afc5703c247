// SPDX-License-Identifier: BSD-3-Clause
// Measures of the delivered mesh, through the C interface.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <set>

#include "abi_fixture.h"

namespace abi_tests {
namespace {

carreau_delivered evaluation_of(carreau_session* session) {
  auto result = sized<carreau_delivered>();
  EXPECT_EQ(carreau_session_delivered(session, &result), CARREAU_OK) << carreau_last_error(session);
  return result;
}

carreau_measure measure_of(carreau_session* session, std::int32_t kind) {
  auto result = sized<carreau_measure>();
  EXPECT_EQ(carreau_delivered_measure(session, kind, &result), CARREAU_OK) << carreau_last_error(session);
  return result;
}

std::vector<double> values_of(carreau_session* session, std::int32_t kind) {
  std::vector<double> values(std::size_t(measure_of(session, kind).values));
  EXPECT_EQ(carreau_delivered_values(session, kind, std::int64_t(values.size()), values.data()), CARREAU_OK);
  return values;
}

TEST_F(SessionTest, MeasuresTheDeliveredMesh) {
  const double h = 0.2;
  use_paraboloid(h);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  const MeshData data = data_of(mesh());
  const std::int64_t surf0 = report().surf0_calls, calls = host.calls;
  const carreau_delivered delivered = evaluation_of(session);
  EXPECT_GT(host.calls, calls);
  EXPECT_EQ(report().surf0_calls, surf0);  // counted apart
  EXPECT_EQ(delivered.vertices, std::int64_t(data.vertex_count()));
  EXPECT_EQ(delivered.triangles, std::int64_t(data.triangle_count()));
  EXPECT_EQ(delivered.vertices - delivered.edges + delivered.triangles, 1);  // a disc
  EXPECT_EQ(delivered.folded_triangles, 0);
  EXPECT_GE(delivered.in_range, 0.99);
  EXPECT_GT(delivered.surf1_calls, 0);
  EXPECT_NE(std::string(delivered.text).find("shape Q2: mean 0.9"), std::string::npos) << delivered.text;

  // Edges: each once, between a chord and the arc of the parabola, over h.
  std::vector<std::int32_t> edges(2 * std::size_t(delivered.edges)), curves(std::size_t(delivered.edges));
  ASSERT_EQ(carreau_delivered_edges(session, delivered.edges, edges.data(), curves.data()), CARREAU_OK) << error();
  const std::vector<double> lengths = values_of(session, CARREAU_MEASURE_LENGTH);
  ASSERT_EQ(lengths.size(), curves.size());
  std::set<std::pair<int, int>> known;
  for (std::size_t e = 0; e < lengths.size(); ++e) {
    ASSERT_LT(edges[2 * e], edges[2 * e + 1]);
    known.insert({edges[2 * e], edges[2 * e + 1]});
    const double* p = &data.xyz[3 * std::size_t(edges[2 * e])];
    const double* q = &data.xyz[3 * std::size_t(edges[2 * e + 1])];
    const double chord = std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]) / h;
    ASSERT_GE(lengths[e], chord * (1 - 1e-6));
    ASSERT_LE(lengths[e], chord * 1.01);
  }
  EXPECT_EQ(known.size(), lengths.size());
  EXPECT_EQ(std::count_if(curves.begin(), curves.end(), [](int ref) { return ref != 0; }),
            std::int64_t(data.edge_count()));
  std::vector<std::int32_t> sides(3 * data.triangle_count());
  ASSERT_EQ(carreau_delivered_triangle_edges(session, delivered.triangles, sides.data()), CARREAU_OK) << error();
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const std::int32_t a = data.triangles[k], b = data.triangles[k % 3 == 2 ? k - 2 : k + 1];
    ASSERT_EQ(edges[2 * std::size_t(sides[k])], std::min(a, b));
    ASSERT_EQ(edges[2 * std::size_t(sides[k]) + 1], std::max(a, b));
  }
}

TEST_F(SessionTest, EveryKindHasItsSpreadAndHistogram) {
  use_paraboloid(0.3);
  ASSERT_EQ(carreau_set_integer(session, "hgeo_flag", 1), CARREAU_OK);
  ASSERT_EQ(carreau_set_integer(session, "measure", 1), CARREAU_OK);
  ASSERT_EQ(carreau_set_integer(session, "measure_bounds", 2), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  const std::int64_t calls = host.calls;
  const carreau_delivered delivered = evaluation_of(session);
  for (std::int32_t kind = CARREAU_MEASURE_LENGTH; kind <= CARREAU_MEASURE_BOUND_SHARE; ++kind) {
    const carreau_measure m = measure_of(session, kind);
    std::vector<double> values = values_of(session, kind);
    EXPECT_EQ(m.values, m.entity == CARREAU_OF_EDGES      ? delivered.edges
                        : m.entity == CARREAU_OF_VERTICES ? delivered.vertices
                                                          : delivered.triangles)
        << m.title;
    // Nothing is singular here, but edges inside the face are on no curve.
    const bool of_curves = kind == CARREAU_MEASURE_CURVE_A0 || kind == CARREAU_MEASURE_CURVE_A1;
    std::erase_if(values, [](double x) { return std::isnan(x); });
    EXPECT_EQ(m.count, std::int64_t(values.size())) << m.title;
    EXPECT_TRUE(of_curves ? 0 < m.count && m.count < m.values : m.count == m.values) << m.title;
    EXPECT_EQ(m.min, *std::min_element(values.begin(), values.end()));
    EXPECT_EQ(m.max, *std::max_element(values.begin(), values.end()));
    EXPECT_TRUE(m.min <= m.p1 && m.p1 <= m.mean && m.mean <= m.p99 && m.p99 <= m.max) << m.title;
    std::vector<double> bounds(std::size_t(m.classes));
    std::vector<std::int64_t> counts(std::size_t(m.classes));
    ASSERT_EQ(carreau_delivered_histogram(session, kind, m.classes, bounds.data(), counts.data()), CARREAU_OK);
    EXPECT_EQ(bounds[0], -std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      const double to = i + 1 < bounds.size() ? bounds[i + 1] : std::numeric_limits<double>::infinity();
      EXPECT_EQ(counts[i],
                std::count_if(values.begin(), values.end(), [&](double x) { return x >= bounds[i] && x < to; }))
          << m.title << ", class " << i;
    }
    const bool limited = kind == CARREAU_MEASURE_EDGE_ANGLE || kind == CARREAU_MEASURE_CURVE_A1 ||
                         kind == CARREAU_MEASURE_VERTEX_ANGLE;
    EXPECT_EQ(m.limit, limited ? 8 : std::numeric_limits<double>::infinity()) << m.title;
    EXPECT_EQ(m.beyond,
              std::count_if(values.begin(), values.end(), [&](double x) { return x > m.limit * (1 + 1e-9); }));
  }
  EXPECT_EQ(host.calls, calls);  // the run has measured
  EXPECT_GT(delivered.not_met, 0);
}

TEST_F(SessionTest, BoundsAreReportedOnRequest) {
  use_paraboloid(0.3);
  for (const std::int32_t asked : {1, 2}) {  // of cross-patch meshes alone; of all
    ASSERT_EQ(carreau_set_integer(session, "measure_bounds", asked), CARREAU_OK);
    ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
    const std::vector<double> seen[] = {values_of(session, CARREAU_MEASURE_A0), values_of(session, CARREAU_MEASURE_A1)};
    const std::vector<double> bounds[] = {values_of(session, CARREAU_MEASURE_A0_BOUND),
                                          values_of(session, CARREAU_MEASURE_A1_BOUND)};
    EXPECT_EQ(measure_of(session, CARREAU_MEASURE_BOUND_SHARE).count, asked == 2 ? std::int64_t(seen[0].size()) : 0);
    for (int i = 0; i < 2; ++i)
      for (std::size_t t = 0; t < seen[i].size(); ++t) {
        ASSERT_EQ(std::isnan(bounds[i][t]), asked == 1);
        if (asked == 1) continue;
        ASSERT_GE(bounds[i][t], seen[i][t]);
        ASSERT_LE(bounds[i][t], 1.6 * seen[i][t] + 0.6);
      }
  }
}

TEST_F(SessionTest, WritesJsonAndVtuOfTheDeliveredMesh) {
  use_paraboloid(0.5);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  const std::string json = testing::TempDir() + "carreau_delivered.json",
                    vtu = testing::TempDir() + "carreau_delivered.vtu";
  ASSERT_EQ(carreau_delivered_write(session, json.c_str()), CARREAU_OK) << error();
  ASSERT_EQ(carreau_mesh_write(mesh(), vtu.c_str()), CARREAU_OK);
  const auto content = [](const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_EQ(content(json).find("{\n  \"format\": \"carreau delivered 1\",\n  \"mesh\": {\n    \"faces\": 1,"), 0u);
  EXPECT_NE(content(vtu).find("Name=\"A0\""), std::string::npos);
  std::remove(json.c_str());
  std::remove(vtu.c_str());
}

TEST_F(SessionTest, RejectsMeshesThatCannotBeMeasured) {
  auto delivered = sized<carreau_delivered>();
  EXPECT_EQ(carreau_session_delivered(nullptr, &delivered), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_session_delivered(session, &delivered), CARREAU_ERR_SEQUENCE);
  EXPECT_EQ(carreau_delivered_write(session, "x.json"), CARREAU_ERR_SEQUENCE);
  use_paraboloid(0.5);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  EXPECT_EQ(carreau_session_delivered(session, nullptr), CARREAU_ERR_ARGUMENT);
  auto measure = sized<carreau_measure>();
  for (const std::int32_t kind : {-1, 0, 17}) {
    EXPECT_EQ(carreau_delivered_measure(session, kind, &measure), CARREAU_ERR_ARGUMENT);
    EXPECT_NE(error().find("there is no measure " + std::to_string(kind)), std::string::npos) << error();
  }
  double value = 0;
  EXPECT_EQ(carreau_delivered_values(session, CARREAU_MEASURE_A0, 1, &value), CARREAU_ERR_ARGUMENT);
  EXPECT_NE(error().find("room for 1 rows"), std::string::npos) << error();
  EXPECT_EQ(carreau_delivered_write(session, "/no/such/folder/x.json"), CARREAU_ERR_FILE);

  // A host that fails or stops now: the mesh stays, and can be measured later.
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  host.misbehaviour = HOST_STATUS;
  host.misbehave_from = 0;
  EXPECT_EQ(carreau_session_delivered(session, &delivered), CARREAU_ERR_CALLBACK);
  host.misbehaviour = HOST_FINE;
  host.stop_at = host.calls + 10;
  EXPECT_EQ(carreau_session_delivered(session, &delivered), CARREAU_ERR_CANCELLED);
  host.stop_at = 0;
  EXPECT_EQ(carreau_session_delivered(session, &delivered), CARREAU_OK) << error();
  EXPECT_EQ(delivered.triangles, std::int64_t(data_of(mesh()).triangle_count()));
}

}  // namespace
}  // namespace abi_tests
