// SPDX-License-Identifier: BSD-3-Clause
// Heights over the plane of a chart.
#pragma once

#include <span>
#include <vector>

#include "atlas/covering/covering.h"

namespace carreau::atlas {

/// A polynomial of two variables.
struct HeightField {
  int degree = 0;
  /// Coefficients of 1, x, y, x^2, x y, y^2, x^3, ..., y^degree, with x and y in units of `unit`.
  std::vector<double> coefficient{0.};
  double unit = 1;

  template <typename Number>
  [[nodiscard]] Number at(const Pair<Number>& p) const {
    const Number x = p[0] / unit, y = p[1] / unit;
    Number sum = 0.0;
    // Terms x^i y^j by falling i; each row is a polynomial of y.
    for (int i = degree; i >= 0; --i) {
      Number row = 0.0;
      for (int j = degree - i; j >= 0; --j) row = row * y + coefficient[rank(i, j)];
      sum = sum * x + row;
    }
    return sum;
  }

  static std::size_t rank(int i, int j) { return static_cast<std::size_t>((i + j) * (i + j + 1) / 2 + j); }
  static std::size_t terms(int degree) { return rank(0, degree) + 1; }
};

/// A point (x, y, height) with its weight in a sum of squares.
struct Height {
  Vec3 at{0, 0, 0};
  double weight = 1;
};

/// Fits heights by least squares; coefficients that the points do not determine are small.
HeightField fit_heights(std::span<const Height> points, int degree);

/// The quadratic field of the heights of a chart's region, at its vertices and at the vertices of its border.
HeightField coarse_heights(const Covering& covering, const Chart& chart);

/// Heights about one vertex, and the ellipsoid in which they count: form[0] x^2 + form[1] x y + form[2] y^2 + form[3]
/// z^2 < 1 in the frame of the vertex.
struct LocalHeights {
  Frame frame;
  HeightField field;
  std::array<double, 4> form{1, 0, 1, 1};
  double reach = 0;  ///< the radius of a ball that holds the ellipsoid
};

/// Fits a field of higher degree to the vertices of three rings whose normals are not steep over the vertex's plane;
/// near vertices weigh more. Distances are relative to the fan of the vertex, which can be longer than wide.
LocalHeights local_heights(const Covering& covering, std::int32_t vertex);

}  // namespace carreau::atlas
