// SPDX-License-Identifier: BSD-3-Clause
#include "draw/drawn_elements.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace command {
namespace {

/// Sum of nodes times weights.
Point sum(const std::array<Point, 8>& x, const std::array<double, 8>& weights) {
  Point p{};
  for (std::size_t i = 0; i < 8; ++i)
    for (std::size_t k = 0; k < 3; ++k) p[k] += weights[i] * x[i][k];
  return p;
}

/// The point of an element at (s, t) of the triangle s, t >= 0, s + t <= 1, or of the unit square.
Point at(std::int32_t kind, const std::array<Point, 8>& x, double s, double t) {
  const double r = 1 - s - t, p = 1 - s, q = 1 - t;
  switch (kind) {
    case CARREAU_CELL_TRIANGLE6:
      return sum(x, {r * (2 * r - 1), s * (2 * s - 1), t * (2 * t - 1), 4 * r * s, 4 * s * t, 4 * t * r, 0, 0});
    case CARREAU_CELL_QUAD8:
      return sum(x, {p * q * (1 - 2 * s - 2 * t), s * q * (1 - 2 * p - 2 * t), s * t * (1 - 2 * p - 2 * q),
                     p * t * (1 - 2 * s - 2 * q), 4 * s * p * q, 4 * t * q * s, 4 * s * p * t, 4 * t * q * p});
    case CARREAU_CELL_QUAD4:
      return sum(x, {p * q, s * q, s * t, p * t, 0, 0, 0, 0});
    default:
      return sum(x, {r, s, t, 0, 0, 0, 0, 0});
  }
}

/// Corners of a grid of n pieces a side: (i, k) counts from corner 0 towards corner 1 and towards the last.
using Place = std::array<int, 2>;

/// The side of the element on which the segment between two places lies.
int side_of(bool quad, int n, Place a, Place b) {
  if (a[1] == 0 && b[1] == 0) return 0;
  if (a[0] == 0 && b[0] == 0) return quad ? 3 : 2;
  if (!quad) return a[0] + a[1] == n && b[0] + b[1] == n ? 1 : -1;
  if (a[0] == n && b[0] == n) return 1;
  return a[1] == n && b[1] == n ? 2 : -1;
}

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

}  // namespace

std::vector<DrawnTriangle> drawn(const Element& element, const std::array<Point, 8>& x, int pieces) {
  const int n = element.is_curved() ? pieces : 1;
  const bool quad = element.corners() == 4;
  std::vector<DrawnTriangle> triangles;
  const auto add = [&](Place a, Place b, Place c) {
    DrawnTriangle triangle{};
    triangle.half = quad && a[0] + b[0] + c[0] < a[1] + b[1] + c[1] ? 1 : 0;
    const std::array<Place, 3> places{a, b, c};
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.corners[k] = at(element.kind, x, double(places[k][0]) / n, double(places[k][1]) / n);
      triangle.side[k] = side_of(quad, n, places[k], places[(k + 1) % 3]);
    }
    triangles.push_back(triangle);
  };
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < (quad ? n : n - k); ++i) {
      const bool whole = quad || i + k + 1 < n;
      if (quad) {
        add({i, k}, {i + 1, k}, {i + 1, k + 1});
        add({i, k}, {i + 1, k + 1}, {i, k + 1});
      } else {
        add({i, k}, {i + 1, k}, {i, k + 1});
        if (whole) add({i + 1, k}, {i + 1, k + 1}, {i, k + 1});
      }
    }
  return triangles;
}

double shape_of_quad(const std::array<Point, 8>& x) {
  double diameter = 0, rho = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 4; ++i) {
    const double a = distance(x[i], x[(i + 1) % 4]), b = distance(x[(i + 1) % 4], x[(i + 2) % 4]),
                 c = distance(x[i], x[(i + 2) % 4]), s = (a + b + c) / 2;
    diameter = std::max({diameter, a, b, c});
    if (!(s > 0)) return 0;
    rho = std::min(rho, std::sqrt(std::max(0.0, (s - a) * (s - b) * (s - c) / s)));  // Heron: area / s
  }
  return diameter > 0 ? (2 + 2 * std::sqrt(2.0)) * rho / diameter : 0;
}

}  // namespace command
