// SPDX-License-Identifier: BSD-3-Clause
#include "cad/stencil.h"

#include <algorithm>
#include <cmath>

namespace carreau {

Stencil stencil_of(int order, Side side) noexcept {
  if (side == Side::central) return order == 1 ? Stencil{2, {-1, 1}, {-0.5, 0.5}} : Stencil{3, {-1, 0, 1}, {1, -2, 1}};
  Stencil stencil = order == 1 ? Stencil{3, {0, 1, 2}, {-1.5, 2, -0.5}} : Stencil{4, {0, 1, 2, 3}, {2, -5, 4, -1}};
  if (side == Side::forward) return stencil;
  // Mirrored: odd derivatives change sign.
  for (double& offset : stencil.offset) offset = -offset;
  if (order == 1)
    for (double& weight : stencil.weight) weight = -weight;
  return stencil;
}

DifferenceStep difference_step(double x, double low, double high, double relative) noexcept {
  const double range = high - low;
  // Far from the origin a host cannot be more precise than its argument: eps |x| / step against step^2 / range^2.
  const double scale = range * std::max(1.0, std::cbrt(std::max(std::abs(low), std::abs(high)) / range));
  // Three steps, the longest stencil, must fit on one side whatever x is.
  const double wanted = std::min(relative * scale, range / 8);
  const double step = std::exp2(std::floor(std::log2(wanted)));
  if (x - step < low) return {step, Side::forward};
  if (x + step > high) return {step, Side::backward};
  return {step, Side::central};
}

}  // namespace carreau
