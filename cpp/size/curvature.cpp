// SPDX-License-Identifier: BSD-3-Clause
// Radii of curvature of surfaces and of curves on them (declared in size_rules.h).
#include <cmath>

#include "metric/thresholds.h"
#include "size/size_rules.h"
#include "support/infinity.h"

namespace carreau {
namespace {

using namespace thresholds::degenerate;

}  // namespace

std::optional<double> smallest_radius(const SurfaceJet& jet) noexcept {
  const double e1 = dot(jet.su, jet.su);
  const double f1 = dot(jet.su, jet.sv);
  const double g1 = dot(jet.sv, jet.sv);
  const Vec3 n = cross(jet.su, jet.sv);
  const double det = dot(n, n);  // E G - F^2 without its cancellation
  if (!(e1 > collapsed * g1) || !(g1 > collapsed * e1) || !(det > parallel * e1 * g1)) return {};
  const double area = std::sqrt(det);
  const double e2 = dot(n, jet.suu) / area;
  const double f2 = dot(n, jet.suv) / area;
  const double g2 = dot(n, jet.svv) / area;
  // Roots of kappa^2 - 2 H kappa + K (RR-2928 sec. 5.2.1). The difference of the roots is a sum of squares in an
  // orthonormal frame, so that the cancellation in H^2 - K does not spoil an umbilic.
  const double a = e2 / e1;
  const double b = (f2 - f1 * a) / area;  // off the diagonal
  const double c = (g2 - 2 * f1 / e1 * f2 + f1 * f1 / e1 * a) * e1 / det;
  const double largest = std::abs(a + c) / 2 + std::hypot((a - c) / 2, b);
  if (std::isnan(largest)) return {};
  return largest > 0 ? 1 / largest : infinity;
}

double curve_radius(const SurfaceJet& surface, const CurveJet& curve) noexcept {
  const double u1 = curve.ct.x(), v1 = curve.ct.y();
  // First and second derivative of S(C(t)) (HDR eq. 4.80 differentiated twice).
  const Vec3 first = u1 * surface.su + v1 * surface.sv;
  const Vec3 second = (u1 * u1) * surface.suu + (2 * u1 * v1) * surface.suv + (v1 * v1) * surface.svv +
                      curve.ctt.x() * surface.su + curve.ctt.y() * surface.sv;
  const double speed = norm(first);
  const double turning = norm(cross(first, second));
  if (!(speed > 0) || !(turning > 0)) return infinity;
  return speed / turning * speed * speed;
}

}  // namespace carreau
