// SPDX-License-Identifier: BSD-3-Clause
// A quadratic height field over the plane of a chart.
#pragma once

#include <array>
#include <span>

#include "atlas/covering/covering.h"

namespace carreau::atlas {

struct HeightField {
  /// Coefficients of 1, x, y, x^2, x y, y^2, with x and y in units of `unit`.
  std::array<double, 6> coefficient{};
  double unit = 1;

  template <typename Number>
  [[nodiscard]] Number at(const Pair<Number>& p) const {
    const Number x = p[0] / unit, y = p[1] / unit;
    const auto& c = coefficient;
    return c[0] + x * (c[1] + c[3] * x + c[4] * y) + y * (c[2] + c[5] * y);
  }
};

/// Fits points (x, y, height) by least squares; coefficients that the points do not determine are small.
HeightField fit_heights(std::span<const Vec3> points);

/// The heights of a chart's region, at its vertices and at the vertices of its border.
HeightField fit_heights(const Triangulation& surface, const Chart& chart);

}  // namespace carreau::atlas
