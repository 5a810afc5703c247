// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/molecule/sphere_patch.h"

#include <cmath>
#include <utility>

namespace carreau::molecule {

SpherePatch::SpherePatch(const Ball& ball, const Vec3& pole, std::vector<SpaceArc> border, Side side)
    : ball_(ball), x_(across(pole)), z_(pole), border_(std::move(border)) {
  // Opposite the pole Su x Sv = x cross y, which points outwards there.
  y_ = side == Side::outer ? cross(x_, z_) : cross(z_, x_);
}

// With q = 1/(u^2 + v^2 + 4 r^2), eq. 4.86 seen from the centre has x = 4 r^2 u q, y = 4 r^2 v q, z = r - 8 r^3 q.
SurfaceJet SpherePatch::surface(const Vec2& uv) const {
  const double u = uv.x(), v = uv.y(), r = ball_.radius, s = 4 * r * r, q = 1 / (u * u + v * v + s);
  const double qu = -2 * u * q * q, qv = -2 * v * q * q, cube = 8 * q * q * q;
  const double quu = u * u * cube - 2 * q * q, quv = u * v * cube, qvv = v * v * cube - 2 * q * q;
  SurfaceJet jet;
  jet.s = ball_.centre + in_space(s * u * q, s * v * q, r - 2 * r * s * q);
  jet.su = s * in_space(q + u * qu, v * qu, -2 * r * qu);
  jet.sv = s * in_space(u * qv, q + v * qv, -2 * r * qv);
  jet.suu = s * in_space(2 * qu + u * quu, v * quu, -2 * r * quu);
  jet.suv = s * in_space(qv + u * quv, qu + v * quv, -2 * r * quv);
  jet.svv = s * in_space(u * qvv, 2 * qv + v * qvv, -2 * r * qvv);
  return jet;
}

// The inverse chart along an arc, by the rule of quotients: u = 2 r x / (r - z), v = 2 r y / (r - z).
CurveJet SpherePatch::curve(std::size_t curve, double t) const {
  const SpaceArc& arc = border_[curve];
  const double angle = arc.backward ? arc.a + arc.b - t : t, sign = arc.backward ? -1 : 1;
  const double c = std::cos(angle), s = std::sin(angle), d = 2 * ball_.radius;
  const Vec3 out = in_axes(arc.radius * (c * arc.e1 + s * arc.e2));
  const Vec3 p = in_axes(arc.centre - ball_.centre) + out;
  const Vec3 p1 = sign * in_axes(arc.radius * (c * arc.e2 - s * arc.e1)), p2 = -out;
  const double w = ball_.radius - p.z(), w1 = -p1.z(), w2 = -p2.z();
  CurveJet jet;
  jet.c = Vec2{d * p.x() / w, d * p.y() / w};
  jet.ct = (Vec2{d * p1.x(), d * p1.y()} - w1 * jet.c) / w;
  jet.ctt = (Vec2{d * p2.x(), d * p2.y()} - 2 * w1 * jet.ct - w2 * jet.c) / w;
  return jet;
}

}  // namespace carreau::molecule
