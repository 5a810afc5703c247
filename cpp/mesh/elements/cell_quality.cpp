// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/elements/cell_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "mesh/elements/jacobian.h"
#include "support/infinity.h"

namespace carreau {

namespace {

double double_area(const Vec3& a, const Vec3& b, const Vec3& c) noexcept { return norm(cross(b - a, c - a)); }

// HDR sec. 1.1.1.
double shape_of(std::span<const Vec3> x, std::size_t n) noexcept {
  double diameter = 0, rho = infinity;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = i + 1; k < n; ++k) diameter = std::max(diameter, norm(x[k] - x[i]));
    const Vec3 &a = x[i], &b = x[(i + 1) % n], &c = x[(i + 2) % n];
    const double perimeter = norm(b - a) + norm(c - b) + norm(a - c);
    if (!(perimeter > 0)) return 0;
    rho = std::min(rho, double_area(a, b, c) / perimeter);
  }
  const double regular = n == 3 ? 2 * std::numbers::sqrt3 : 2 + 2 * std::numbers::sqrt2;
  return diameter > 0 ? regular * rho / diameter : 0;
}

// Derivative at corner i along the side to corner i + 1, or, if `back`, to the previous corner.
Vec3 tangent(CellKind kind, std::span<const Vec3> x, std::size_t n, std::size_t i, bool back) noexcept {
  const Vec3 &a = x[i], &b = x[back ? (i + n - 1) % n : (i + 1) % n];
  if (!is_quadratic(kind)) return b - a;
  const Vec3& m = x[n + (back ? (i + n - 1) % n : i)];
  return 4 * (m - a) - (b - a);
}

constexpr double degrees = 180 / std::numbers::pi;

void measure_corners(CellKind kind, std::span<const Vec3> x, std::size_t n, const Vec3& normal, CellQuality& q) {
  const double regular = n == 3 ? std::numbers::sqrt3 / 2 : 1;
  q.scaled_jacobian = infinity, q.angle_min = infinity, q.angle_max = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 p = tangent(kind, x, n, i, false), r = tangent(kind, x, n, i, true), product = cross(p, r);
    const double lengths = norm(p) * norm(r), side = dot(product, normal) < 0 ? -1 : 1;
    q.scaled_jacobian = std::min(q.scaled_jacobian, lengths > 0 ? side * norm(product) / lengths / regular : 0);
    const double angle = degrees * std::atan2(norm(product), dot(p, r)), turned = side < 0 ? 360 - angle : angle;
    q.angle_min = std::min(q.angle_min, side < 0 ? -angle : angle);
    q.angle_max = std::max(q.angle_max, turned);
  }
}

// Gauss points of degree 7 on a segment: enough for the areas of elements that are little curved.
constexpr std::array<double, 4> gauss_at{0.06943184420297371, 0.33000947820757187, 0.6699905217924281,
                                         0.9305681557970263};
constexpr std::array<double, 4> gauss_weight{0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                             0.17392742256872693};

Vec3 bernstein_value(const Jacobian& j, CellKind kind, double s, double t) noexcept {
  const double p = 1 - s, q = 1 - t, r = 1 - s - t;
  if (kind == CellKind::triangle6)
    return r * r * j.c[0] + s * s * j.c[1] + t * t * j.c[2] + 2 * r * s * j.c[3] + 2 * s * t * j.c[4] +
           2 * t * r * j.c[5];
  if (kind == CellKind::quad4) return p * q * j.c[0] + s * q * j.c[1] + s * t * j.c[2] + p * t * j.c[3];
  const std::array<double, 4> in_s{p * p * p, 3 * p * p * s, 3 * p * s * s, s * s * s},
      in_t{q * q * q, 3 * q * q * t, 3 * q * t * t, t * t * t};
  Vec3 sum{0, 0, 0};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 4; ++k) sum += in_s[i] * in_t[k] * j.c[4 * i + k];
  return sum;
}

double area_of(const Jacobian& j, CellKind kind) noexcept {
  if (kind == CellKind::triangle3) return 0.5 * norm(j.c[0]);
  const bool triangle = kind == CellKind::triangle6;
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 4; ++k) {
      // Duffy's map of the square to the triangle.
      const double s = gauss_at[i], t = triangle ? gauss_at[k] * (1 - s) : gauss_at[k];
      sum += gauss_weight[i] * gauss_weight[k] * (triangle ? 1 - s : 1) * norm(bernstein_value(j, kind, s, t));
    }
  return sum;
}

}  // namespace

CellQuality cell_quality(CellKind kind, std::span<const Vec3> nodes) noexcept {
  const auto n = static_cast<std::size_t>(corner_count(kind));
  const Jacobian j = jacobian(kind, nodes);
  CellQuality q;
  q.shape = shape_of(nodes, n);
  q.least_jacobian = j.least();
  q.area = area_of(j, kind);
  measure_corners(kind, nodes, n, j.mean(), q);
  if (q.scaled_jacobian <= 0) q.shape = 0;
  return q;
}

CellSummary summarise_cells(const FlatMesh& mesh) {
  CellSummary summary;
  std::vector<double> shape, scaled, least;
  for (std::vector<double>* list : {&shape, &scaled, &least})
    list->reserve(mesh.cells.empty() ? mesh.triangles.size() : mesh.cells.size());
  summary.angle_min_deg = infinity;
  double triangles = 0;
  for_cells(mesh, [&](std::size_t, const Cell& cell, std::span<const Vec3> nodes, std::size_t) {
    const CellQuality q = cell_quality(cell.kind, nodes);
    shape.push_back(q.shape), scaled.push_back(q.scaled_jacobian), least.push_back(q.least_jacobian);
    summary.angle_min_deg = std::min(summary.angle_min_deg, q.angle_min);
    summary.angle_max_deg = std::max(summary.angle_max_deg, q.angle_max);
    summary.area += q.area;
    if (corner_count(cell.kind) == 3) triangles += q.area;
    if (!(q.least_jacobian > 0)) ++summary.invalid;
    ++(cell.kind == CellKind::triangle3   ? summary.triangles3
       : cell.kind == CellKind::triangle6 ? summary.triangles6
       : cell.kind == CellKind::quad4     ? summary.quads4
                                          : summary.quads8);
  });
  if (shape.empty()) summary.angle_min_deg = 0;
  summary.triangle_share = summary.area > 0 ? triangles / summary.area : 0;
  summary.shape = distribution_of(shape);
  summary.scaled_jacobian = distribution_of(scaled);
  summary.least_jacobian = distribution_of(least);
  return summary;
}

}  // namespace carreau
