// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/discrete/gregory.h"

#include <algorithm>
#include <cmath>

#include "geometry/discrete/thresholds.h"

namespace carreau::discrete {

namespace {

/// A number with its derivatives by u and v, of second order where wanted.
template <bool second>
struct Jet {
  double f = 0, u = 0, v = 0, uu = 0, uv = 0, vv = 0;
};
template <>
struct Jet<false> {
  double f = 0, u = 0, v = 0;
};
template <bool second>
Jet<second> operator*(const Jet<second>& p, const Jet<second>& q) noexcept {
  Jet<second> r;
  r.f = p.f * q.f;
  r.u = p.u * q.f + p.f * q.u;
  r.v = p.v * q.f + p.f * q.v;
  if constexpr (second) {
    r.uu = p.uu * q.f + 2 * p.u * q.u + p.f * q.uu;
    r.uv = p.uv * q.f + p.u * q.v + p.v * q.u + p.f * q.uv;
    r.vv = p.vv * q.f + 2 * p.v * q.v + p.f * q.vv;
  }
  return r;
}
template <bool second>
Jet<second> operator*(double a, const Jet<second>& p) noexcept {
  if constexpr (second)
    return {a * p.f, a * p.u, a * p.v, a * p.uu, a * p.uv, a * p.vv};
  else
    return {a * p.f, a * p.u, a * p.v};
}
/// 1 - p.
template <bool second>
Jet<second> rest_of(const Jet<second>& p) noexcept {
  if constexpr (second)
    return {1 - p.f, -p.u, -p.v, -p.uu, -p.uv, -p.vv};
  else
    return {1 - p.f, -p.u, -p.v};
}

/// Adds a weight times a point.
template <bool second>
void add(SurfaceJet& jet, const Jet<second>& w, const Vec3& p) noexcept {
  jet.s += w.f * p;
  jet.su += w.u * p, jet.sv += w.v * p;
  if constexpr (second) jet.suu += w.uu * p, jet.suv += w.uv * p, jet.svv += w.vv * p;
}

/// x / (x + y), x and y not negative; their sum is the last one. Times x y it has two derivatives but in x = y = 0,
/// where those along x = y are taken.
template <bool second>
Jet<second> share_of(const Jet<second>& x, const Jet<second>& y) noexcept {
  double a = std::max(x.f, 0.0), b = std::max(y.f, 0.0);
  const double s = a + b;
  Jet<second> r;
  r.f = 0.5;
  if (!(s > thresholds::tiny)) return r;
  // g = a / s: g_a = b / s^2, g_b = -a / s^2, g_aa = -2 b / s^3, g_ab = (a - b) / s^3, g_bb = 2 a / s^3.
  const double s2 = s * s, ga = b / s2, gb = -a / s2;
  r.f = a / s;
  r.u = ga * x.u + gb * y.u;
  r.v = ga * x.v + gb * y.v;
  if constexpr (second) {
    const double s3 = s2 * s, gaa = -2 * b / s3, gab = (a - b) / s3, gbb = 2 * a / s3;
    r.uu = gaa * x.u * x.u + 2 * gab * x.u * y.u + gbb * y.u * y.u;
    r.uv = gaa * x.u * x.v + gab * (x.u * y.v + x.v * y.u) + gbb * y.u * y.v;
    r.vv = gaa * x.v * x.v + 2 * gab * x.v * y.v + gbb * y.v * y.v;
  }
  return r;
}

template <bool second>
SurfaceJet jet_of(const GregoryTriangle& patch, Vec2 uv) noexcept {
  std::array<Jet<second>, 3> b;
  b[0].f = 1 - uv.x() - uv.y(), b[0].u = b[0].v = -1;
  b[1].f = uv.x(), b[1].u = 1;
  b[2].f = uv.y(), b[2].v = 1;
  const std::array<Jet<second>, 3> b2{b[0] * b[0], b[1] * b[1], b[2] * b[2]};
  SurfaceJet jet{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const Jet<second> ij = b[i] * b[j];
    add(jet, b2[i] * b2[i], patch.border[4 * i]);
    add(jet, 4 * (b2[i] * ij), patch.border[4 * i + 1]);
    add(jet, 6 * (ij * ij), patch.border[4 * i + 2]);
    add(jet, 4 * (ij * b2[j]), patch.border[4 * i + 3]);
    // Beside corner i: of side i, which keeps its planes where b(k) is 0, and of side k, where b(j) is.
    const Jet<second> weight = 12 * (b2[i] * (b[j] * b[k])), share = share_of(b[j], b[k]);
    add(jet, weight * share, patch.inner[2 * i]);
    add(jet, weight * rest_of(share), patch.inner[2 * k + 1]);
  }
  return jet;
}

/// The ribbon of tangents along a side: D(t) = lambda(t) W(t) + mu(t) A(t) with W the derivative of the curve and A the
/// binormals, both quadratic, lambda and mu linear. Gives its middle coefficients from the outer ones.
std::array<Vec3, 2> ribbon(const Cubic& z, const Vec3& n_start, const Vec3& n_end, const Vec3& d0, const Vec3& d3) {
  const std::array<Vec3, 3> w{z[1] - z[0], z[2] - z[1], z[3] - z[2]};
  Vec3 a0 = cross(n_start, w[0]), a2 = cross(n_end, w[2]);
  a0 /= std::max(norm(a0), thresholds::tiny * norm(z[3] - z[0]) + 1e-300);
  a2 /= std::max(norm(a2), thresholds::tiny * norm(z[3] - z[0]) + 1e-300);
  Vec3 a1 = a0 + a2;
  const double length = norm(a1);
  a1 = length > thresholds::tiny ? Vec3(a1 / length) : a0;
  const double w0 = dot(w[0], w[0]), w2 = dot(w[2], w[2]);
  const double l0 = w0 > 0 ? dot(d0, w[0]) / w0 : 0, l1 = w2 > 0 ? dot(d3, w[2]) / w2 : 0;
  const double m0 = dot(d0, a0), m1 = dot(d3, a2);
  return {Vec3((l1 * w[0] + 2 * l0 * w[1] + m1 * a0 + 2 * m0 * a1) / 3),
          Vec3((2 * l1 * w[1] + l0 * w[2] + 2 * m1 * a1 + m0 * a2) / 3)};
}

}  // namespace

Vec3 point_of(const Cubic& z, double t) noexcept {
  const double s = 1 - t;
  return s * s * s * z[0] + 3 * s * s * t * z[1] + 3 * s * t * t * z[2] + t * t * t * z[3];
}

Vec3 derivative_of(const Cubic& z, double t) noexcept {
  const double s = 1 - t;
  return 3 * (s * s * (z[1] - z[0]) + 2 * s * t * (z[2] - z[1]) + t * t * (z[3] - z[2]));
}

GregoryTriangle gregory_triangle(const std::array<Cubic, 3>& sides, const std::array<Vec3, 6>& normals) noexcept {
  GregoryTriangle patch;
  for (std::size_t i = 0; i < 3; ++i) {
    const Cubic& z = sides[i];
    patch.border[4 * i] = z[0];
    patch.border[4 * i + 1] = (z[0] + 3 * z[1]) / 4;
    patch.border[4 * i + 2] = (z[1] + z[2]) / 2;
    patch.border[4 * i + 3] = (3 * z[2] + z[3]) / 4;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = 4 * ((i + 1) % 3), before = 4 * ((i + 2) % 3);
    const Vec3* const p = &patch.border[4 * i];
    const Vec3& end = patch.border[next];
    // Derivatives towards the opposite corner: a quarter of that at both ends.
    const Vec3 d0 = patch.border[before + 3] - 0.5 * (p[0] + p[1]), d3 = patch.border[next + 1] - 0.5 * (p[3] + end);
    const auto [d1, d2] = ribbon(sides[i], normals[2 * i], normals[2 * i + 1], d0, d3);
    patch.inner[2 * i] = 0.5 * (p[1] + p[2]) + d1;
    patch.inner[2 * i + 1] = 0.5 * (p[2] + p[3]) + d2;
  }
  return patch;
}

SurfaceJet GregoryTriangle::at(Vec2 uv, unsigned want) const noexcept {
  return (want & want_second) != 0 ? jet_of<true>(*this, uv) : jet_of<false>(*this, uv);
}

double GregoryTriangle::deviation() const noexcept {
  const std::array<const Vec3*, 3> c{&border[0], &border[4], &border[8]};
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    for (std::size_t n = 1; n < 4; ++n) {
      const double s = static_cast<double>(n) / 4;
      most = std::max(most, norm(border[4 * i + n] - ((1 - s) * *c[i] + s * *c[j])));
    }
    const Vec3 flat = 0.5 * *c[i] + 0.25 * *c[j] + 0.25 * *c[k];
    most = std::max({most, norm(inner[2 * i] - flat), norm(inner[2 * k + 1] - flat)});
  }
  return most;
}

}  // namespace carreau::discrete
