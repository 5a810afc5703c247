// SPDX-License-Identifier: BSD-3-Clause
// A step of Newton's method in the plane that stays in a box or triangle.
#pragma once

#include "support/vec.h"

namespace carreau::projection {

/// A box of the parameter plane, or its lower left half.
struct Region {
  Vec2 low, high;
  bool triangle = false;

  [[nodiscard]] Vec2 size() const { return high - low; }
};

/// A symmetric matrix of the plane.
struct Symmetric2 {
  double xx = 0, xy = 0, yy = 0;

  [[nodiscard]] Vec2 times(const Vec2& d) const { return {xx * d.x() + xy * d.y(), xy * d.x() + yy * d.y()}; }
};

struct RestrictedStep {
  Vec2 to;            ///< where it leads, in the region
  Vec2 d;             ///< the way there
  bool full = true;   ///< no border has cut it, and the Hessian was positive definite and not nearly singular
  double gain = 0;    ///< expected decrease of the function
};

/// The step from p that minimises the quadratic model of a function with this gradient and Hessian. `form` is the first fundamental form,
/// which gives lengths. Negative and small eigenvalues of the Hessian are replaced by positive ones, so that the step descends. At the
/// border the step follows it unless it leads inwards.
RestrictedStep restricted_step(const Region& region, const Vec2& p, const Vec2& gradient, const Symmetric2& hessian, const Symmetric2& form);

}  // namespace carreau::projection
