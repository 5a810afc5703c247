// SPDX-License-Identifier: BSD-3-Clause
// Jacobians of elements: Bernstein coefficients against derivatives of the element's own map.
#include "mesh/elements/jacobian.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "mesh/elements/cell_quality.h"
#include "support/infinity.h"

namespace carreau {
namespace {

constexpr CellKind kinds[] = {CellKind::triangle3, CellKind::triangle6, CellKind::quad4, CellKind::quad8};

/// The regular element with its nodes moved by as much as `by`.
std::vector<Vec3> nodes_of(CellKind kind, std::mt19937_64& random, double by) {
  std::uniform_real_distribution<double> shift(-by, by);
  std::vector<Vec3> x = corner_count(kind) == 3 ? std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}
                                                : std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::size_t n = x.size();
  if (is_quadratic(kind))
    for (std::size_t i = 0; i < n; ++i) x.push_back(0.5 * (x[i] + x[(i + 1) % n]));
  for (Vec3& p : x) p += Vec3{shift(random), shift(random), shift(random)};
  return x;
}

// Differences of polynomials of degree 2 in each variable are exact.
Vec3 normal_at(CellKind kind, const std::vector<Vec3>& x, double s, double t) {
  constexpr double d = 0.125;
  const Vec3 by_s = point_of_cell(kind, x, s + d, t) - point_of_cell(kind, x, s - d, t),
             by_t = point_of_cell(kind, x, s, t + d) - point_of_cell(kind, x, s, t - d);
  return (1 / (4 * d * d)) * cross(by_s, by_t);
}

double binomial(int n, int k) { return k == 0 ? 1 : binomial(n, k - 1) * (n - k + 1) / k; }

Vec3 value_at(CellKind kind, const Jacobian& j, double s, double t) {
  if (kind == CellKind::triangle3) return j.c[0];
  const double r = 1 - s - t;
  if (kind == CellKind::triangle6)
    return r * r * j.c[0] + s * s * j.c[1] + t * t * j.c[2] + 2 * (r * s * j.c[3] + s * t * j.c[4] + t * r * j.c[5]);
  // Straight quadrilaterals: corners in their order.
  if (kind == CellKind::quad4)
    return (1 - t) * ((1 - s) * j.c[0] + s * j.c[1]) + t * ((1 - s) * j.c[3] + s * j.c[2]);
  Vec3 sum{0, 0, 0};
  for (int a = 0; a <= 3; ++a)
    for (int b = 0; b <= 3; ++b)
      sum += binomial(3, a) * std::pow(s, a) * std::pow(1 - s, 3 - a) * binomial(3, b) * std::pow(t, b) *
             std::pow(1 - t, 3 - b) * j.c[4 * a + b];
  return sum;
}

TEST(Jacobian, CoefficientsMatchTheElementsMap) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> place(0, 1);
  for (const CellKind kind : kinds)
    for (int run = 0; run < 200; ++run) {
      const std::vector<Vec3> x = nodes_of(kind, random, 0.5);
      const Jacobian j = jacobian(kind, x);
      double s = place(random), t = place(random);
      if (corner_count(kind) == 3 && s + t > 1) s = 1 - s, t = 1 - t;
      EXPECT_LT(norm(value_at(kind, j, s, t) - normal_at(kind, x, s, t)), 1e-12) << int(kind);
    }
}

TEST(Jacobian, TheLeastCoefficientBoundsTheElement) {
  std::mt19937_64 random(5);
  int valid = 0;
  for (const CellKind kind : {CellKind::triangle6, CellKind::quad8})
    for (int run = 0; run < 200; ++run) {
      const std::vector<Vec3> x = nodes_of(kind, random, 0.12);
      const Jacobian j = jacobian(kind, x);
      const Vec3 mean = j.mean();
      const double length = norm(mean), least = j.least();
      if (least > 0) ++valid;
      for (double s = 0; s <= 1; s += 0.125)
        for (double t = 0; s + t <= (corner_count(kind) == 3 ? 1 : 2) && t <= 1; t += 0.125)
          EXPECT_GE(dot(normal_at(kind, x, s, t), mean) / length, least * length - 1e-12);
    }
  EXPECT_GT(valid, 100);
}

TEST(Jacobian, ANodeAtAQuarterOfItsSideIsTheLimit) {
  const auto least = [](double s) {
    const std::vector<Vec3> x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {s, 0, 0}, {0.5, 0.5, 0}, {0, 0.5, 0}};
    return jacobian(CellKind::triangle6, x).min_along({0, 0, 1});
  };
  EXPECT_NEAR(least(0.25), 0, 1e-15);
  EXPECT_GT(least(0.26), 0);
  EXPECT_LT(least(0.24), 0);
  EXPECT_DOUBLE_EQ(least(0.5), 1);
}

TEST(CellQuality, SquaresAndEquilateralTrianglesAreTheBest) {
  const std::vector<Vec3> square{{0, 0, 2}, {3, 0, 2}, {3, 3, 2}, {0, 3, 2}},
      triangle{{0, 0, 0}, {2, 0, 0}, {1, std::sqrt(3.0), 0}};
  for (const auto& [kind, x] : {std::pair{CellKind::quad4, square}, std::pair{CellKind::triangle3, triangle}}) {
    const CellQuality q = cell_quality(kind, x);
    EXPECT_NEAR(q.shape, 1, 1e-14);
    EXPECT_NEAR(q.scaled_jacobian, 1, 1e-14);
    EXPECT_DOUBLE_EQ(q.least_jacobian, 1);
  }
  EXPECT_NEAR(cell_quality(CellKind::quad4, square).area, 9, 1e-13);
  EXPECT_NEAR(cell_quality(CellKind::triangle3, triangle).area, std::sqrt(3.0), 1e-14);
}

TEST(CellQuality, ARhombusAndARectangleHaveTheirClosedForms) {
  // Sides 1, angles 60 and 120 degrees: h = sqrt 3, rho as in the flat halves, area / (half the perimeter).
  const double c = std::sqrt(3.0) / 2;
  const CellQuality rhombus = cell_quality(CellKind::quad4, std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1.5, c, 0}, {0.5, c, 0}});
  const double rho = c / (2 + std::sqrt(3.0));
  EXPECT_NEAR(rhombus.shape, (2 + 2 * std::sqrt(2.0)) * rho / std::sqrt(3.0), 1e-14);
  EXPECT_NEAR(rhombus.scaled_jacobian, c, 1e-14);
  EXPECT_NEAR(rhombus.angle_min, 60, 1e-12);
  EXPECT_NEAR(rhombus.angle_max, 120, 1e-12);
  const CellQuality rectangle = cell_quality(CellKind::quad4, std::vector<Vec3>{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}});
  EXPECT_NEAR(rectangle.shape, (2 + 2 * std::sqrt(2.0)) / 5, 1e-14);  // rho = 1, h = 5
  EXPECT_NEAR(rectangle.scaled_jacobian, 1, 1e-15);
}

std::vector<Vec2> in_plane(const std::vector<Vec3>& x) {
  std::vector<Vec2> flat;
  for (const Vec3& p : x) flat.push_back({p.x(), p.y()});
  return flat;
}

TEST(Jacobian, TheBoundOfACurvedTriangleIsBelowItsLeastCoefficient) {
  std::mt19937_64 random(20);
  for (const double by : {0.0, 1e-3, 0.02, 0.1, 0.5})
    for (int k = 0; k < 2000; ++k) {
      std::vector<Vec3> x = nodes_of(CellKind::triangle6, random, by);
      const double bound = min_of_triangle6(std::span<const Vec3>(x));
      EXPECT_LE(bound, jacobian(CellKind::triangle6, x).least() + 1e-12);
      if (by <= 1e-3) {
        EXPECT_GT(bound, 0.9);
      }
      for (Vec3& p : x) p.z() = 0;
      const std::vector<Vec2> flat = in_plane(x);
      EXPECT_LE(min_of_triangle6(std::span<const Vec2>(flat)), jacobian(CellKind::triangle6, x).min_along({0, 0, 1}) + 1e-12);
    }
}

// Straight sides, halved: all coefficients are one. Bent by a fiftieth on a sphere's side: far from invalid.
TEST(Jacobian, TheBoundOfACurvedTriangleDetectsStraightOnes) {
  std::vector<Vec3> x{{0, 0, 0}, {3, 0, 0}, {1, 2, 0}, {1.5, 0, 0}, {2, 1, 0}, {0.5, 1, 0}};
  EXPECT_NEAR(min_of_triangle6(std::span<const Vec3>(x)), 1, 1e-15);
  EXPECT_NEAR(min_of_triangle6(std::span<const Vec2>(in_plane(x))), 1, 1e-15);
  for (std::size_t k = 3; k < 6; ++k) x[k].z() = 0.02;
  EXPECT_GT(min_of_triangle6(std::span<const Vec3>(x)), 0.8);
  std::swap(x[1], x[2]), std::swap(x[3], x[5]);
  EXPECT_EQ(min_of_triangle6(std::span<const Vec2>(in_plane(x))), -infinity) << "turned over";
  x[2] = {7, 0, 0}, x[4] = {5, 0, 0};
  EXPECT_LT(min_of_triangle6(std::span<const Vec3>(x)), 0.5);
}

TEST(CellQuality, AConcaveQuadrilateralIsWorthNothing) {
  const CellQuality q = cell_quality(CellKind::quad4, std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0.2, 0.2, 0}, {0, 1, 0}});
  EXPECT_EQ(q.shape, 0);
  EXPECT_LT(q.scaled_jacobian, 0);
  EXPECT_LT(q.least_jacobian, 0);
  EXPECT_GT(q.angle_max, 180);
}

// A quarter of a disc as one triangle of second order: its area is that between two chords and a parabola.
TEST(CellQuality, TheAreaOfACurvedTriangleIsThatUnderItsParabola) {
  const double h = std::sqrt(0.5);
  const std::vector<Vec3> x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0, 0}, {h, h, 0}, {0, 0.5, 0}};
  const double sagitta = 1 - h, chord = std::sqrt(2.0);
  EXPECT_NEAR(cell_quality(CellKind::triangle6, x).area, 0.5 + 2.0 / 3 * sagitta * chord, 1e-14);
}

}  // namespace
}  // namespace carreau
