// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/recovery.h"

#include <gtest/gtest.h>

#include "metric/metric2_algebra.h"
#include "support/error.h"
#include "test_meshes.h"

namespace carreau {
namespace {

using testing::mapped;
using testing::square_mesh;
using testing::TestMesh;

double largest_entry(Metric2 m) { return std::max({std::abs(m.a), std::abs(m.b), std::abs(m.c)}); }
Metric2 difference(Metric2 p, Metric2 q) { return p + -1. * q; }

TEST(Recovery, IsExactOnQuadraticsUpToTheBorder) {
  TestMesh mesh = square_mesh(11);
  mesh.with([](Vec3 p) { return 3 + 2 * p.x() - p.y() + 1.5 * p.x() * p.x() - 4 * p.x() * p.y() + 0.25 * p.y() * p.y(); });
  const auto derivatives = recover_derivatives(mesh.field());
  for (std::size_t v = 0; v < derivatives.size(); ++v) {
    const auto& d = derivatives[v];
    ASSERT_TRUE(d.reliable);
    const Vec3 p = mesh.vertices[v];
    EXPECT_NEAR(d.gradient.x(), 2 + 3 * p.x() - 4 * p.y(), 1e-9);
    EXPECT_NEAR(d.gradient.y(), -1 - 4 * p.x() + 0.5 * p.y(), 1e-9);
    EXPECT_LT(largest_entry(difference(d.hessian, {3, -4, 0.5})), 1e-8);
  }
}

TEST(Recovery, IsExactOnQuadraticsOfStretchedMeshes) {
  // 1000 : 1, oblique.
  TestMesh mesh = mapped(square_mesh(11), [](Vec3 p) { return Vec3{p.x() + 0.001 * p.y(), p.x() - 0.001 * p.y(), 0}; });
  mesh.with([](Vec3 p) { return p.x() * p.x() + 7 * p.x() * p.y() - 2 * p.y() * p.y(); });
  for (const auto& d : recover_derivatives(mesh.field())) {
    ASSERT_TRUE(d.reliable);
    EXPECT_LT(largest_entry(difference(d.hessian, {2, 7, -4})), 1e-3);
  }
}

struct Errors {
  double gradient = 0, hessian = 0;
};

/// Mean errors inside, for sin 3x cos 2y.
Errors errors(int n, double jitter, bool projection) {
  TestMesh mesh = square_mesh(n, jitter);
  mesh.with([](Vec3 p) { return std::sin(3 * p.x()) * std::cos(2 * p.y()); });
  const auto derivatives = projection ? project_derivatives(mesh.field()) : recover_derivatives(mesh.field());
  Errors e;
  double count = 0;
  for (std::size_t v = 0; v < derivatives.size(); ++v) {
    const Vec3 p = mesh.vertices[v];
    if (std::abs(p.x()) > 0.7 || std::abs(p.y()) > 0.7) continue;
    const double sx = std::sin(3 * p.x()), cx = std::cos(3 * p.x()), sy = std::sin(2 * p.y()), cy = std::cos(2 * p.y());
    e.gradient += norm(derivatives[v].gradient - Vec2{3 * cx * cy, -2 * sx * sy});
    e.hessian += largest_entry(difference(derivatives[v].hessian, {-9 * sx * cy, -6 * cx * sy, -4 * sx * cy}));
    ++count;
  }
  return {e.gradient / count, e.hessian / count};
}

TEST(Recovery, ConvergesWithOrderTwoAndOneOnIrregularMeshes) {
  const Errors coarse = errors(24, 0.3, false), fine = errors(96, 0.3, false);
  EXPECT_GT(std::log2(coarse.gradient / fine.gradient) / 2, 1.85);
  EXPECT_GT(std::log2(coarse.hessian / fine.hessian) / 2, 0.9);
  EXPECT_LT(fine.hessian, 0.5);
}

TEST(Recovery, ConvergesWithOrderTwoOnRegularMeshes) {
  const Errors coarse = errors(24, 0, false), fine = errors(96, 0, false);
  EXPECT_GT(std::log2(coarse.gradient / fine.gradient) / 2, 1.9);
  EXPECT_GT(std::log2(coarse.hessian / fine.hessian) / 2, 1.9);
}

TEST(Projection, ConvergesOnRegularMeshes) {
  const Errors coarse = errors(24, 0, true), fine = errors(96, 0, true);
  EXPECT_GT(std::log2(coarse.gradient / fine.gradient) / 2, 1.8);
  EXPECT_GT(std::log2(coarse.hessian / fine.hessian) / 2, 1.8);
}

/// The largest error of curvatures of z = sqrt(4 - x^2 - y^2), whose principal curvatures are 1 / 2.
double quadric_error(int n, double jitter) {
  TestMesh mesh = square_mesh(n, jitter);
  mesh.with([](Vec3 p) { return std::sqrt(4 - p.x() * p.x() - p.y() * p.y()); });
  const auto derivatives = quadric_derivatives(mesh.field());
  double worst = 0;
  for (std::size_t v = 0; v < derivatives.size(); ++v) {
    if (!mesh.inside[v]) continue;
    const auto& d = derivatives[v];
    EXPECT_TRUE(d.reliable);
    const double x = d.gradient.x(), y = d.gradient.y(), up = std::sqrt(1 + x * x + y * y);
    const Metric2& h = d.hessian;
    const double gauss = (h.a * h.c - h.b * h.b) / std::pow(up, 4);
    const double mean = ((1 + x * x) * h.c - 2 * x * y * h.b + (1 + y * y) * h.a) / (2 * std::pow(up, 3));
    worst = std::max({worst, std::abs(mean + .5), std::abs(gauss - .25)});
  }
  return worst;
}

TEST(Quadric, FindsTheCurvatureOfASphere) {
  EXPECT_GT(std::log2(quadric_error(24, 0) / quadric_error(48, 0)), .9);
  EXPECT_LT(quadric_error(48, 0), .02);
  EXPECT_LT(quadric_error(48, .2), .25);  // mean normals are of order one, so that quadrics do not converge
}

TEST(Quadric, FindsMoreThanFourFifthsOfTheCurvatureAtTheKneesOfAFront) {
  // HDR eq. 4.95, with two thirds of its width between vertices.
  constexpr double width = .03;
  TestMesh mesh = mapped(square_mesh(10, .2), [](Vec3 p) { return Vec3{.1 * p.x(), .1 * p.y(), 0}; });
  mesh.with([](Vec3 p) { return std::tanh(p.y() / width); });
  double exact = 0;
  for (int k = 0; k <= 1000; ++k) {
    const double t = std::tanh(1e-4 * k / width), slope = (1 - t * t) / width;
    exact = std::max(exact, 2 * t * slope / width / std::pow(1 + slope * slope, 1.5));
  }
  const auto largest = [&](const std::vector<LocalDerivatives>& all) {
    double found = 0;
    for (std::size_t v = 0; v < all.size(); ++v) {
      if (!mesh.inside[v]) continue;
      const double up = 1 + all[v].gradient.y() * all[v].gradient.y();
      found = std::max(found, std::abs(all[v].hessian.c) / std::pow(up, 1.5));
    }
    return found / exact;
  };
  EXPECT_GT(largest(quadric_derivatives(mesh.field())), .8);
  EXPECT_LT(largest(quadric_derivatives(mesh.field())), 1.1);
}

TEST(Quadric, RejectsMeshesInSpaceAndReportsVerticesWithoutNeighbours) {
  TestMesh bent = mapped(square_mesh(4), [](Vec3 p) { return Vec3{p.x(), p.y(), p.x() * p.x()}; });
  bent.with([](Vec3 p) { return p.x(); });
  EXPECT_THROW((void)quadric_derivatives(bent.field()), InvalidArgument);
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<std::array<std::int32_t, 3>> one{{0, 1, 2}};
  const std::vector<double> values{0, 1, 2};
  for (const LocalDerivatives& d : quadric_derivatives({corners, one, values})) {
    EXPECT_FALSE(d.reliable);
    EXPECT_LT(norm(d.gradient - Vec2{1, 2}), 1e-12);
  }
}

TEST(Recovery, TurnsWithTheMesh) {
  const auto turn = [](Vec3 p) {  // a rotation about a slanted axis, and a shift
    const double c = std::cos(0.8), s = std::sin(0.8);
    const Vec3 q{c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z()};
    return Vec3{q.x() + 5, c * q.y() - s * q.z(), s * q.y() + c * q.z()};
  };
  TestMesh mesh = square_mesh(13);
  mesh.with([](Vec3 p) { return std::exp(p.x()) * (1 + p.y() * p.y()); });
  const TestMesh turned = mapped(mesh, turn);
  const auto before = recover_derivatives(mesh.field()), after = recover_derivatives(turned.field());
  for (std::size_t v = 0; v < before.size(); ++v) {
    const Eigen2 p = eigen(before[v].hessian), q = eigen(after[v].hessian);
    EXPECT_NEAR(p.major, q.major, 1e-8);
    EXPECT_NEAR(p.minor, q.minor, 1e-8);
    const VertexFrame& f = after[v].frame;
    const Vec3 gradient = after[v].gradient.x() * f.e1 + after[v].gradient.y() * f.e2;
    const Vec3 expected = turn({before[v].gradient.x(), before[v].gradient.y(), 0}) - turn({0, 0, 0});
    EXPECT_LT(norm(gradient - expected), 1e-9);
  }
}

TEST(Recovery, FindsTheHessianOfAHeightOnASphere) {
  // On the unit sphere the Hessian of z, along the surface, is -z times the identity.
  double before = 0;
  for (const int n : {16, 32, 64}) {
    TestMesh mesh = mapped(square_mesh(n, 0.2), [](Vec3 p) -> Vec3 {
      const Vec3 q{p.x(), p.y(), 1.2};
      return (1 / norm(q)) * q;
    });
    mesh.with([](Vec3 p) { return p.z(); });
    const auto derivatives = recover_derivatives(mesh.field());
    double error = 0, count = 0;
    for (std::size_t v = 0; v < derivatives.size(); ++v) {
      if (mesh.inside[v] == 0) continue;
      const double z = mesh.vertices[v].z();
      error += largest_entry(difference(derivatives[v].hessian, {-z, 0, -z}));
      ++count;
    }
    error /= count;
    if (before > 0) {
      EXPECT_LT(error, before / 1.8);
    }
    before = error;
  }
  EXPECT_LT(before, 0.05);
}

TEST(Recovery, NamesThePlaceOfTooFewNeighbours) {
  const std::vector<Vec3> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<std::array<std::int32_t, 3>> triangles{{0, 1, 2}};
  const std::vector<double> values{0, 1, 2};
  for (const auto& d : recover_derivatives({vertices, triangles, values})) EXPECT_FALSE(d.reliable);
}

TEST(Recovery, RejectsFieldsThatDoNotFit) {
  TestMesh mesh = square_mesh(3);
  mesh.values.pop_back();
  EXPECT_THROW(recover_derivatives(mesh.field()), InvalidArgument);
  mesh = square_mesh(3);
  mesh.values[2] = std::nan("");
  EXPECT_THROW(recover_derivatives(mesh.field()), InvalidArgument);
  mesh = square_mesh(3);
  mesh.triangles[0][1] = 99;
  EXPECT_THROW(recover_derivatives(mesh.field()), InvalidArgument);
  mesh = square_mesh(3);
  mesh.triangles.clear();
  EXPECT_THROW(recover_derivatives(mesh.field()), InvalidArgument);
  mesh = square_mesh(3);
  mesh.vertices[0].x() = HUGE_VAL;
  EXPECT_THROW(recover_derivatives(mesh.field()), InvalidArgument);
}

}  // namespace
}  // namespace carreau
