// SPDX-License-Identifier: BSD-3-Clause
// An increasing function between two values with given slopes: two parabolas, whose inverse has a closed form.
#pragma once

#include "atlas/jet.h"

namespace carreau::atlas {

/// Values and slopes at both ends of [x1, x2]. Slopes may depend on a parameter, and are then jets.
template <typename Number>
struct HermiteData {
  double x1, x2, y1, y2;
  Number slope1, slope2;

  [[nodiscard]] double middle() const { return (x1 + x2) / 2; }
  /// Value where both parabolas meet (Atlas, app. C.2).
  [[nodiscard]] Number middle_value() const { return (y1 + y2) / 2 + (slope1 - slope2) * ((x2 - x1) / 8); }
  [[nodiscard]] Number first_coefficient() const {
    const double d = x2 - x1;
    return 2 * (y2 - y1) / (d * d) - (3 * slope1 + slope2) / (2 * d);
  }
  [[nodiscard]] Number second_coefficient() const {
    const double d = x2 - x1;
    return (slope1 + 3 * slope2) / (2 * d) - 2 * (y2 - y1) / (d * d);
  }
};

/// The function at x. It increases when both slopes are positive and at most (y2 - y1) / (x2 - x1) (Atlas eq. 5.5).
template <typename Number, typename Slope>
auto hermite(const HermiteData<Slope>& h, const Number& x) {
  if (value_of(x) <= h.middle()) return h.y1 + (x - h.x1) * (h.slope1 + h.first_coefficient() * (x - h.x1));
  return h.y2 + (x - h.x2) * (h.slope2 + h.second_coefficient() * (x - h.x2));
}

/// Its inverse: the root with the sign that stays away from a division by zero.
template <typename Number, typename Slope>
auto hermite_inverse(const HermiteData<Slope>& h, const Number& y) {
  using std::sqrt;
  // Slightly outside of the interval the parabolas still increase, until their apex.
  const auto root = [](const auto& square) {
    return value_of(square) > 0 ? sqrt(square) : decltype(sqrt(square))(0.0);
  };
  if (value_of(y) <= value_of(h.middle_value())) {
    const auto rise = y - h.y1;
    return h.x1 + 2 * rise / (h.slope1 + root(h.slope1 * h.slope1 + 4 * h.first_coefficient() * rise));
  }
  const auto fall = h.y2 - y;
  return h.x2 - 2 * fall / (h.slope2 + root(h.slope2 * h.slope2 - 4 * h.second_coefficient() * fall));
}

/// 2 s^3 - 3 s^2 + 1: from 1 at 0 to 0 at 1, with zero slopes (Atlas sec. 5.5.2.1).
template <typename Number>
Number beta(const Number& s) {
  return (2 * s - 3) * s * s + 1;
}

}  // namespace carreau::atlas
