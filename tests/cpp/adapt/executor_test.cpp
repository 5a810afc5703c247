// SPDX-License-Identifier: BSD-3-Clause
// Estimates and transfers do not depend on the process that makes them, and each process calls its own function for its
// share only.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <vector>

#include "adapt/differences.h"
#include "adapt/transfer.h"
#include "common/thread_team.h"
#include "support/error.h"
#include "test_meshes.h"

namespace carreau {
namespace {

using testing::in_processes;
using testing::square_mesh;
using testing::TestMesh;

double front(const Vec3& p) { return std::tanh(8 * (p.y() - p.x() * p.x() / 2)); }

EstimatorOptions options_of(ErrorSource source, ErrorShape shape) {
  EstimatorOptions options;
  options.source = source, options.shape = shape;
  options.hmin = 0.001, options.hmax = 1;
  options.tolerance = source == ErrorSource::curvature ? 5 : 0.01;
  return options;
}

void expect_same(const VertexPrescriptions& a, const VertexPrescriptions& b) {
  EXPECT_EQ(a.sizes, b.sizes);
  EXPECT_EQ(a.unreliable, b.unreliable);
  ASSERT_EQ(a.metrics.size(), b.metrics.size());
  for (std::size_t v = 0; v < a.metrics.size(); ++v)
    for (const auto entry : {&Metric3::xx, &Metric3::xy, &Metric3::xz, &Metric3::yy, &Metric3::yz, &Metric3::zz})
      ASSERT_EQ(a.metrics[v].*entry, b.metrics[v].*entry) << v;
}

/// make(executor) of three processes with two threads each, and of one with three, equals the result of one thread.
template <typename Make, typename Same>
void expect_same_of_all(const Make& make, const Same& same) {
  const auto one = make(Executor{});
  same(one, make(Executor{nullptr, 3}));
  const auto thrown = in_processes(3, [&](Team& team) { same(one, make(Executor{&team, 2})); });
  for (const std::string& sentence : thrown) EXPECT_EQ(sentence, "");
}

TEST(SharedEstimates, MatchOneThread) {
  const TestMesh mesh = square_mesh(40).with(front);
  for (const EstimatorOptions& options :
       {options_of(ErrorSource::hessian, ErrorShape::isotropic), options_of(ErrorSource::hessian, ErrorShape::anisotropic),
        options_of(ErrorSource::curvature, ErrorShape::graph), options_of(ErrorSource::deformation, ErrorShape::isotropic)})
    expect_same_of_all([&](const Executor& executor) { return estimate(mesh.field(), options, executor); }, expect_same);
}

TEST(SharedEstimates, SeveralFieldsMatchOneThread) {
  const TestMesh mesh = square_mesh(30);
  std::vector<double> values;
  for (const Vec3& p : mesh.vertices) values.insert(values.end(), {front(p), p.x() * p.x() * p.x()});
  const EstimatorOptions options = options_of(ErrorSource::hessian, ErrorShape::anisotropic);
  expect_same_of_all([&](const Executor& executor) { return estimate_all(mesh.vertices, mesh.triangles, values, 2, options, executor); },
                     expect_same);
}

TEST(SharedEstimates, EachProcessEvaluatesItsShareOfAFunction) {
  const TestMesh mesh = square_mesh(40);
  const EstimatorOptions options = options_of(ErrorSource::hessian, ErrorShape::anisotropic);
  std::atomic<std::int64_t> asked{0};
  const FieldFunction exact = [&](std::span<const Vec3> points, std::span<double> values) {
    asked += static_cast<std::int64_t>(points.size());
    std::ranges::transform(points, values.begin(), front);
  };
  const VertexPrescriptions one = estimate_function(mesh.vertices, mesh.triangles, exact, options);
  const std::int64_t alone = asked.exchange(0);
  const auto thrown = in_processes(4, [&](Team& team) {
    Monitor silent;
    const Executor executor{&team, 1};
    expect_same(one, estimate_function(mesh.vertices, mesh.triangles, shared_function(exact, executor, silent), options, executor));
  });
  for (const std::string& sentence : thrown) EXPECT_EQ(sentence, "");
  // All points once, and of 64 one more by each.
  EXPECT_GE(asked, alone);
  EXPECT_LE(asked, alone + 4 * (alone / 64 + 2));
}

TEST(SharedEstimates, NameTheProcessWhoseFunctionDiffers) {
  const TestMesh mesh = square_mesh(10);
  const auto thrown = in_processes(3, [&](Team& team) {
    Monitor silent;
    const FieldFunction own = [&](std::span<const Vec3> points, std::span<double> values) {
      std::ranges::transform(points, values.begin(), front);
      if (team.rank() == 2) values.front() += 1e-9;
    };
    std::vector<double> values(mesh.vertices.size());
    shared_function(own, {&team, 1}, silent)(mesh.vertices, values);
  });
  for (const std::string& sentence : thrown) EXPECT_NE(sentence.find("the field differs on rank 2"), std::string::npos) << sentence;
}

TEST(SharedEstimates, TheFailureOfOneFunctionReachesAll) {
  const TestMesh mesh = square_mesh(40);
  const auto thrown = in_processes(3, [&](Team& team) {
    Monitor silent;
    const FieldFunction own = [&](std::span<const Vec3> points, std::span<double> values) {
      std::ranges::transform(points, values.begin(), front);
      if (team.rank() == 1) throw CallbackError(Where{}, "no value");
    };
    std::vector<double> values(mesh.vertices.size());
    shared_function(own, {&team, 1}, silent)(mesh.vertices, values);
  });
  for (const std::string& sentence : thrown) EXPECT_NE(sentence.find("no value"), std::string::npos) << sentence;
}

TEST(SharedEstimates, StopWithOneProcess) {
  const TestMesh mesh = square_mesh(40).with(front);
  const auto thrown = in_processes(3, [&](Team& team) {
    Monitor monitor;
    if (team.rank() == 0) monitor.request_stop();
    (void)estimate(mesh.field(), options_of(ErrorSource::hessian, ErrorShape::isotropic), {&team, 1}, &monitor);
  });
  for (const std::string& sentence : thrown) EXPECT_NE(sentence.find("stop"), std::string::npos) << sentence;
}

/// Faces side by side: columns of the square.
SurfaceMesh columns(const TestMesh& mesh, int n) {
  SurfaceMesh result;
  result.vertices = mesh.vertices;
  result.vertex_ref.resize(mesh.vertices.size());
  for (int c = 0; c < n; ++c) {
    FaceMesh face;
    face.ref = c + 1;
    std::vector<std::int32_t> local(mesh.vertices.size(), -1);
    for (const auto& t : mesh.triangles) {
      const double x = (mesh.vertices[t[0]].x() + mesh.vertices[t[1]].x() + mesh.vertices[t[2]].x()) / 3;
      if (std::min(n - 1, static_cast<int>((x + 1) / 2 * n)) != c) continue;
      std::array<std::int32_t, 3> corners{};
      for (std::size_t k = 0; k < 3; ++k) {
        if (local[t[k]] < 0) {
          local[t[k]] = static_cast<std::int32_t>(face.vertex.size());
          face.vertex.push_back(t[k]);
          face.uv.push_back({mesh.vertices[t[k]].x(), mesh.vertices[t[k]].y()});
        }
        corners[k] = local[t[k]];
      }
      face.triangles.push_back(corners);
    }
    result.faces.push_back(std::move(face));
  }
  return result;
}

TEST(SharedTransfer, MatchesOneThread) {
  const SurfaceMesh from = columns(square_mesh(24), 7), to = columns(square_mesh(37), 9);  // two faces of the new mesh are no faces of the old one
  std::vector<double> values;
  for (const Vec3& p : from.vertices) values.insert(values.end(), {front(p), p.x()});
  expect_same_of_all([&](const Executor& executor) { return transfer_field(from, to, values, 2, executor); },
                     [](const TransferredField& a, const TransferredField& b) {
                       EXPECT_EQ(a.values, b.values);
                       EXPECT_EQ(a.outside, b.outside);
                       EXPECT_EQ(a.farthest, b.farthest);
                     });
}

}  // namespace
}  // namespace carreau
