// SPDX-License-Identifier: BSD-3-Clause
#include "check/triangle_shape.h"

#include <cmath>

namespace command {
double size_of(const Point& a, const Point& b, const Point& c) {
  const Point n = cross(minus(b, a), minus(c, a));
  return std::sqrt(2 / std::sqrt(3.0)) * std::pow(dot(n, n), 0.25);
}

double shape_quality(const Point& a, const Point& b, const Point& c) {
  const Point ab = minus(b, a), ac = minus(c, a), bc = minus(c, b), n = cross(ab, ac);
  const double squares = dot(ab, ab) + dot(ac, ac) + dot(bc, bc);
  return squares > 0 ? 2 * std::sqrt(3.0) * std::sqrt(dot(n, n)) / squares : 0;
}

}  // namespace command
