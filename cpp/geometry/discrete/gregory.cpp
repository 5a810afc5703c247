// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/discrete/gregory.h"

#include <algorithm>
#include <cmath>

#include "geometry/discrete/thresholds.h"
#include "support/rounding_of.h"

namespace carreau::discrete {

namespace {

/// A number with its derivatives by u and v.
struct Jet {
  double f = 0, u = 0, v = 0, uu = 0, uv = 0, vv = 0;
};
Jet operator*(const Jet& p, const Jet& q) noexcept {
  Jet r;
  r.f = p.f * q.f;
  r.u = p.u * q.f + p.f * q.u;
  r.v = p.v * q.f + p.f * q.v;
  r.uu = p.uu * q.f + 2 * p.u * q.u + p.f * q.uu;
  r.uv = p.uv * q.f + p.u * q.v + p.v * q.u + p.f * q.uv;
  r.vv = p.vv * q.f + 2 * p.v * q.v + p.f * q.vv;
  return r;
}
Jet operator*(double a, const Jet& p) noexcept { return {a * p.f, a * p.u, a * p.v, a * p.uu, a * p.uv, a * p.vv}; }
/// 1 - p.
Jet rest_of(const Jet& p) noexcept { return {1 - p.f, -p.u, -p.v, -p.uu, -p.uv, -p.vv}; }

/// Adds a weight times a point.
void add(SurfaceJet& jet, const Jet& w, const Vec3& p) noexcept {
  jet.s += w.f * p;
  jet.su += w.u * p, jet.sv += w.v * p;
  jet.suu += w.uu * p, jet.suv += w.uv * p, jet.svv += w.vv * p;
}

/// x / (x + y), x and y not negative; their sum is the last one. Times x y it has two derivatives except in x = y = 0,
/// where the derivatives along x = y are taken.
Jet share_of(const Jet& x, const Jet& y) noexcept {
  double a = std::max(x.f, 0.0), b = std::max(y.f, 0.0);
  const double s = a + b;
  Jet r;
  r.f = 0.5;
  if (!(s > rounding_of::heights)) return r;
  // g = a / s has the derivatives g_a = b / s^2, g_b = -a / s^2, g_aa = -2 b / s^3, g_ab = (a - b) / s^3, g_bb = 2 a /
  // s^3.
  const double s2 = s * s, ga = b / s2, gb = -a / s2;
  r.f = a / s;
  r.u = ga * x.u + gb * y.u;
  r.v = ga * x.v + gb * y.v;
  const double s3 = s2 * s, gaa = -2 * b / s3, gab = (a - b) / s3, gbb = 2 * a / s3;
  r.uu = gaa * x.u * x.u + 2 * gab * x.u * y.u + gbb * y.u * y.u;
  r.uv = gaa * x.u * x.v + gab * (x.u * y.v + x.v * y.u) + gbb * y.u * y.v;
  r.vv = gaa * x.v * x.v + 2 * gab * x.v * y.v + gbb * y.v * y.v;
  return r;
}

SurfaceJet second_jet_of(const GregoryTriangle& patch, Vec2 uv) noexcept {
  std::array<Jet, 3> b;
  b[0].f = 1 - uv.x() - uv.y(), b[0].u = b[0].v = -1;
  b[1].f = uv.x(), b[1].u = 1;
  b[2].f = uv.y(), b[2].v = 1;
  const std::array<Jet, 3> b2{b[0] * b[0], b[1] * b[1], b[2] * b[2]};
  SurfaceJet jet{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const Jet ij = b[i] * b[j];
    add(jet, b2[i] * b2[i], patch.border[4 * i]);
    add(jet, 4 * (b2[i] * ij), patch.border[4 * i + 1]);
    add(jet, 6 * (ij * ij), patch.border[4 * i + 2]);
    add(jet, 4 * (ij * b2[j]), patch.border[4 * i + 3]);
    // Weights beside corner i: for side i, which keeps its planes where b(k) is 0, and for side k, where b(j) is 0.
    const Jet weight = 12 * (b2[i] * (b[j] * b[k])), share = share_of(b[j], b[k]);
    add(jet, weight * share, patch.inner[2 * i]);
    add(jet, weight * rest_of(share), patch.inner[2 * k + 1]);
  }
  return jet;
}

/// Control points of a Bezier triangle of degree n, row by row: i falls from n, then j, of B(ijk).
template <std::size_t n>
using Net = std::array<Vec3, (n + 1) * (n + 2) / 2>;

/// De Casteljau's step: the net of degree n - 1 at weights b.
template <std::size_t n>
Net<n - 1> step_of(const Net<n>& net, const std::array<double, 3>& b) noexcept {
  Net<n - 1> next;
  for (std::size_t row = 0, at = 0; row < n; ++row)
    for (std::size_t k = 0; k <= row; ++k, ++at) {
      const std::size_t below = at + row + 1;  // of the same rank in the next row
      next[at] = b[0] * net[at] + b[1] * net[below] + b[2] * net[below + 1];
    }
  return next;
}

/// -1: not a corner.
int corner_at(Vec2 uv) noexcept {
  if (uv.x() == 0 && uv.y() == 0) return 0;
  if (uv.x() == 1 && uv.y() == 0) return 1;
  return uv.x() == 0 && uv.y() == 1 ? 2 : -1;
}

/// Borders determine both derivatives there.
SurfaceJet first_jet_at(const GregoryTriangle& patch, std::size_t corner) noexcept {
  const auto& p = patch.border;
  constexpr std::size_t last[3] = {0, 3, 9}, along_u[3] = {1, 4, 7}, along_v[3] = {11, 5, 8};  // of de Casteljau's last net
  SurfaceJet jet{};
  jet.s = p[4 * corner];
  jet.su = 4 * (p[along_u[corner]] - p[last[corner]]);
  jet.sv = 4 * (p[along_v[corner]] - p[last[corner]]);
  return jet;
}

/// Place and first derivatives: the jet of the Bezier triangle with the inner points of this place, and the derivatives
/// of these points.
SurfaceJet first_jet_of(const GregoryTriangle& patch, Vec2 uv) noexcept {
  if (const int corner = corner_at(uv); corner >= 0) return first_jet_at(patch, static_cast<std::size_t>(corner));
  const std::array<double, 3> b{1 - uv.x() - uv.y(), uv.x(), uv.y()};
  constexpr std::array<double, 3> b_u{-1, 1, 0}, b_v{-1, 0, 1};
  std::array<Vec3, 3> inside;
  SurfaceJet jet{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const Vec3 apart = patch.inner[2 * i] - patch.inner[2 * k + 1];
    const double x = std::max(b[j], 0.0), y = std::max(b[k], 0.0), sum = x + y;
    if (!(sum > rounding_of::heights)) {
      inside[i] = patch.inner[2 * k + 1] + 0.5 * apart;
      continue;
    }
    inside[i] = patch.inner[2 * k + 1] + (x / sum) * apart;
    const double weight = 12 * b[i] * b[i] * b[j] * b[k] / (sum * sum);
    jet.su += (weight * (y * b_u[j] - x * b_u[k])) * apart;
    jet.sv += (weight * (y * b_v[j] - x * b_v[k])) * apart;
  }
  const auto& p = patch.border;
  const Net<4> net{p[0], p[1], p[11], p[2], inside[0], p[10], p[3], inside[1], inside[2], p[9], p[4], p[5], p[6], p[7], p[8]};
  const Net<1> plane = step_of<2>(step_of<3>(step_of<4>(net, b), b), b);
  jet.s = b[0] * plane[0] + b[1] * plane[1] + b[2] * plane[2];
  jet.su += 4 * (plane[1] - plane[0]);
  jet.sv += 4 * (plane[2] - plane[0]);
  return jet;
}

/// The ribbon of tangents along a side: D(t) = lambda(t) W(t) + mu(t) A(t) with W the derivative of the curve and A the
/// binormals, both quadratic, lambda and mu linear. Gives its middle coefficients from the outer ones.
std::array<Vec3, 2> ribbon(const Cubic& z, const Vec3& n_start, const Vec3& n_end, const Vec3& d0, const Vec3& d3) {
  const std::array<Vec3, 3> w{z[1] - z[0], z[2] - z[1], z[3] - z[2]};
  Vec3 a0 = cross(n_start, w[0]), a2 = cross(n_end, w[2]);
  a0 /= std::max(norm(a0), rounding_of::heights * norm(z[3] - z[0]) + 1e-300);
  a2 /= std::max(norm(a2), rounding_of::heights * norm(z[3] - z[0]) + 1e-300);
  Vec3 a1 = a0 + a2;
  const double length = norm(a1);
  a1 = length > rounding_of::heights ? Vec3(a1 / length) : a0;
  const double w0 = dot(w[0], w[0]), w2 = dot(w[2], w[2]);
  const double l0 = w0 > 0 ? dot(d0, w[0]) / w0 : 0, l1 = w2 > 0 ? dot(d3, w[2]) / w2 : 0;
  const double m0 = dot(d0, a0), m1 = dot(d3, a2);
  return {Vec3((l1 * w[0] + 2 * l0 * w[1] + m1 * a0 + 2 * m0 * a1) / 3),
          Vec3((2 * l1 * w[1] + l0 * w[2] + 2 * m1 * a1 + m0 * a2) / 3)};
}

/// How far a border leaves its chord at its inner points.
double bulge(const Vec3* border, const Vec3& end) noexcept {
  double most = 0;
  for (std::size_t n = 1; n < 4; ++n)
    most = std::max(most, norm(border[n] - lerp(border[0], end, static_cast<double>(n) / 4)));
  return most;
}

// Ribbons of needles grow with the ratio of the sides. Beyond the shares of the largest bulge that triangles of usual
// shape need they fold the patch, which may lie in one plane.
void keep_near(GregoryTriangle& patch) noexcept {
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i) most = std::max(most, bulge(&patch.border[4 * i], patch.border[4 * ((i + 1) % 3)]));
  most *= thresholds::max_inner_bulge;
  const Vec3 &a = patch.border[0], &b = patch.border[4], &c = patch.border[8];
  const Vec3 normal = cross(b - a, c - a);
  const double area2 = norm(normal), longest = std::max({norm(b - a), norm(c - b), norm(a - c)});
  const double max_in_plane = area2 > 0 ? thresholds::max_inner_shift * area2 / longest : most;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const Vec3 flat = 0.5 * patch.border[4 * i] + 0.25 * patch.border[4 * j] + 0.25 * patch.border[4 * k];
    for (Vec3* const point : {&patch.inner[2 * i], &patch.inner[2 * k + 1]}) {
      Vec3 off = *point - flat;
      if (const double far = norm(off); far > most) off *= most / far, *point = flat + off;
      if (!(area2 > 0)) continue;
      const Vec3 up = dot(off, normal) / (area2 * area2) * normal, in_plane = off - up;
      if (const double far = norm(in_plane); far > max_in_plane) *point = flat + up + (max_in_plane / far) * in_plane;
    }
  }
}

}  // namespace

Vec3 point_of(const Cubic& z, double t) noexcept {
  const double s = 1 - t;
  return s * s * s * z[0] + 3 * s * s * t * z[1] + 3 * s * t * t * z[2] + t * t * t * z[3];
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
  keep_near(patch);
  return patch;
}

SurfaceJet GregoryTriangle::at(Vec2 uv, unsigned want) const noexcept {
  return (want & want_second) != 0 ? second_jet_of(*this, uv) : first_jet_of(*this, uv);
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
