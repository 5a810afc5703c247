// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/discrete/gregory.h"

#include <algorithm>
#include <cmath>

#include "geometry/discrete/thresholds.h"

namespace carreau::discrete {

namespace {

/// A number with its derivatives by u and v.
struct Jet {
  double f = 0, u = 0, v = 0, uu = 0, uv = 0, vv = 0;
};
Jet operator*(const Jet& p, const Jet& q) noexcept {
  return {p.f * q.f,
          p.u * q.f + p.f * q.u,
          p.v * q.f + p.f * q.v,
          p.uu * q.f + 2 * p.u * q.u + p.f * q.uu,
          p.uv * q.f + p.u * q.v + p.v * q.u + p.f * q.uv,
          p.vv * q.f + 2 * p.v * q.v + p.f * q.vv};
}
Jet operator*(double a, const Jet& p) noexcept { return {a * p.f, a * p.u, a * p.v, a * p.uu, a * p.uv, a * p.vv}; }

/// Adds a weight times a point.
void add(SurfaceJet& jet, const Jet& w, const Vec3& p) noexcept {
  jet.s += w.f * p;
  jet.su += w.u * p, jet.sv += w.v * p;
  jet.suu += w.uu * p, jet.suv += w.uv * p, jet.svv += w.vv * p;
}

/// x / (x + y), x and y not negative; their sum is the last one. Times x y it has two derivatives but in x = y = 0,
/// where those along x = y are taken.
Jet share_of(const Jet& x, const Jet& y) noexcept {
  double a = std::max(x.f, 0.0), b = std::max(y.f, 0.0);
  const double s = a + b;
  if (!(s > thresholds::tiny)) return {0.5, 0, 0, 0, 0, 0};
  // g = a / s: g_a = b / s^2, g_b = -a / s^2, g_aa = -2 b / s^3, g_ab = (a - b) / s^3, g_bb = 2 a / s^3.
  const double s2 = s * s, s3 = s2 * s, ga = b / s2, gb = -a / s2, gaa = -2 * b / s3, gab = (a - b) / s3,
               gbb = 2 * a / s3;
  return {a / s,
          ga * x.u + gb * y.u,
          ga * x.v + gb * y.v,
          gaa * x.u * x.u + 2 * gab * x.u * y.u + gbb * y.u * y.u,
          gaa * x.u * x.v + gab * (x.u * y.v + x.v * y.u) + gbb * y.u * y.v,
          gaa * x.v * x.v + 2 * gab * x.v * y.v + gbb * y.v * y.v};
}

/// Position and first derivatives, which is what most callers want: those by barycentric coordinates as if these were independent, of which
/// the position is the sum (Euler, degree 4).
SurfaceJet first_jet(const GregoryTriangle& patch, Vec2 uv) noexcept {
  const std::array<double, 3> b{1 - uv.x() - uv.y(), uv.x(), uv.y()};
  std::array<Vec3, 3> g{Vec3{0, 0, 0}, Vec3{0, 0, 0}, Vec3{0, 0, 0}};
  const double all = b[0] * b[1] * b[2];
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const Vec3* const p = &patch.border[4 * i];
    const double ii = b[i] * b[i], jj = b[j] * b[j], iij = 3 * ii * b[j], ijj = 3 * b[i] * jj, iii = ii * b[i];
    // Beside corner i: of side i, which keeps its planes where b(k) is 0, and of side k, where b(j) is.
    const double x = std::max(b[j], 0.0), y = std::max(b[k], 0.0), s = x + y;
    const bool apart = s > thresholds::tiny;
    const double share = apart ? x / s : 0.5, change = apart ? 3 * ii * b[j] * b[k] / (s * s) : 0;
    const Vec3 difference = patch.inner[2 * i] - patch.inner[2 * k + 1];
    const Vec3 inner = patch.inner[2 * k + 1] + share * difference;
    g[i] += iii * p[0] + iij * p[1] + ijj * p[2] + (jj * b[j]) * p[3] + (6 * all) * inner;
    g[j] += iii * p[1] + iij * p[2] + ijj * p[3] + (3 * ii * b[k]) * inner + (change * y) * difference;
    g[k] += iij * inner - (change * x) * difference;
  }
  SurfaceJet jet{};
  jet.s = b[0] * g[0] + b[1] * g[1] + b[2] * g[2];
  jet.su = 4 * (g[1] - g[0]);
  jet.sv = 4 * (g[2] - g[0]);
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
  if ((want & want_second) == 0) return first_jet(*this, uv);
  const std::array<Jet, 3> b{Jet{1 - uv.x() - uv.y(), -1, -1}, Jet{uv.x(), 1, 0}, Jet{uv.y(), 0, 1}};
  const std::array<Jet, 3> b2{b[0] * b[0], b[1] * b[1], b[2] * b[2]};
  SurfaceJet jet{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const Jet ij = b[i] * b[j];
    add(jet, b2[i] * b2[i], border[4 * i]);
    add(jet, 4 * (b2[i] * ij), border[4 * i + 1]);
    add(jet, 6 * (ij * ij), border[4 * i + 2]);
    add(jet, 4 * (ij * b2[j]), border[4 * i + 3]);
    // Beside corner i: of side i, which keeps its planes where b(k) is 0, and of side k, where b(j) is.
    const Jet weight = 12 * (b2[i] * (b[j] * b[k])), share = share_of(b[j], b[k]);
    const Jet rest{1 - share.f, -share.u, -share.v, -share.uu, -share.uv, -share.vv};
    add(jet, weight * share, inner[2 * i]);
    add(jet, weight * rest, inner[2 * k + 1]);
  }
  return jet;
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
