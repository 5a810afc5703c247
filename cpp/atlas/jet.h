// SPDX-License-Identifier: BSD-3-Clause
// Numbers with derivatives to order two by two parameters: one formula gives value and derivatives exactly.
#pragma once

#include <array>
#include <cmath>

#include "support/vec.h"

namespace carreau::atlas {

/// f, f_u, f_v, f_uu, f_uv, f_vv.
struct Jet {
  double f = 0, u = 0, v = 0, uu = 0, uv = 0, vv = 0;

  Jet() = default;
  Jet(double value) : f(value) {}  // NOLINT(google-explicit-constructor): constants mix with jets in formulas
  Jet(double value, double by_u, double by_v) : f(value), u(by_u), v(by_v) {}

  /// g(f) with the first and second derivative of g at f.
  [[nodiscard]] Jet chain(double g, double g1, double g2) const {
    Jet r(g, g1 * u, g1 * v);
    r.uu = g2 * u * u + g1 * uu, r.uv = g2 * u * v + g1 * uv, r.vv = g2 * v * v + g1 * vv;
    return r;
  }
};

inline Jet operator+(const Jet& a, const Jet& b) {
  Jet r(a.f + b.f, a.u + b.u, a.v + b.v);
  r.uu = a.uu + b.uu, r.uv = a.uv + b.uv, r.vv = a.vv + b.vv;
  return r;
}
inline Jet operator-(const Jet& a) { return a.chain(-a.f, -1, 0); }
inline Jet operator-(const Jet& a, const Jet& b) { return a + -b; }
inline Jet operator*(const Jet& a, const Jet& b) {
  Jet r(a.f * b.f, a.u * b.f + a.f * b.u, a.v * b.f + a.f * b.v);
  r.uu = a.uu * b.f + 2 * a.u * b.u + a.f * b.uu;
  r.uv = a.uv * b.f + a.u * b.v + a.v * b.u + a.f * b.uv;
  r.vv = a.vv * b.f + 2 * a.v * b.v + a.f * b.vv;
  return r;
}
inline Jet operator/(const Jet& a, const Jet& b) {
  const double g = 1 / b.f;
  return a * b.chain(g, -g * g, 2 * g * g * g);
}
inline Jet sin(const Jet& a) { return a.chain(std::sin(a.f), std::cos(a.f), -std::sin(a.f)); }
inline Jet cos(const Jet& a) { return a.chain(std::cos(a.f), -std::sin(a.f), -std::cos(a.f)); }
inline Jet sqrt(const Jet& a) {
  const double s = std::sqrt(a.f);
  return a.chain(s, 1 / (2 * s), -1 / (4 * s * a.f));
}
inline Jet atan2(const Jet& y, const Jet& x) {
  const double r2 = x.f * x.f + y.f * y.f, r4 = r2 * r2;
  const double gx = -y.f / r2, gy = x.f / r2;
  const double gxx = 2 * x.f * y.f / r4, gyy = -gxx, gxy = (y.f * y.f - x.f * x.f) / r4;
  Jet r(std::atan2(y.f, x.f), gx * x.u + gy * y.u, gx * x.v + gy * y.v);
  r.uu = gxx * x.u * x.u + 2 * gxy * x.u * y.u + gyy * y.u * y.u + gx * x.uu + gy * y.uu;
  r.uv = gxx * x.u * x.v + gxy * (x.u * y.v + x.v * y.u) + gyy * y.u * y.v + gx * x.uv + gy * y.uv;
  r.vv = gxx * x.v * x.v + 2 * gxy * x.v * y.v + gyy * y.v * y.v + gx * x.vv + gy * y.vv;
  return r;
}

/// A number with derivatives to order one, for a third of the work; value and first derivatives are identical to Jet's.
struct Slope {
  double f = 0, u = 0, v = 0;

  Slope() = default;
  Slope(double value) : f(value) {}  // NOLINT(google-explicit-constructor): as Jet
  Slope(double value, double by_u, double by_v) : f(value), u(by_u), v(by_v) {}
};

inline Slope operator+(const Slope& a, const Slope& b) { return {a.f + b.f, a.u + b.u, a.v + b.v}; }
inline Slope operator-(const Slope& a) { return {-a.f, -a.u, -a.v}; }
inline Slope operator-(const Slope& a, const Slope& b) { return {a.f - b.f, a.u - b.u, a.v - b.v}; }
inline Slope operator*(const Slope& a, const Slope& b) {
  return {a.f * b.f, a.u * b.f + a.f * b.u, a.v * b.f + a.f * b.v};
}
inline Slope operator/(const Slope& a, const Slope& b) {
  const double g = 1 / b.f;
  return a * Slope(g, -g * g * b.u, -g * g * b.v);
}
inline Slope sin(const Slope& a) {
  const double c = std::cos(a.f);
  return {std::sin(a.f), c * a.u, c * a.v};
}
inline Slope cos(const Slope& a) {
  const double s = std::sin(a.f);
  return {std::cos(a.f), -s * a.u, -s * a.v};
}
inline Slope sqrt(const Slope& a) {
  const double s = std::sqrt(a.f), g = 1 / (2 * s);
  return {s, g * a.u, g * a.v};
}
inline Slope atan2(const Slope& y, const Slope& x) {
  const double r2 = x.f * x.f + y.f * y.f, gx = -y.f / r2, gy = x.f / r2;
  return {std::atan2(y.f, x.f), gx * x.u + gy * y.u, gx * x.v + gy * y.v};
}

/// The value, whatever the type of number.
inline double value_of(double a) { return a; }
inline double value_of(const Slope& a) { return a.f; }
inline double value_of(const Jet& a) { return a.f; }

/// A point whose coordinates are numbers of either type.
template <typename Number>
using Pair = std::array<Number, 2>;

/// u and v themselves.
template <typename Number = Jet>
Pair<Number> parameters_at(const Vec2& uv) {
  return {Number(uv.x(), 1, 0), Number(uv.y(), 0, 1)};
}
template <>
inline Pair<double> parameters_at<double>(const Vec2& uv) {
  return {uv.x(), uv.y()};
}
inline Pair<double> pair_of(const Vec2& p) { return {p.x(), p.y()}; }
inline Vec2 value_of(const Pair<double>& p) { return {p[0], p[1]}; }
inline Vec2 value_of(const Pair<Slope>& p) { return {p[0].f, p[1].f}; }
inline Vec2 value_of(const Pair<Jet>& p) { return {p[0].f, p[1].f}; }

}  // namespace carreau::atlas
