// SPDX-License-Identifier: BSD-3-Clause
// Cross-patch meshes under sizes by direction: unit edges over borders that mean nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <numbers>

#include "common/field_source.h"
#include "independent/patchworks.h"
#include "metric/metric3_algebra.h"
#include "session_of_size.h"

namespace carreau {
namespace {

using namespace testing;

double share_of_unit_edges(Session& session) {
  const std::vector<double>& lengths = session.delivered()[EvaluationKind::length].values;
  const auto in =
      std::ranges::count_if(lengths, [](double l) { return l >= std::numbers::sqrt2 / 2 && l <= std::numbers::sqrt2; });
  return static_cast<double>(in) / static_cast<double>(lengths.size());
}

std::unique_ptr<Session> meshed_by(const AnalyticCad& cad, const Metric3& metric, const char* patches, Monitor& monitor,
                                   int threads = 1) {
  auto session = session_of_size(cad, 1, monitor);
  session->set_prescription_source(std::make_shared<testing::FieldSource>(
      testing::field_of_space([metric](Vec3) { return Prescription::of_space(metric); })));
  session->parameters().set("patches", patches);
  session->parameters().set("threads", threads);
  session->make_mesh();
  EXPECT_EQ(find_defects(session->mesh(), {.closed = true}), std::vector<std::string>{});
  return session;
}

// A constant metric of space makes a spheroid of the sphere; 80 patches, some of which are narrower than its long
// edges, mean nothing.
TEST(IndependentByDirection, SphereOfPatchesHasTheTrianglesOfASpheroid) {
  Monitor quiet;
  const double h1 = 0.15, h3 = 0.6, a = 1 / h1, c = 1 / h3, e = std::sqrt(1 - c * c / (a * a));
  const Metric3 metric{a * a, 0, 0, a * a, 0, c * c};
  const double area = 2 * std::numbers::pi * a * a * (1 + (1 - e * e) / e * std::atanh(e));
  const double wanted = area / (std::numbers::sqrt3 / 4);
  const AnalyticCad cad = sphere_of_triangles(1);
  const auto patches = meshed_by(cad, metric, "dependent", quiet), freed = meshed_by(cad, metric, "independent", quiet);
  EXPECT_TRUE(freed->mesh().independent);
  EXPECT_NEAR(static_cast<double>(freed->mesh().triangle_count()) / wanted, 1, 0.08);
  EXPECT_LT(freed->mesh().triangle_count(), patches->mesh().triangle_count());
  EXPECT_GE(share_of_unit_edges(*freed), 0.97);
  EXPECT_GE(share_of_unit_edges(*freed), share_of_unit_edges(*patches));
  EXPECT_GE(freed->delivered()[EvaluationKind::metric_quality].spread.mean, 0.94);
  for (const Vec3& p : freed->mesh().vertices) EXPECT_NEAR(norm(p), 1, 1e-12);
}

TEST(IndependentByDirection, MeshDoesNotDependOnThreads) {
  Monitor quiet;
  const Metric3 metric{25, 0, 0, 25, 0, 4};
  const AnalyticCad cad = sphere_of_triangles(1);
  const auto one = meshed_by(cad, metric, "independent", quiet, 1),
             four = meshed_by(cad, metric, "independent", quiet, 4);
  EXPECT_EQ(one->mesh().vertices, four->mesh().vertices);
  EXPECT_EQ(one->exported().triangles, four->exported().triangles);
}

// On a plane side a metric of directions that turn with the place: edges are unit, corners and sharp edges of the cube
// exact.
TEST(IndependentByDirection, SquaresOfACubeMeanNothingToAMetricThatTurns) {
  Monitor quiet;
  const AnalyticCad cad = cube_of_squares(6);
  auto session = session_of_size(cad, 1, quiet);
  session->set_prescription_source(std::make_shared<testing::FieldSource>(testing::field_of_space([](Vec3 p) {
    const double t = p.x() + p.y() + p.z();
    return Prescription::of_space(metric_of_sizes({std::cos(t), std::sin(t), 0.3}, 0.3, 0.1));
  })));
  session->parameters().set("patches", "independent");
  session->make_mesh();
  EXPECT_EQ(find_defects(session->mesh(), {.closed = true}), std::vector<std::string>{});
  EXPECT_GE(share_of_unit_edges(*session), 0.95);
  double area = 0;
  const FlatMesh mesh = session->exported();
  for (const auto& [i, j, k] : mesh.triangles)
    area += norm(cross(mesh.vertices[j] - mesh.vertices[i], mesh.vertices[k] - mesh.vertices[i])) / 2;
  EXPECT_NEAR(area, 6, 1e-12);
}

}  // namespace
}  // namespace carreau
