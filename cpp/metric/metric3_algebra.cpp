// SPDX-License-Identifier: BSD-3-Clause
#include "metric/metric3_algebra.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "metric/thresholds.h"

namespace carreau {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr int max_sweeps = 40;

/// Lower triangular L, L L^T = M; not sound when M is not positive definite in double precision.
struct Factor3 {
  double xx = 1, xy = 0, yy = 1, xz = 0, yz = 0, zz = 1;
  bool sound = true;
};

Factor3 factor(const Metric3& m) noexcept {
  Factor3 l;
  l.xx = std::sqrt(m.xx);
  l.xy = m.xy / l.xx;
  l.xz = m.xz / l.xx;
  l.yy = std::sqrt(std::fma(-l.xy, l.xy, m.yy));
  l.yz = std::fma(-l.xz, l.xy, m.yz) / l.yy;
  l.zz = std::sqrt(std::fma(-l.yz, l.yz, std::fma(-l.xz, l.xz, m.zz)));
  l.sound = l.xx > 0 && l.yy > 0 && l.zz > 0;
  return l;
}

using Columns = std::array<Vec3, 3>;

/// One-sided Jacobi (Hestenes): rotates the columns until they are orthogonal, longest first. The result is U S of A =
/// U S V^T, each singular value with a small relative error.
void orthogonalise(Columns& a) noexcept {
  for (int sweep = 0; sweep < max_sweeps; ++sweep) {
    bool turned = false;
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = i + 1; j < 3; ++j) {
        const double ii = dot(a[i], a[i]), jj = dot(a[j], a[j]), ij = dot(a[i], a[j]);
        if (!(std::abs(ij) > 2 * epsilon * std::sqrt(ii) * std::sqrt(jj))) continue;
        turned = true;
        const double zeta = (jj - ii) / (2 * ij);
        const double t = std::copysign(1.0, zeta) / (std::abs(zeta) + std::hypot(1.0, zeta));
        const double c = 1 / std::hypot(1.0, t), s = c * t;
        const Vec3 ai = a[i], aj = a[j];
        a[i] = c * ai - s * aj;
        a[j] = s * ai + c * aj;
      }
    if (!turned) break;
  }
  std::stable_sort(a.begin(), a.end(), [](Vec3 p, Vec3 q) { return dot(p, p) > dot(q, q); });
}

/// Magnitude of the largest entry.
double magnitude(const Metric3& m) noexcept {
  return std::max({std::abs(m.xx), std::abs(m.yy), std::abs(m.zz), std::abs(m.xy), std::abs(m.xz), std::abs(m.yz)});
}

double determinant_of(const Metric3& m) noexcept {
  const Factor3 l = factor(m);
  const double root = l.xx * l.yy * l.zz;
  return root * root;
}

/// An order of tensors that rotations leave alone: smallest balls first.
bool before(const Metric3& p, const Metric3& q) noexcept {
  const double dp = determinant_of(p), dq = determinant_of(q);
  if (dp != dq) return dp > dq;
  const double tp = p.xx + p.yy + p.zz, tq = q.xx + q.yy + q.zz;
  if (tp != tq) return tp > tq;
  return std::array{p.xx, p.xy, p.xz, p.yy, p.yz, p.zz} < std::array{q.xx, q.xy, q.xz, q.yy, q.yz, q.zz};
}

bool before(Metric2 p, Metric2 q) noexcept {
  const double dp = accurate_determinant(p), dq = accurate_determinant(q);
  if (dp != dq) return dp > dq;
  if (p.a + p.c != q.a + q.c) return p.a + p.c > q.a + q.c;
  return std::array{p.a, p.b, p.c} < std::array{q.a, q.b, q.c};
}

template <typename Metric>
Metric intersection_of_many(std::span<const Metric> metrics) {
  if (metrics.size() == 1) return metrics[0];
  std::vector<Metric> sorted(metrics.begin(), metrics.end());
  std::sort(sorted.begin(), sorted.end(), [](const Metric& p, const Metric& q) { return before(p, q); });
  Metric result = sorted.front();
  for (std::size_t i = 1; i < sorted.size(); ++i) result = intersection(result, sorted[i]);
  return result;
}

Metric3 scaled(double s, const Metric3& m) noexcept {
  return {s * m.xx, s * m.xy, s * m.xz, s * m.yy, s * m.yz, s * m.zz};
}

}  // namespace

Eigen3 eigen(const Metric3& m) noexcept {
  const double scale = magnitude(m);
  Eigen3 e;
  if (!(scale > 0)) {
    e.value = {0, 0, 0};
    return e;
  }
  // Scaled to unit size. A tensor that has no triangular factor is shifted, which costs the relative accuracy of small
  // values.
  Metric3 unit = scaled(1 / scale, m);
  double shift = 0;
  Factor3 l = factor(unit);
  if (!l.sound) {
    shift = 4;
    unit.xx += shift, unit.yy += shift, unit.zz += shift;
    l = factor(unit);
  }
  Columns a{{{l.xx, l.xy, l.xz}, {0, l.yy, l.yz}, {0, 0, l.zz}}};
  orthogonalise(a);
  for (std::size_t i = 0; i < 3; ++i) {
    const double square = dot(a[i], a[i]);
    e.value[i] = scale * (square - shift);
    e.axis[i] = (1 / std::sqrt(square)) * a[i];
  }
  return e;
}

Metric3 compose(const Eigen3& e) noexcept {
  Metric3 m{0, 0, 0, 0, 0, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 d = e.axis[i], k = e.value[i] * d;
    m.xx += k.x() * d.x(), m.xy += k.x() * d.y(), m.xz += k.x() * d.z();
    m.yy += k.y() * d.y(), m.yz += k.y() * d.z(), m.zz += k.z() * d.z();
  }
  return m;
}

bool is_positive_definite(const Metric3& m) noexcept {
  const double scale = magnitude(m);
  if (!std::isfinite(scale) || !(scale > 0) || !factor(scaled(1 / scale, m)).sound) return false;
  const Eigen3 e = eigen(m);
  return e.value[2] > 4 * epsilon * e.value[0];
}

bool is_positive_definite(Metric2 m) noexcept {
  if (!std::isfinite(m.a) || !std::isfinite(m.b) || !std::isfinite(m.c) || !(m.a > 0) || !(m.c > 0)) return false;
  // Units of u and v may differ.
  const double b = m.b / std::sqrt(m.a) / std::sqrt(m.c);
  return 1 - std::abs(b) > 4 * epsilon;
}

Metric3 clamp_eigenvalues(const Metric3& m, double low, double high) noexcept {
  Eigen3 e = eigen(m);
  if (e.value[2] >= low && e.value[0] <= high) return m;
  for (double& value : e.value) value = std::clamp(value, low, high);
  return compose(e);
}

Metric3 square_root(const Metric3& m) noexcept {
  Eigen3 e = eigen(m);
  for (double& value : e.value) value = std::sqrt(std::max(value, 0.0));
  return compose(e);
}

Reduction3 reduce(const Metric3& p, const Metric3& q) noexcept {
  const Factor3 l = factor(p), k = factor(q);
  // A = L^-1 K, both lower triangular; q = L A A^T L^T.
  Columns a{};
  a[0].x() = k.xx / l.xx;
  a[0].y() = std::fma(-l.xy, a[0].x(), k.xy) / l.yy;
  a[0].z() = std::fma(-l.yz, a[0].y(), std::fma(-l.xz, a[0].x(), k.xz)) / l.zz;
  a[1].y() = k.yy / l.yy;
  a[1].z() = std::fma(-l.yz, a[1].y(), k.yz) / l.zz;
  a[2].z() = k.zz / l.zz;
  orthogonalise(a);
  Reduction3 r;
  for (std::size_t i = 0; i < 3; ++i) {
    r.ratio[i] = dot(a[i], a[i]);
    const Vec3 u = (1 / std::sqrt(r.ratio[i])) * a[i];
    r.axis[i] = {l.xx * u.x(), l.xy * u.x() + l.yy * u.y(), l.xz * u.x() + l.yz * u.y() + l.zz * u.z()};
  }
  return r;
}

LengthRatios length_ratios(const Metric3& m, const Metric3& reference) noexcept {
  const Reduction3 r = reduce(reference, m);
  return {std::sqrt(r.ratio[2]), std::sqrt(r.ratio[0])};
}

Metric3 interpolate(const Metric3& p, const Metric3& q, double t, MetricLaw law) noexcept {
  if (t <= 0) return p;
  if (t >= 1) return q;
  if (before(q, p)) return interpolate(q, p, 1 - t, law);
  const Reduction3 r = reduce(p, q);
  Eigen3 e{{}, r.axis};
  for (std::size_t i = 0; i < 3; ++i) {
    const double h = size_between(1 / std::sqrt(r.ratio[i]), t, law);
    e.value[i] = 1 / (h * h);
  }
  return compose(e);
}

Metric3 intersection(const Metric3& p, const Metric3& q) noexcept {
  if (before(q, p)) return intersection(q, p);
  const Reduction3 r = reduce(p, q);
  if (r.ratio[2] >= 1) return q;
  if (r.ratio[0] <= 1) return p;
  Eigen3 e{{}, r.axis};
  for (std::size_t i = 0; i < 3; ++i) e.value[i] = std::max(1.0, r.ratio[i]);
  return compose(e);
}

Metric3 intersection(std::span<const Metric3> metrics) { return intersection_of_many(metrics); }
Metric2 intersection(std::span<const Metric2> metrics) { return intersection_of_many(metrics); }

Metric3 combine(const Metric3& prescribed, const Metric3& bound, MetricCombination how) noexcept {
  if (how == MetricCombination::intersection) return intersection(prescribed, bound);
  return scaled(std::max(1.0, reduce(prescribed, bound).ratio[0]), prescribed);
}

Metric2 combine(Metric2 prescribed, Metric2 bound, MetricCombination how) noexcept {
  if (how == MetricCombination::intersection) return intersection(prescribed, bound);
  const double largest = length_ratios(bound, prescribed).largest;
  return std::max(1.0, largest * largest) * prescribed;
}

Metric3 metric_of_sizes(const Vec3& direction, double h1, double h2) noexcept {
  const Vec3 d = (1 / norm(direction)) * direction;
  // k1 d d^T + k2 (I - d d^T), each eigenvalue from terms of one sign.
  const double k1 = 1 / (h1 * h1), k2 = 1 / (h2 * h2);
  return {k1 * d.x() * d.x() + k2 * (d.y() * d.y() + d.z() * d.z()),
          (k1 - k2) * d.x() * d.y(),
          (k1 - k2) * d.x() * d.z(),
          k1 * d.y() * d.y() + k2 * (d.x() * d.x() + d.z() * d.z()),
          (k1 - k2) * d.y() * d.z(),
          k1 * d.z() * d.z() + k2 * (d.x() * d.x() + d.y() * d.y())};
}

std::optional<TangentFrame> TangentFrame::of(const Vec3& su, const Vec3& sv) noexcept {
  using namespace thresholds::degenerate;
  const double e = dot(su, su), g = dot(sv, sv);
  const Vec3 n = cross(su, sv);
  const double det = dot(n, n);
  if (!(e > collapsed * g) || !(g > collapsed * e) || !(det > parallel * e * g) || !std::isfinite(det)) return {};
  TangentFrame f;
  f.p = std::sqrt(e);
  f.e1 = (1 / f.p) * su;
  f.e2 = cross((1 / std::sqrt(det)) * n, f.e1);
  f.q = dot(f.e1, sv);
  f.r = std::sqrt(det) / f.p;
  return f;
}

Metric2 TangentFrame::restricted(const Metric3& m) const noexcept { return induced_metric(e1, e2, m); }

Metric2 TangentFrame::induced(Metric2 t) const noexcept {
  const double x = t.a * q + t.b * r, y = t.b * q + t.c * r;
  return {p * p * t.a, p * x, q * x + r * y};
}

Metric2 TangentFrame::of_parameters(Metric2 m) const noexcept {
  const double a = m.a / (p * p);
  const double b = (m.b / p - a * q) / r;
  return {a, b, (m.c - q * (2 * r * b + q * a)) / (r * r)};
}

Metric3 TangentFrame::in_space(Metric2 t, double across) const noexcept {
  const Eigen2 e = eigen(t);
  const Vec3 d = e.direction.x() * e1 + e.direction.y() * e2, n = e.direction.x() * e2 - e.direction.y() * e1;
  return compose(Eigen3{{e.major, e.minor, across}, {d, n, cross(d, n)}});
}

}  // namespace carreau
