// SPDX-License-Identifier: BSD-3-Clause
// A polynomial surface over the plane of a chart.
#pragma once

#include "geometry/atlas/height_field.h"

namespace carreau::atlas {

/// Three cubic polynomials of the chart's coordinates. It starts as a quadratic height field. If neighbours disagree
/// places move along the plane, too: the transitions between charts are no projections.
struct Primitive {
  static constexpr int terms = 10;
  template <typename Number>
  using BasisOf = std::array<Number, terms>;
  using Basis = BasisOf<double>;
  /// Coefficients of 1, x, y, x^2, x y, y^2, x^3, x^2 y, x y^2, y^3, with x and y in units of `unit`.
  std::array<Vec3, terms> coefficient = zeros();
  double unit = 1;

  static std::array<Vec3, terms> zeros() {
    std::array<Vec3, terms> c;
    c.fill(Vec3(0, 0, 0));
    return c;
  }

  template <typename Number>
  [[nodiscard]] std::array<Number, 3> at(const Pair<Number>& p) const {
    const Number x = p[0] / unit, y = p[1] / unit;
    std::array<Number, 3> s;
    for (int i = 0; i < 3; ++i) {
      const auto c = [&](std::size_t k) { return coefficient[k][i]; };
      s[static_cast<std::size_t>(i)] = c(0) + x * (c(1) + x * (c(3) + c(6) * x + c(7) * y) + c(4) * y) +
                                       y * (c(2) + y * (c(5) + c(8) * x + c(9) * y));
    }
    return s;
  }
  template <typename Number>
  [[nodiscard]] BasisOf<Number> basis(const Pair<Number>& p) const {
    const Number x = p[0] / unit, y = p[1] / unit;
    return {Number(1.0), x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y};
  }
};

inline Primitive primitive_of(const HeightField& field, const Frame& frame) {
  Primitive p;
  p.unit = field.unit;
  for (std::size_t k = 0; k < 6; ++k) p.coefficient[k] = field.coefficient[k] * frame.normal;
  p.coefficient[0] += frame.origin, p.coefficient[1] += field.unit * frame.u, p.coefficient[2] += field.unit * frame.v;
  return p;
}

}  // namespace carreau::atlas
