// SPDX-License-Identifier: BSD-3-Clause
// Changes that are tried around the worst triangles (PlaneMesherOptions::shape_trials).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "plane/plane_mesher.h"
#include "plane_checks.h"

namespace carreau {
namespace {

using namespace testing;

PlaneMesh meshed(const PlaneCase& c, bool searched) {
  Monitor monitor;
  PlaneMesherOptions options;
  options.shape_trials = searched;
  PlaneMesh mesh = mesh_plane(c.domain, control_space(c), options, monitor);
  EXPECT_EQ(find_plane_defects(c.domain, mesh), std::vector<std::string>{});
  return mesh;
}

/// A plane domain bounded by a curve of unit edges.
PlaneCase plane_domain(double h, const std::function<Vec2(double)>& curve) {
  PlaneCase c = flat_square(h);
  c.domain = {};
  append_closed_curve(c, curve);
  return c;
}
PlaneCase ellipse(double h, double ratio) {
  return plane_domain(h, [ratio](double t) {
    const double a = 2 * std::numbers::pi * t;
    return Vec2{0.5 + 0.5 * std::cos(a), 0.5 + 0.5 * ratio * std::sin(a)};
  });
}

// If sizes are the same everywhere, the search judges the shape itself.
TEST(LocalSearch, RaiseTheWorstOfEllipses) {
  double sum = 0, sum_before = 0;
  int count = 0;
  for (const double ratio : {1., 0.8, 0.55})
    for (double h = 0.2; h > 0.03; h *= 0.93) {
      SCOPED_TRACE(std::to_string(ratio) + " " + std::to_string(h));
      const PlaneCase c = ellipse(h, ratio);
      const PlaneQuality without = measure(c, meshed(c, false)), with = measure(c, meshed(c, true));
      EXPECT_GE(with.worst, without.worst - 1e-9);
      EXPECT_GE(with.fitting, without.fitting - 0.02);
      sum += with.worst, sum_before += without.worst, ++count;
    }
  if (std::getenv("CARREAU_TEST_VERBOSE") != nullptr)
    std::printf("mean of the worst %.4f, without %.4f\n", sum / count, sum_before / count);
  EXPECT_GE(sum / count, sum_before / count + 0.04);
}

/// Sum of Q2^-6 - 1 over the triangles, in one metric.
double penalty(const PlaneMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec2 p = mesh.vertices[a], q = mesh.vertices[b], r = mesh.vertices[c];
    const double lengths2 = dot(q - p, q - p) + dot(r - q, r - q) + dot(p - r, p - r);
    sum += std::pow(2 * std::sqrt(3) * cross(q - p, r - p) / lengths2, -6) - 1;
  }
  return sum;
}

/// A bent strip: a quarter of a ring `width` wide, whose ends are round.
PlaneCase strip(double h, double width) {
  return plane_domain(h, [width](double t) {
    const double pi = std::numbers::pi, s = 4 * (t < 0.5 ? t : t - 0.5);  // two sides, each with an end
    const double turn = t < 0.5 ? std::min(s, 1.0) : 1 - std::min(s, 1.0), end = std::max(s - 1, 0.0) * pi;
    const double across = (t < 0.5 ? 1 : -1) * width / 2 * std::cos(end);
    const double beyond = (t < 0.5 ? 1 : -1) * width / 2 * std::sin(end), a = turn * pi / 2;
    return Vec2{(1 + across) * std::cos(a) - beyond * std::sin(a), (1 + across) * std::sin(a) + beyond * std::cos(a)};
  });
}

// A mean alone is made better by adding triangles that are not bad.
TEST(LocalSearch, LeaveNoMoreToWishForThanThereWas) {
  for (double h = 0.15; h > 0.02; h *= 0.97)
    for (const double width : {1.5, 1.8, 2.2, 3.0}) {
      SCOPED_TRACE(std::to_string(width) + " " + std::to_string(h));
      const PlaneCase c = strip(h, width * h);
      EXPECT_LE(penalty(meshed(c, true)), penalty(meshed(c, false)) * (1 + 1e-9));
    }
}

// Imposed points, internal curves, holes, corners, poles: all stays as it must be.
TEST(LocalSearch, KeepImposedEdges) {
  struct Named {
    PlaneCase (*make)(double);
    double h;
  };
  for (const Named& each :
       {Named{holes, 0.035}, Named{star, 0.1}, Named{star, 0.03}, Named{internal_curves, 0.07}, Named{size_field, 3},
        Named{polar_disc, 0.25}, Named{polar_disc, 0.07}, Named{sphere_two_poles, 0.4}, Named{stretched, 0.2}}) {
    const PlaneCase c = each.make(each.h);
    SCOPED_TRACE(c.name + " " + std::to_string(each.h));
    const PlaneMesh mesh = meshed(c, true), again = meshed(c, true);
    EXPECT_EQ(mesh.triangles, again.triangles);
    EXPECT_EQ(mesh.vertices, again.vertices);
  }
}

}  // namespace
}  // namespace carreau
