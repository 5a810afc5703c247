// SPDX-License-Identifier: BSD-3-Clause
// Gauss quadrature on [0, 1] and on triangles.
#pragma once

#include <array>
#include <vector>

namespace carreau {

struct GaussRule {
  std::vector<double> node;    ///< ascending, inside ]0, 1[
  std::vector<double> weight;  ///< their sum is 1
};

/// The Gauss-Legendre rule of n points, exact for polynomials of degree 2 n - 1. Throws InvalidArgument unless n is
/// between 1 and 64.
GaussRule gauss_rule(int n);

/// A place of a triangle by its corners, and its weight.
struct Barycentric {
  double a, b, c, weight;
};

/// Radon's rule of seven points, exact up to degree 5; weights have the sum 1. Its first place is the centre, at which
/// a near equilateral triangle is farthest from a surface.
std::array<Barycentric, 7> triangle_rule();

}  // namespace carreau
