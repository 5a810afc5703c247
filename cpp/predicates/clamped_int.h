// SPDX-License-Identifier: BSD-3-Clause
// Integers of real numbers, within bounds.
#pragma once

namespace carreau {

/// Returns the integer part of x, at least low and at most high; low for NaN. low is not negative. A plain conversion of a
/// number beyond the range of int is undefined, even before std::clamp.
[[nodiscard]] constexpr int clamped_int(double x, int low, int high) noexcept {
  if (!(x > low)) return low;
  return x < high ? static_cast<int>(x) : high;
}

}  // namespace carreau
