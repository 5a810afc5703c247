// SPDX-License-Identifier: BSD-3-Clause
// Metric callbacks of a host: valid and invalid answers.
#include <cmath>
#include <limits>
#include <numbers>

#include "abi_fixture.h"

namespace {

using namespace abi_tests;

struct MetricHost {
  std::int32_t status = 0, kind = CARREAU_METRIC_NONE;
  std::array<double, 6> value{};
  std::int64_t surface = 0, curves = 0, points = 0;  // calls
  bool wrote_before = false;                         // kind or value were set before the call
  carreau_session* stop = nullptr;
};

std::int32_t answer(MetricHost& host, std::int32_t* kind, double* value) {
  host.wrote_before |= *kind != CARREAU_METRIC_NONE || !std::isnan(value[0]) || !std::isnan(value[5]);
  if (host.stop != nullptr) carreau_stop(host.stop);
  *kind = host.kind;
  std::copy(host.value.begin(), host.value.end(), value);
  return host.status;
}
std::int32_t on_surface(std::int32_t, double, double, std::int32_t* kind, double* value, void* user) {
  auto& host = *static_cast<MetricHost*>(user);
  ++host.surface;
  return answer(host, kind, value);
}
std::int32_t on_curve(std::int32_t, std::int32_t, double, std::int32_t* kind, double* value, void* user) {
  auto& host = *static_cast<MetricHost*>(user);
  ++host.curves;
  return answer(host, kind, value);
}
std::int32_t at_point(std::int32_t, std::int32_t* kind, double* value, void* user) {
  auto& host = *static_cast<MetricHost*>(user);
  ++host.points;
  return answer(host, kind, value);
}

class MetricCallbacks : public SessionTest {
 protected:
  void SetUp() override {
    SessionTest::SetUp();
    use_paraboloid();
    auto callbacks = sized<carreau_metric_callbacks>();
    callbacks.user = &metric;
    callbacks.surface_metric = on_surface;
    callbacks.curve_metric = on_curve;
    callbacks.point_metric = at_point;
    ASSERT_EQ(carreau_set_metric_callbacks(session, &callbacks), CARREAU_OK) << error();
  }
  std::string sentence_of(std::int32_t kind, std::array<double, 6> value) {
    metric.kind = kind;
    metric.value = value;
    EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_CALLBACK);
    return error();
  }
  MetricHost metric;
};

TEST_F(MetricCallbacks, SilenceMakesTheMeshOfTheSizesAlone) {
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  EXPECT_GT(metric.surface, 0);
  EXPECT_GT(metric.curves, 0);
  EXPECT_GT(metric.points, 0);
  EXPECT_FALSE(metric.wrote_before);
  std::int64_t with = 0, without = 0;
  carreau_mesh_count(mesh(), nullptr, &with, nullptr, nullptr);
  metric.status = CARREAU_NO_ANSWER;
  metric.kind = 77;
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  carreau_mesh_count(mesh(), nullptr, &without, nullptr, nullptr);
  EXPECT_EQ(with, without);
  auto none = sized<carreau_metric_callbacks>();
  ASSERT_EQ(carreau_set_metric_callbacks(session, &none), CARREAU_OK) << error();
  metric.surface = 0;
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  EXPECT_EQ(metric.surface, 0);
  carreau_mesh_count(mesh(), nullptr, &without, nullptr, nullptr);
  EXPECT_NEAR(static_cast<double>(with), static_cast<double>(without), 0.02 * static_cast<double>(without));
}

// The same size by its three names: hphydef, SIZE, SPACE and TANGENT make meshes of as many triangles.
TEST_F(MetricCallbacks, AnIsotropicMetricIsASize) {
  ASSERT_EQ(carreau_set_real(session, "hphydef", 0.2), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  std::int64_t usual = 0;
  carreau_mesh_count(mesh(), nullptr, &usual, nullptr, nullptr);
  ASSERT_EQ(carreau_set_real(session, "hphydef", 1), CARREAU_OK);
  const double k = 1 / (0.2 * 0.2);
  const std::vector<std::pair<std::int32_t, std::array<double, 6>>> answers = {
      {CARREAU_METRIC_SIZE, {0.2}},
      {CARREAU_METRIC_SPACE, {k, 0, 0, k, 0, k}},
      {CARREAU_METRIC_TANGENT, {0.2, 0.2, 1, 2, 3}}};
  for (const auto& [kind, value] : answers) {
    metric.kind = kind;
    metric.value = value;
    ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
    std::int64_t triangles = 0;
    carreau_mesh_count(mesh(), nullptr, &triangles, nullptr, nullptr);
    EXPECT_NEAR(static_cast<double>(triangles), static_cast<double>(usual), 0.02 * static_cast<double>(usual)) << kind;
    EXPECT_EQ(defects_of(mesh()), "");
  }
}

// The plane metric of sizes 0.25 along x and 0.025 along y, seen from above: the mesh has unit edges in it.
TEST_F(MetricCallbacks, AMetricOfSpaceGovernsTheMesh) {
  metric.kind = CARREAU_METRIC_SPACE;
  // z counts for little, so that lengths are lengths of the projection on the plane.
  metric.value = {16, 0, 0, 1600, 0, 1e-4};
  ASSERT_EQ(carreau_set_real(session, "hphymin", 0.01), CARREAU_OK);
  ASSERT_EQ(carreau_set_real(session, "hphymax", 100), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  const MeshData data = data_of(mesh());
  double sum = 0;
  std::size_t in_range = 0, count = 0;
  for (std::size_t t = 0; t < data.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) {
      const double* p = &data.xyz[3 * data.triangles[3 * t + i]];
      const double* q = &data.xyz[3 * data.triangles[3 * t + (i + 1) % 3]];
      const double l = std::hypot((q[0] - p[0]) / 0.25, (q[1] - p[1]) / 0.025);
      sum += l;
      ++count;
      in_range += l >= std::numbers::sqrt2 / 2 && l <= std::numbers::sqrt2 ? 1 : 0;
    }
  EXPECT_NEAR(sum / static_cast<double>(count), 1, 0.02);
  EXPECT_GE(static_cast<double>(in_range), 0.99 * static_cast<double>(count));
  // 25 / (0.25 0.025 sqrt(3) / 4)
  EXPECT_NEAR(static_cast<double>(data.triangle_count()), 9238, 0.05 * 9238);
  EXPECT_EQ(defects_of(mesh()), "");
}

TEST_F(MetricCallbacks, UnusableMetricsHaveASentenceWithThePlaceAndTheMatrix) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(sentence_of(CARREAU_METRIC_SPACE, {1, 2, 0, 1, 0, 1}),
            "face 1, curve 1 (reference 1), t = 0: the metric callback returned the metric (xx, xy, xz, yy, yz, zz) = "
            "(1, 2, 0, 1, 0, 1), which is not "
            "positive definite");
  EXPECT_NE(sentence_of(CARREAU_METRIC_SPACE, {1, 0, 0, nan, 0, 1}).find("which is not finite"), std::string::npos);
  EXPECT_NE(sentence_of(CARREAU_METRIC_SPACE, {1, 0, 0, 1, 0, 0}).find("not positive definite"), std::string::npos);
  EXPECT_NE(sentence_of(CARREAU_METRIC_SIZE, {infinity}).find("which is not a finite number"), std::string::npos);
  EXPECT_NE(sentence_of(CARREAU_METRIC_SIZE, {-0.5}).find("the size -0.5, which is not positive"), std::string::npos);
  EXPECT_NE(sentence_of(CARREAU_METRIC_SIZE, {0}).find("the size 0, which is not positive"), std::string::npos);
  EXPECT_NE(sentence_of(CARREAU_METRIC_TANGENT, {1, -1, 1, 0, 0}).find("the sizes 1 and -1, which must be positive"),
            std::string::npos);
  EXPECT_NE(sentence_of(CARREAU_METRIC_TANGENT, {1, 1, 0, 0, 0}).find("the direction (0, 0, 0)"), std::string::npos);
  EXPECT_NE(sentence_of(4, {1}).find("returned the kind 4, which does not exist"), std::string::npos);
  metric.status = 9;
  EXPECT_NE(sentence_of(CARREAU_METRIC_SIZE, {1}).find("returned the status 9"), std::string::npos);
  // Inside the face the sentence has u and v.
  auto callbacks = sized<carreau_metric_callbacks>();
  callbacks.user = &metric;
  callbacks.surface_metric = on_surface;
  ASSERT_EQ(carreau_set_metric_callbacks(session, &callbacks), CARREAU_OK);
  metric.status = 0;
  EXPECT_EQ(sentence_of(CARREAU_METRIC_SPACE, {1, 2, 0, 1, 0, 1}).find("face 1, u = "), 0U) << error();
  auto place = sized<carreau_error_place>();
  ASSERT_EQ(carreau_last_error_place(session, &place), CARREAU_OK);
  EXPECT_EQ(place.face, 1);
  EXPECT_TRUE(std::isfinite(place.uv[0]));
}

/// The size 0.1 + (u^2 + v^2) / 10, by u and v or by the point in space: z = (u^2 + v^2) / 2 on the paraboloid.
struct Batches {
  std::int64_t calls = 0, points = 0;
  bool on_surface = true;  // xyz belongs to uv
  std::int32_t status = 0;
};
std::int32_t graded(std::int32_t, double u, double v, std::int32_t* kind, double* value, void*) {
  *kind = CARREAU_METRIC_SIZE, *value = 0.1 + (u * u + v * v) / 10;
  return 0;
}
std::int32_t graded_batch(std::int32_t, std::int64_t n, const double* uv, const double* xyz, std::int32_t* kind,
                          double* value, void* user) {
  auto& batches = *static_cast<Batches*>(user);
  ++batches.calls, batches.points += n;
  for (std::int64_t i = 0; i < n; ++i) {
    const double S[2] = {uv[2 * i], uv[2 * i + 1]};
    batches.on_surface = batches.on_surface && xyz[3 * i] == S[0] && xyz[3 * i + 1] == S[1];
    graded(1, S[0], S[1], kind + i, value + 6 * i, nullptr);
  }
  return batches.status;
}

TEST_F(MetricCallbacks, BatchesMakeTheMeshOfSinglePoints) {
  auto callbacks = sized<carreau_metric_callbacks>();
  callbacks.surface_metric = graded;
  ASSERT_EQ(carreau_set_metric_callbacks(session, &callbacks), CARREAU_OK);
  ASSERT_EQ(carreau_set_real(session, "hphymin", 0.01), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  const auto single = data_of(mesh());
  Batches batches;
  callbacks.surface_metric_batch = graded_batch;
  callbacks.user = &batches;
  ASSERT_EQ(carreau_set_metric_callbacks(session, &callbacks), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  EXPECT_EQ(data_of(mesh()), single);
  EXPECT_TRUE(batches.on_surface);
  EXPECT_GT(batches.points, 3 * batches.calls);
  batches.status = 9;
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_CALLBACK);
  EXPECT_NE(error().find("surface_metric_batch returned the status 9"), std::string::npos) << error();
}

TEST_F(MetricCallbacks, AreNotCalledWhenPhysicalSizesAreIgnored) {
  ASSERT_EQ(carreau_set_integer(session, "hphy_flag", 0), CARREAU_OK);
  ASSERT_EQ(carreau_set_integer(session, "hgeo_flag", 1), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  EXPECT_EQ(metric.surface + metric.curves + metric.points, 0);
}

TEST_F(MetricCallbacks, CanStopTheRun) {
  metric.stop = session;
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_CANCELLED);
  EXPECT_EQ(metric.surface + metric.curves + metric.points, 1);
}

TEST_F(MetricCallbacks, ASmallAndALargeSizeAreClamped) {
  metric.kind = CARREAU_METRIC_TANGENT;
  metric.value = {1e-9, 1e-3, 1, 0, 0};
  ASSERT_EQ(carreau_set_real(session, "hphymin", 0.5), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  for (const double h : data_of(mesh()).sizes) EXPECT_NEAR(h, 0.5, 1e-9);
}

TEST_F(MetricCallbacks, NeedTheirSize) {
  carreau_metric_callbacks callbacks{};
  EXPECT_EQ(carreau_set_metric_callbacks(session, &callbacks), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_set_metric_callbacks(session, nullptr), CARREAU_ERR_ARGUMENT);
}

}  // namespace
