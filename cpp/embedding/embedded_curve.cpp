// SPDX-License-Identifier: BSD-3-Clause
#include "embedding/embedded_curve.h"

#include <algorithm>

namespace carreau {

CurveJet EmbeddedCurve::at(double at) const {
  const auto behind = std::upper_bound(t.begin() + 1, t.end() - 1, at);
  const auto i = static_cast<std::size_t>(behind - t.begin()) - 1;
  const double h = t[i + 1] - t[i], w = (at - t[i]) / h;
  const Vec2 p = uv[i], q = uv[i + 1], a = h * start[i], b = h * finish[i];
  const Vec2 square = 3 * (q - p) - 2 * a - b, cube = 2 * (p - q) + a + b;
  CurveJet jet;
  // From the nearer end, so that both ends are exact.
  if (w <= 0.5) {
    jet.c = p + w * (a + w * (square + w * cube));
  } else {
    const double z = 1 - w;
    const Vec2 back_square = 3 * (p - q) + 2 * b + a, back_cube = 2 * (q - p) - a - b;
    jet.c = q + z * (-b + z * (back_square + z * back_cube));
  }
  jet.ct = (a + w * (2 * square + 3 * w * cube)) / h;
  jet.ctt = (2 * square + 6 * w * cube) / (h * h);
  return jet;
}

}  // namespace carreau
