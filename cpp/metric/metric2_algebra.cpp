// SPDX-License-Identifier: BSD-3-Clause
#include "metric/metric2_algebra.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carreau {

namespace {

// Upper triangular U with U^T U = M.
struct Factor {
  double p, q, r;
};

Factor factor(Metric2 m) noexcept {
  const double p = std::sqrt(m.a);
  return {p, m.b / p, std::sqrt(std::max(accurate_determinant(m), 0.0)) / p};
}

// U^T N U
Metric2 transformed(Metric2 n, const Factor& u) noexcept {
  const double x = n.a * u.q + n.b * u.r, y = n.b * u.q + n.c * u.r;
  return {u.p * u.p * n.a, u.p * x, u.q * x + u.r * y};
}

// U^-T M U^-1
Metric2 transformed_back(Metric2 m, const Factor& u) noexcept {
  const double a = m.a / (u.p * u.p);
  const double b = (m.b / u.p - a * u.q) / u.r;
  const double c = (m.c - u.q * (2 * u.r * b + u.q * a)) / (u.r * u.r);
  return {a, b, c};
}

// Simultaneous reduction (RR-2818 sec. 4.3.2): in the basis P = U^-1 R, p becomes the identity and q becomes
// diag(axes.major, axes.minor).
struct Reduction {
  Factor u;
  Eigen2 axes;
};

// The major eigenvalue of the transformed tensor is accurate, and the product of both is det q / det p.
Reduction reduce(Metric2 p, Metric2 q) noexcept {
  Reduction r{factor(p), {}};
  r.axes = eigen(transformed_back(q, r.u));
  r.axes.minor = accurate_determinant(q) / accurate_determinant(p) / r.axes.major;
  if (r.axes.minor > r.axes.major) r.axes.minor = r.axes.major;
  return r;
}

// The reduction starts from the better conditioned of the two, so that it does not depend on the order of the
// arguments.
bool better_conditioned(Metric2 p, Metric2 q) noexcept {
  const double tp = p.a + p.c, tq = q.a + q.c;
  const double left = accurate_determinant(p) * tq * tq, right = accurate_determinant(q) * tp * tp;
  if (left != right) return left > right;
  if (tp != tq) return tp < tq;
  return p.a != q.a ? p.a < q.a : p.b <= q.b;
}

}  // namespace

double accurate_determinant(Metric2 m) noexcept {
  // Kahan: the error of b b is found exactly and taken back.
  const double bb = m.b * m.b;
  const double rest = std::fma(-m.b, m.b, bb);
  return std::fma(m.a, m.c, -bb) + rest;
}

Eigen2 eigen(Metric2 m) noexcept {
  const double half = 0.5 * (m.a - m.c), mean = 0.5 * (m.a + m.c);
  const double radius = std::hypot(half, m.b);
  const double angle = 0.5 * std::atan2(m.b, half);
  Eigen2 e{mean + radius, mean - radius, {std::cos(angle), std::sin(angle)}};
  // The difference of mean and radius has lost all its digits when the tensor is nearly singular.
  if (mean > 0) e.minor = accurate_determinant(m) / e.major;
  if (mean < 0) e.major = accurate_determinant(m) / e.minor;
  return e;
}

Metric2 compose(const Eigen2& e) noexcept {
  const Vec2 d = e.direction;
  return {e.major * d.x() * d.x() + e.minor * d.y() * d.y(), (e.major - e.minor) * d.x() * d.y(),
          e.major * d.y() * d.y() + e.minor * d.x() * d.x()};
}

Metric2 clamp_eigenvalues(Metric2 m, double low, double high) noexcept {
  // det(M - low I) and det(high I - M) show at once if the metric is within the bounds.
  if (m.a > low && m.c > low && (m.a - low) * (m.c - low) > m.b * m.b && m.a < high && m.c < high &&
      (high - m.a) * (high - m.c) > m.b * m.b)
    return m;
  Eigen2 e = eigen(m);
  if (e.minor >= low && e.major <= high) return m;
  e.major = std::clamp(e.major, low, high);
  e.minor = std::clamp(e.minor, low, high);
  return compose(e);
}

Metric2 square_root(Metric2 m) noexcept {
  // Cayley-Hamilton: S^2 - tr(S) S + det(S) I = 0.
  const double s = std::sqrt(std::max(accurate_determinant(m), 0.0));
  const double trace = std::sqrt(m.a + m.c + 2 * s);
  if (!(trace > 0)) return {0, 0, 0};
  return {(m.a + s) / trace, m.b / trace, (m.c + s) / trace};
}

LengthRatios length_ratios(Metric2 m, Metric2 reference) noexcept {
  const Metric2 n = transformed_back(m, factor(reference));
  const double half = 0.5 * (n.a - n.c), mean = 0.5 * (n.a + n.c), radius = std::sqrt(half * half + n.b * n.b);
  const double major = mean + radius;
  // For similar metrics the difference is as accurate, and cheap.
  const double minor =
      2 * radius < mean ? mean - radius : accurate_determinant(m) / accurate_determinant(reference) / major;
  return {std::sqrt(std::max(minor, 0.0)), std::sqrt(major)};
}

double length_error(Metric2 m, Metric2 reference) noexcept {
  const LengthRatios r = length_ratios(m, reference);
  return std::max(r.largest - 1, 1 - r.smallest);
}

double size_between(double h, double t, MetricLaw law) noexcept {
  switch (law) {
    case MetricLaw::geometric:
      return std::pow(h, t);
    case MetricLaw::sinusoidal:
      return 0.5 * ((1 + h) + (1 - h) * std::cos(std::numbers::pi * t));
    default:
      return 1 + t * (h - 1);
  }
}

Metric2 interpolate(Metric2 p, Metric2 q, double t, MetricLaw law) noexcept {
  if (t <= 0) return p;
  if (t >= 1) return q;
  if (!better_conditioned(p, q)) return interpolate(q, p, 1 - t, law);
  Reduction r = reduce(p, q);
  const double h1 = size_between(1 / std::sqrt(r.axes.major), t, law);
  const double h2 = size_between(1 / std::sqrt(r.axes.minor), t, law);
  r.axes.major = 1 / (h1 * h1);
  r.axes.minor = 1 / (h2 * h2);
  return transformed(compose(r.axes), r.u);
}

Metric2 intersection(Metric2 p, Metric2 q) noexcept {
  if (!better_conditioned(p, q)) std::swap(p, q);
  Reduction r = reduce(p, q);
  if (r.axes.minor >= 1) return q;
  if (r.axes.major <= 1) return p;
  r.axes.minor = 1;
  return transformed(compose(r.axes), r.u);
}

}  // namespace carreau
