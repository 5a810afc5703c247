// SPDX-License-Identifier: BSD-3-Clause
#include "surface/elements/quads/quad_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carreau {

namespace {

constexpr double min_turned = 1e-9;                 // below 0, even if charts disagree
constexpr double square = 2 + 2 * std::numbers::sqrt2;  // its sigma

/// Edge lengths and diagonals of a quadrilateral, and twice the signed areas at its corners.
struct Measures {
  std::array<double, 4> edge{}, area2{};
  std::array<double, 2> diagonal{};  // 0 - 2, 1 - 3

  [[nodiscard]] double quality() const noexcept {
    double rho = area2[0], diameter = std::max(diagonal[0], diagonal[1]);
    for (int k = 0; k < 4; ++k) {
      const double around = edge[k] + edge[(k + 3) % 4] + diagonal[(k + 1) % 2];
      const double r = around > 0 ? area2[k] / around : 0;
      rho = k == 0 ? r : std::min(rho, r);
      diameter = std::max(diameter, edge[k]);
    }
    return rho > 0 ? square * rho / diameter : 0;
  }
  [[nodiscard]] double jacobian() const noexcept {
    double least = 1;
    for (int k = 0; k < 4; ++k) {
      const double sides = edge[k] * edge[(k + 3) % 4];
      least = std::min(least, sides > 0 ? area2[k] / sides : -1);
    }
    return least;
  }
};

Measures measure(const std::array<Vec2, 4>& p) noexcept {
  Measures m;
  for (int k = 0; k < 4; ++k) {
    const Vec2 to = p[(k + 1) % 4] - p[k], from = p[(k + 3) % 4] - p[k];
    m.edge[k] = norm(to);
    m.area2[k] = cross(to, from);
  }
  m.diagonal = {norm(p[2] - p[0]), norm(p[3] - p[1])};
  return m;
}

Measures measure(const std::array<Vec3, 4>& p) noexcept {
  Measures m;
  const Vec3 d = p[2] - p[0], e = p[3] - p[1];
  Vec3 normal = cross(d, e);
  if (const double size = norm(normal); size > 0) normal = (1 / size) * normal;
  for (int k = 0; k < 4; ++k) {
    const Vec3 to = p[(k + 1) % 4] - p[k], from = p[(k + 3) % 4] - p[k];
    m.edge[k] = norm(to);
    m.area2[k] = dot(normal, cross(to, from));
  }
  m.diagonal = {norm(d), norm(e)};
  return m;
}

}  // namespace

double quad_quality(const std::array<Vec2, 4>& p) noexcept { return measure(p).quality(); }
double quad_quality(const std::array<Vec3, 4>& p) noexcept { return measure(p).quality(); }
double scaled_jacobian(const std::array<Vec2, 4>& p) noexcept { return measure(p).jacobian(); }

double scaled_jacobian(const std::array<Vec3, 4>& p) noexcept {
  const std::array<Vec3, 4> side{p[1] - p[0], p[2] - p[1], p[3] - p[2], p[0] - p[3]};
  const Vec3 normal = cross(p[2] - p[0], p[3] - p[1]);
  const double size = norm(normal);
  std::array<double, 4> edge;
  for (int k = 0; k < 4; ++k) edge[k] = norm(side[k]);
  double least = 1;
  for (int k = 0; k < 4; ++k) {
    const double sides = edge[k] * edge[(k + 3) % 4] * size;
    least = std::min(least, sides > 0 ? dot(normal, cross(side[(k + 3) % 4], side[k])) / sides : -1);
  }
  return least;
}

bool is_turned_over(const std::array<Vec3, 4>& p) noexcept {
  const std::array<Vec3, 4> side{p[1] - p[0], p[2] - p[1], p[3] - p[2], p[0] - p[3]};
  const Vec3 normal = cross(p[2] - p[0], p[3] - p[1]);
  for (int k = 0; k < 4; ++k)
    if (!(dot(normal, cross(side[(k + 3) % 4], side[k])) > 0)) return true;
  return false;
}

double min_shape(const std::array<Vec3, 4>& p) noexcept {
  const Measures m = measure(p);
  const double jacobian = m.jacobian();
  return jacobian > 0 ? std::min(jacobian, m.quality()) : jacobian;
}

bool has_flat_corner(std::span<const char> fixed, std::span<const std::array<std::int32_t, 3>> flat,
                     const MixedCell& cell) noexcept {
  const int n = corners_of(cell);
  for (int k = 0; k < n && !flat.empty(); ++k) {
    const std::int32_t a = cell[k], v = cell[(k + 1) % n], b = cell[(k + 2) % n];
    if (fixed[a] == 0 || fixed[v] == 0 || fixed[b] == 0) continue;
    if (std::binary_search(flat.begin(), flat.end(), std::array{v, a, b})) return true;
  }
  return false;
}

double cell_quality(const QuadPatch& patch, const FaceCharts& charts, const MixedCell& cell) noexcept {
  return cell_quality(patch, charts.about(patch, cell), cell);
}

double cell_quality(const QuadPatch& patch, const Chart& chart, const MixedCell& cell) noexcept {
  std::array<Vec2, 4> y;
  const int n = corners_of(cell);
  for (int k = 0; k < n; ++k) y[k] = chart.at(patch.uv[cell[k]]);
  if (n == 4) return quad_quality(y);
  const Vec2 a = y[1] - y[0], b = y[2] - y[0], c = b - a;
  return std::max(0.0, 2 * std::numbers::sqrt3 * cross(a, b) / (dot(a, a) + dot(b, b) + dot(c, c)));
}

double untangling_quality(const QuadPatch& patch, const Chart& chart, const MixedCell& cell) noexcept {
  if (is_convex(patch, cell)) return cell_quality(patch, chart, cell);
  std::array<Vec2, 4> y;
  const int n = corners_of(cell);
  for (int k = 0; k < 4; ++k) y[k] = chart.at(patch.uv[cell[k % n]]);
  if (n == 4) return std::min(scaled_jacobian(y), -min_turned);
  const double sides = norm(y[1] - y[0]) * norm(y[2] - y[0]);
  return sides > 0 ? std::min(cross(y[1] - y[0], y[2] - y[0]) / sides, -min_turned) : -1;
}

}  // namespace carreau
