// SPDX-License-Identifier: BSD-3-Clause
// One-dimensional finite-difference formulas.
#pragma once

namespace carreau {

/// Side of the formula's points with regard to the point of interest.
enum class Side { central, forward, backward };

/// f^(order)(x) = sum of weight[i] f(x + offset[i] step) / step^order + O(step^2).
struct Stencil {
  int count = 0;
  double offset[4] = {}, weight[4] = {};
};

/// Formulas of second order of accuracy; order of derivative 1 or 2.
Stencil stencil_of(int order, Side side) noexcept;

/// A step and the side for it.
struct DifferenceStep {
  double step = 0;
  Side side = Side::central;
};

/// The step `relative` * (high - low), rounded to a power of two so that x + step - x is the step. Also the side that
/// keeps every stencil inside [low, high]. Never below the limit from rounding of x. Any x; low < high, both finite.
DifferenceStep difference_step(double x, double low, double high, double relative) noexcept;

}  // namespace carreau
