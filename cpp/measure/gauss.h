// Gauss quadrature on [0, 1].
#pragma once

#include <vector>

namespace carreau {

struct GaussRule {
  std::vector<double> node;    ///< ascending, inside ]0, 1[
  std::vector<double> weight;  ///< their sum is 1
};

/// The Gauss-Legendre rule of n points, exact for polynomials of degree 2 n - 1. Throws InvalidArgument unless n is
/// between 1 and 64.
GaussRule gauss_rule(int n);

}  // namespace carreau
