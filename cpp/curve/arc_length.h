// SPDX-License-Identifier: BSD-3-Clause
// Arc length along a sampled curve: the part of a support that does not evaluate the host.
#pragma once

#include <cstddef>
#include <vector>

#include "curve/support.h"

namespace carreau {

/// Second derivative of a sampled curve at interior sample i, from the parabola through samples i - 1, i, i + 1.
template <typename V>
V bend_at(const std::vector<double>& t, const std::vector<V>& points, std::size_t i) noexcept {
  const double left = t[i] - t[i - 1];
  const double right = t[i + 1] - t[i];
  return (2 / (left + right)) * ((1 / right) * (points[i + 1] - points[i]) - (1 / left) * (points[i] - points[i - 1]));
}

/// Fills arc and slope from t and xyz.
void fill_arc(CurveSupport& support);

}  // namespace carreau
