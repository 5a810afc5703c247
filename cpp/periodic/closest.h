// SPDX-License-Identifier: BSD-3-Clause
// Closest points of surfaces and curves near known parameters.
#pragma once

#include <span>

#include "curve/curve_model.h"

namespace carreau {

/// A point of a surface.
struct ClosestPoint {
  Vec2 uv;              ///< at first the parameters to begin from
  Vec3 xyz;
  double distance = 0;  ///< from the target
};

/// Moves each point to the place of the surface closest to its target by Gauss-Newton steps, which converge quadratically
/// where the target lies on the surface. `face`: reference. A point is never farther from its target than at first.
void find_closest(Cad& cad, int face, std::span<const Vec3> targets, std::span<ClosestPoint> points);

/// Returns the point of a use of a curve with t in [t_low, t_high] closest to the target, by the same steps from `t`.
CurvePoint find_closest(const CurveModel& model, const CurveUse& use, double t, double t_low, double t_high, const Vec3& target);

}  // namespace carreau
