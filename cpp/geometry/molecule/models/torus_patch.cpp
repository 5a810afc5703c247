// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/molecule/models/torus_patch.h"

#include <algorithm>
#include <cmath>

namespace carreau::molecule {

Tube tube_of(const Circle& circle, double probe) {
  Tube tube{.rho = circle.radius, .radius = probe};
  tube.low = -std::atan2(circle.offset_i, circle.radius), tube.high = std::atan2(circle.offset_j, circle.radius);
  tube.spindle = tube.rho < probe && tube.low < 0 && tube.high > 0;
  if (tube.spindle) tube.tip = std::acos(tube.rho / probe);
  return tube;
}

// dA = p s dphi dtheta with s = rho - p cos(phi). Antiderivatives in phi of s, s cos, s sin and s (s cos - p sin^2).
TorusMeasures measure_torus(const Circle& circle, const Tube& tube, double a, double b, double low, double high,
                            const Vec3& origin) {
  const double p = tube.radius, rho = tube.rho;
  const auto difference = [&](auto&& f) {
    return f(std::sin(high), std::cos(high), high) - f(std::sin(low), std::cos(low), low);
  };
  const double s0 = difference([&](double sin, double, double phi) { return rho * phi - p * sin; });
  const double s_cos =
      difference([&](double sin, double cos, double phi) { return rho * sin - p / 2 * (phi + sin * cos); });
  const double s_sin = difference([&](double, double cos, double) { return p / 2 * cos * cos - rho * cos; });
  const double moment = difference([&](double sin, double cos, double phi) {
    return (rho * rho + p * p) * sin - p * rho * (1.5 * phi + sin * cos / 2);
  });
  const Vec3 radial = (std::sin(b) - std::sin(a)) * circle.e1 + (std::cos(a) - std::cos(b)) * circle.e2;
  const Vec3 normal = p * (s_cos * radial - (b - a) * s_sin * circle.axis);
  return {(b - a) * p * s0, dot(circle.centre - origin, normal) + (b - a) * p * moment};
}

TorusPatch::TorusPatch(const Circle& circle, const Tube& tube, double a, double b, double low, double high)
    : circle_(circle),
      tube_(tube),
      a_(a),
      b_(b),
      low_(low),
      high_(high),
      unit_(std::max(tube.from_axis(low), tube.from_axis(high))) {}

SurfaceJet TorusPatch::surface(const Vec2& uv) const {
  const double theta = uv.x() / unit_, phi = uv.y() / tube_.radius;
  const double cos = std::cos(phi), sin = std::sin(phi), s = tube_.from_axis(phi);
  const Vec3 out = std::cos(theta) * circle_.e1 + std::sin(theta) * circle_.e2;
  const Vec3 along = std::cos(theta) * circle_.e2 - std::sin(theta) * circle_.e1;
  SurfaceJet jet;
  jet.s = circle_.centre + s * out + tube_.radius * sin * circle_.axis;
  jet.su = s / unit_ * along;
  jet.sv = sin * out + cos * circle_.axis;
  jet.suu = -s / (unit_ * unit_) * out;
  jet.suv = sin / unit_ * along;
  jet.svv = (cos * out - sin * circle_.axis) / tube_.radius;
  return jet;
}

double TorusPatch::radius(const Vec2& uv) const {
  const double cos = std::cos(uv.y() / tube_.radius);
  return std::min(tube_.radius, std::abs(tube_.rho / cos - tube_.radius));
}

Interval TorusPatch::interval(std::size_t curve) const {
  if (curve % 2 == 0) return {unit_ * a_, unit_ * b_};
  return {tube_.radius * low_, tube_.radius * high_};
}

CurveJet TorusPatch::curve(std::size_t curve, double t) const {
  const double u0 = unit_ * a_, u1 = unit_ * b_, v0 = tube_.radius * low_, v1 = tube_.radius * high_;
  switch (curve) {
    case 0:
      return {{t, v0}, {1, 0}, {0, 0}};
    case 1:
      return {{u1, t}, {0, 1}, {0, 0}};
    case 2:
      return {{u0 + u1 - t, v1}, {-1, 0}, {0, 0}};
    default:
      return {{u0, v0 + v1 - t}, {0, -1}, {0, 0}};
  }
}

double TorusPatch::curve_radius(std::size_t curve) const {
  if (curve % 2 == 1) return tube_.radius;
  return std::abs(tube_.from_axis(curve == 0 ? low_ : high_));
}

}  // namespace carreau::molecule
