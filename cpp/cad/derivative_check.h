// SPDX-License-Identifier: BSD-3-Clause
// Registered derivatives against finite differences.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cad/cad.h"
#include "support/error.h"

namespace carreau {

/// The place where a routine contradicts the routine below it, and both values.
struct WrongDerivative {
  Where where;
  std::string sentence;  ///< without the place
  [[nodiscard]] std::string text() const { return where.prefix() + sentence; }
};

/// Compares surf1, and surf2 when `second`, with differences of the order below at the points `uv` of a face whose
/// parameters fill the box [low, high]. Only the host's own derivatives are compared (Cad::surface_gives). At most one
/// a routine.
///
/// A derivative is wrong when it is more than 1 % off at two step sizes whose differences agree. It must also be off
/// from either side, and again at a point nearby. So rounding, kinks, poles and points where it is not defined are no
/// alarm; nor are points where the host fails. Stencils stay in the box. A sound host is called 5 times a point (1
/// surf1, 4 surf0), 10 times when `second` (1 surf2 and 4 surf1 more).
std::vector<WrongDerivative> find_wrong_surface_derivatives(Cad& cad, int face, std::span<const Vec2> uv, Vec2 low,
                                                            Vec2 high, bool second);

/// Compares curv1, and curv2 when `second`, at parameters `t` of a curve with interval `range`: 3 calls a point, 6 when
/// `second`.
std::vector<WrongDerivative> find_wrong_curve_derivatives(Cad& cad, int face, int ic, std::span<const double> t,
                                                          Interval range, bool second);

}  // namespace carreau
