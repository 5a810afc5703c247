// SPDX-License-Identifier: BSD-3-Clause
// Estimators against closed forms: quadratics, spheres, cylinders.
#include "adapt/estimators.h"

#include <gtest/gtest.h>

#include <numbers>

#include "adapt/differences.h"
#include "metric/metric2_algebra.h"
#include "support/error.h"
#include "test_meshes.h"

namespace carreau {
namespace {

using testing::square_mesh;
using testing::TestMesh;

Metric2 plane_part(const Metric3& m) { return induced_metric(Vec3{1, 0, 0}, Vec3{0, 1, 0}, m); }
std::array<double, 2> sizes_of(const Metric3& m) {
  const Eigen2 e = eigen(plane_part(m));
  return {1 / std::sqrt(e.major), 1 / std::sqrt(e.minor)};
}

constexpr double degree = std::numbers::pi / 180;

TEST(HessianEstimator, SolvesTheBoundForTheSize) {
  // HDR eq. 3.5 with the largest eigenvalue 8.
  TestMesh mesh = square_mesh(12);
  mesh.with([](Vec3 p) { return 4 * p.x() * p.x() - p.y() * p.y(); });
  const auto result = estimate(mesh.field(), {.tolerance = 0.02, .hmin = 1e-4, .hmax = 10});
  ASSERT_EQ(result.sizes.size(), mesh.vertices.size());
  EXPECT_TRUE(result.metrics.empty());
  for (const double h : result.sizes) EXPECT_NEAR(h, std::sqrt(9 * 0.02 / (2 * 8)), 1e-9);
}

/// The largest value of along(from, to) over the edges, in both directions.
template <typename Along>
double largest_along_edges(const TestMesh& mesh, const Along& along) {
  double largest = 0;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = mesh.vertices[static_cast<std::size_t>(t[k])], q = mesh.vertices[static_cast<std::size_t>(t[(k + 1) % 3])];
      largest = std::max({largest, along(p, q), along(q, p)});
    }
  return largest;
}

// f = x^2 bends by 2, and the edge d leaves the tangent plane at x by dx^2 in height.
TEST(EstimatedError, HasTheClosedFormsOfAParabola) {
  TestMesh mesh = square_mesh(12);
  mesh.with([](Vec3 p) { return p.x() * p.x(); });
  const auto square = [](double x) { return x * x; };
  const auto away = [&](const Vec3& p, const Vec3& q) { return square(q.x() - p.x()) / std::sqrt(1 + square(2 * p.x())); };
  EstimatorOptions options{.tolerance = 0.02, .hmin = 1e-4, .hmax = 10};
  EXPECT_NEAR(estimated_error(mesh.field(), options),
              largest_along_edges(mesh, [&](const Vec3& p, const Vec3& q) { return 2.0 / 9 * 2 * square(q.x() - p.x()); }), 1e-9);
  options.relative = true, options.relative_floor = 0.5;  // of the largest value, 1
  EXPECT_NEAR(estimated_error(mesh.field(), options), largest_along_edges(mesh, [&](const Vec3& p, const Vec3& q) {
                return 2.0 / 9 * 2 * square(q.x() - p.x()) / std::max(p.x() * p.x(), 0.5);
              }), 1e-9);
  options.relative = false, options.source = ErrorSource::deformation;
  EXPECT_NEAR(estimated_error(mesh.field(), options), largest_along_edges(mesh, away), 1e-9);
  options.source = ErrorSource::curvature;
  EXPECT_NEAR(estimated_error(mesh.field(), options), largest_along_edges(mesh, [&](const Vec3& p, const Vec3& q) {
                const double rise = q.x() * q.x() - p.x() * p.x();
                return std::asin(away(p, q) / std::sqrt(square(norm(q - p)) + rise * rise)) / degree;
              }), 1e-6);
  const FieldFunction exact = [](std::span<const Vec3> points, std::span<double> values) {
    for (std::size_t i = 0; i < points.size(); ++i) values[i] = points[i].x() * points[i].x();
  };
  EXPECT_NEAR(estimated_error(mesh.field(), exact, options), estimated_error(mesh.field(), options), 1e-5);
}

TEST(HessianEstimator, GivesBothSizesAlongTheAxes) {
  TestMesh mesh = square_mesh(12);
  const double c = std::cos(0.5), s = std::sin(0.5);
  mesh.with([&](Vec3 p) {
    const double x = c * p.x() + s * p.y(), y = -s * p.x() + c * p.y();
    return 50 * x * x - y * y / 2;
  });
  const auto result =
      estimate(mesh.field(), {.shape = ErrorShape::anisotropic, .tolerance = 0.01, .hmin = 1e-4, .hmax = 10});
  for (const Metric3& m : result.metrics) {
    const auto [h1, h2] = sizes_of(m);
    EXPECT_NEAR(h1, std::sqrt(0.045 / 100), 1e-8);
    EXPECT_NEAR(h2, std::sqrt(0.045), 1e-6);
    EXPECT_NEAR(length(plane_part(m), {c, s}), 1 / h1, 1e-3);
    EXPECT_NEAR(m.zz, 1 / (h1 * h1), 1e-2);
  }
}

TEST(HessianEstimator, SeveralFieldsGiveTheIntersection) {
  // Fields that bend along x and along y: by both, the smaller size along each axis (RR-2818 sec. 4.3.4).
  TestMesh mesh = square_mesh(12);
  const EstimatorOptions options{.shape = ErrorShape::anisotropic, .tolerance = 0.01, .hmin = 1e-4, .hmax = 1};
  std::vector<double> both;
  for (const Vec3& p : mesh.vertices) {
    both.push_back(50 * p.x() * p.x());
    both.push_back(8 * p.y() * p.y());
  }
  const auto result = estimate_all(mesh.vertices, mesh.triangles, both, 2, options);
  ASSERT_EQ(result.metrics.size(), mesh.vertices.size());
  for (const Metric3& m : result.metrics) {
    EXPECT_NEAR(m.xx, 100 / 0.045, 1e-4);
    EXPECT_NEAR(m.yy, 16 / 0.045, 1e-4);
    EXPECT_NEAR(m.xy, 0, 1e-4);
  }
  const auto sizes =
      estimate_all(mesh.vertices, mesh.triangles, both, 2, {.tolerance = 0.01, .hmin = 1e-4, .hmax = 1}).sizes;
  for (const double h : sizes) EXPECT_NEAR(h, std::sqrt(0.045 / 100), 1e-8);
  EXPECT_THROW(estimate_all(mesh.vertices, mesh.triangles, both, 3, options), InvalidArgument);
  EXPECT_THROW(estimate_all(mesh.vertices, mesh.triangles, {}, 0, options), InvalidArgument);
}

TEST(HessianEstimator, ProjectionIsRightInsideAndSmootherThanTheFit) {
  // On a regular mesh the double projection is exact for quadratics away from the border, whose bias reaches two rings.
  TestMesh mesh = square_mesh(16, 0);
  mesh.with([](Vec3 p) { return 4 * p.x() * p.x() - p.y() * p.y(); });
  const auto result =
      estimate(mesh.field(), {.tolerance = 0.02, .hmin = 1e-4, .hmax = 10, .recovery = Recovery::projection});
  double low_x = 1e30, high_x = -1e30;
  for (const Vec3& p : mesh.vertices) low_x = std::min(low_x, p.x()), high_x = std::max(high_x, p.x());
  int inside = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3 d = mesh.vertices[v];
    const double far = 0.2 * (high_x - low_x);
    if (d.x() < low_x + far || d.x() > high_x - far || d.y() < low_x + far || d.y() > high_x - far) continue;
    ++inside;
    EXPECT_NEAR(result.sizes[v], std::sqrt(9 * 0.02 / (2 * 8)), 1e-9);
  }
  EXPECT_GT(inside, 20);
}

TEST(HessianEstimator, ItsUnitTrianglesHaveTheError) {
  // An equilateral triangle of the size that the bound gives: the error is at most the tolerance, at least half of it.
  const double k = 6, tolerance = 0.03, h = std::sqrt(9 * tolerance / (2 * k));
  const auto f = [&](double x, double y) { return k / 2 * (x * x + y * y); };
  const double height = h * std::numbers::sqrt3 / 2;
  const double linear = (f(0, 0) + f(h, 0) + f(h / 2, height)) / 3;  // at the centre
  const double error = linear - f(h / 2, height / 3);
  EXPECT_LE(error, tolerance);
  EXPECT_GE(error, tolerance / 2);
}

TEST(HessianEstimator, KeepsBoundsAndRatio) {
  TestMesh mesh = square_mesh(12);
  mesh.with([](Vec3 p) { return 1e6 * p.x() * p.x(); });
  const EstimatorOptions options{
      .shape = ErrorShape::anisotropic, .tolerance = 1e-4, .hmin = 0.01, .hmax = 0.5, .ratio = 20};
  for (const Metric3& m : estimate(mesh.field(), options).metrics) {
    const auto [h1, h2] = sizes_of(m);
    EXPECT_NEAR(h1, 0.01, 1e-9);
    EXPECT_NEAR(h2, 0.2, 1e-7);
  }
  mesh.with([](Vec3) { return 5.; });
  for (const Metric3& m : estimate(mesh.field(), options).metrics) EXPECT_NEAR(sizes_of(m)[0], 0.5, 1e-9);
}

TEST(HessianEstimator, RelativeErrorsScaleWithTheField) {
  TestMesh mesh = square_mesh(12);
  const EstimatorOptions options{.tolerance = 0.01, .relative = true, .hmin = 1e-4, .hmax = 10};
  mesh.with([](Vec3 p) { return 3 + p.x() * p.x(); });
  const auto once = estimate(mesh.field(), options);
  mesh.with([](Vec3 p) { return 1000 * (3 + p.x() * p.x()); });
  const auto thousand = estimate(mesh.field(), options);
  for (std::size_t v = 0; v < once.sizes.size(); ++v) {
    EXPECT_NEAR(once.sizes[v], thousand.sizes[v], 1e-8);
    const double value = 3 + mesh.vertices[v].x() * mesh.vertices[v].x();
    EXPECT_NEAR(once.sizes[v], std::sqrt(9 * 0.01 * value / 4), 1e-8);
  }
}

TEST(CurvatureEstimator, GivesTheSizeOfAnAngleOnASphere) {
  // The graph of a sphere of radius 3: 2 sin(8 degrees) 3 in the tangent plane, projected.
  const double radius = 3;
  TestMesh mesh = square_mesh(60, 0.1);
  mesh.with([&](Vec3 p) { return std::sqrt(radius * radius - p.x() * p.x() - p.y() * p.y()); });
  EstimatorOptions options{.source = ErrorSource::curvature, .tolerance = 8, .hmin = 1e-4, .hmax = 10};
  const double h = 2 * std::sin(8 * degree) * radius;
  const auto circles = estimate(mesh.field(), options);
  options.shape = ErrorShape::graph;
  const auto graph = estimate(mesh.field(), options);
  options.shape = ErrorShape::anisotropic;
  const auto ellipses = estimate(mesh.field(), options);
  for (std::size_t v = 0; v < circles.sizes.size(); ++v) {
    if (mesh.inside[v] == 0) continue;
    const double cosine = mesh.values[v] / radius;  // between the normal and the vertical
    EXPECT_NEAR(circles.sizes[v], h * cosine, 0.03 * h);
    EXPECT_NEAR(sizes_of(graph.metrics[v])[0], h * cosine, 0.03 * h);
    EXPECT_NEAR(sizes_of(graph.metrics[v])[1], h, 0.03 * h);
    EXPECT_NEAR(sizes_of(ellipses.metrics[v])[1], h, 0.06 * h);
  }
}

TEST(CurvatureEstimator, FollowsTheTwoRadiiAtTheTop) {
  // HDR figure 4.8: radii 1 and 4, 30 degrees: sizes 1 and sqrt((2 - sqrt 3)(14 + sqrt 3)).
  TestMesh mesh = square_mesh(12);
  mesh.with([](Vec3 p) { return p.x() * p.x() / 2 + p.y() * p.y() / 8; });
  const auto result = estimate(
      mesh.field(),
      {.source = ErrorSource::curvature, .shape = ErrorShape::anisotropic, .tolerance = 30, .hmin = 1e-4, .hmax = 10});
  std::size_t centre = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (norm(mesh.vertices[v]) < norm(mesh.vertices[centre])) centre = v;
  // The vertex is not quite at the top.
  const double off = norm(mesh.vertices[centre]);
  const auto [h1, h2] = sizes_of(result.metrics[centre]);
  EXPECT_NEAR(h1, 1, 2 * off * off + 1e-9);
  EXPECT_NEAR(h2, std::sqrt((2 - std::numbers::sqrt3) * (14 + std::numbers::sqrt3)), 4 * off * off + 1e-9);
}

TEST(DeformationEstimator, IsAPropertyOfTheSurfaceNotOfTheMesh) {
  // z = k r^2 / 2: the distance from the tangent plane at the top is k h^2 / 2.
  for (const int n : {8, 16, 64}) {
    TestMesh mesh = square_mesh(n, 0);
    mesh.with([](Vec3 p) { return 0.4 * (p.x() * p.x() + p.y() * p.y()) / 2; });
    const EstimatorOptions options{.source = ErrorSource::deformation, .tolerance = 0.01, .hmin = 1e-4, .hmax = 10};
    const auto result = estimate(mesh.field(), options);
    const std::size_t centre = static_cast<std::size_t>(n / 2) * static_cast<std::size_t>(n + 2);
    EXPECT_NEAR(norm(mesh.vertices[centre]), 0, 1e-12);
    EXPECT_NEAR(result.sizes[centre], std::sqrt(2 * 0.01 / 0.4), 0.01);
  }
}

TEST(Estimators, TurnWithTheMesh) {
  const double c = std::cos(1.1), s = std::sin(1.1);
  TestMesh mesh = square_mesh(16, 0);
  mesh.with([](Vec3 p) { return std::sin(2 * p.x() + p.y()) + p.y() * p.y(); });
  const TestMesh turned = testing::mapped(mesh, [&](Vec3 p) { return Vec3{c * p.x() - s * p.y(), s * p.x() + c * p.y(), 0}; });
  for (const ErrorSource source : {ErrorSource::hessian, ErrorSource::curvature, ErrorSource::deformation}) {
    const EstimatorOptions options{
        .source = source, .shape = ErrorShape::anisotropic, .tolerance = 0.5, .hmin = 1e-3, .hmax = 10};
    const auto p = estimate(mesh.field(), options), q = estimate(turned.field(), options);
    for (std::size_t v = 0; v < p.metrics.size(); ++v)
      for (const Vec2& d : {Vec2{1, 0}, Vec2{0, 1}, Vec2{0.6, 0.8}})
        EXPECT_NEAR(length(plane_part(p.metrics[v]), d),
                    length(plane_part(q.metrics[v]), {c * d.x() - s * d.y(), s * d.x() + c * d.y()}),
                    1e-7 * length(plane_part(p.metrics[v]), d));
  }
}

TEST(Estimators, RejectOptionsThatMeanNothing) {
  TestMesh mesh = square_mesh(4);
  const EstimatorOptions good{.tolerance = 0.1, .hmin = 0.1, .hmax = 1};
  EXPECT_NO_THROW(estimate(mesh.field(), good));
  const auto refused = [&](auto change) {
    EstimatorOptions options = good;
    change(options);
    EXPECT_THROW(estimate(mesh.field(), options), InvalidArgument);
  };
  refused([](auto& o) { o.hmin = 0; });
  refused([](auto& o) { o.hmin = 2; });
  refused([](auto& o) { o.hmax = HUGE_VAL; });
  refused([](auto& o) { o.tolerance = 0; });
  refused([](auto& o) { o.tolerance = std::nan(""); });
  refused([](auto& o) { o.ratio = 0.5; });
  refused([](auto& o) { o.relative_floor = 0; });
  refused([](auto& o) { o.shape = ErrorShape::graph; });
  refused([](auto& o) { o.source = ErrorSource::curvature, o.tolerance = 90; });
  mesh.vertices[0].z() = 1;
  refused([](auto& o) { o.source = ErrorSource::deformation; });
}

}  // namespace
}  // namespace carreau
