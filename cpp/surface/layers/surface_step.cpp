// SPDX-License-Identifier: BSD-3-Clause
#include "surface/layers/surface_step.h"

#include <algorithm>
#include <cmath>

#include "support/infinity.h"
#include "support/shares.h"
#include "support/work_bounds.h"

namespace carreau {

Vec2 in_parameters(const SurfaceJet& jet, const Vec3& v) {
  const double e = dot(jet.su, jet.su), f = dot(jet.su, jet.sv), g = dot(jet.sv, jet.sv), det = e * g - f * f;
  const double a = dot(jet.su, v), b = dot(jet.sv, v);
  if (!(det > 0)) return {0, 0};
  return {(g * a - f * b) / det, (e * b - f * a) / det};
}

bool find_step(Cad& cad, int face, const ColumnPlane& plane, const Vec3& p, double step,
               const std::function<bool(const Vec2&)>& is_inside, Vec2& at, SurfaceJet& jet) {
  double best = infinity;
  const double noise = 4e-16 * (norm(p) + step);
  for (int k = 0; k < work_bounds::passes; ++k) {
    if (!is_finite(at) || !is_inside(at)) return false;
    jet = surface_at(cad, face, want_position | want_first, at);
    const Vec3 from = jet.s - p;
    const double length = norm(from);
    if (!(length > 0)) return false;
    const double off = dot(jet.s - plane.base, plane.across), error = length - step;
    const double worst = std::max(std::abs(off), std::abs(error));
    if (worst <= std::max(1e-12 * step, noise) || (worst >= best && best <= 1e-9 * step)) return true;
    best = std::min(best, worst);
    const Vec3 radial = (1 / length) * from;
    const double a = dot(jet.su, plane.across), b = dot(jet.sv, plane.across), c = dot(jet.su, radial), d = dot(jet.sv, radial);
    const double det = a * d - b * c;
    if (!(std::abs(det) > 0)) return false;
    at = at - Vec2((d * off - b * error) / det, (a * error - c * off) / det);
  }
  const double off = std::abs(dot(jet.s - plane.base, plane.across)), error = std::abs(norm(jet.s - p) - step);
  // Accepted errors across and along the column. Two steps suffice on smooth surfaces.
  return off <= shares::small * step && error <= shares::negligible * step;
}

}  // namespace carreau
