// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/base/tangent_metrics.h"

#include <algorithm>
#include <cmath>

#include "metric/metric3_algebra.h"

namespace carreau {

namespace {

Metric3 with_normal(const Metric3& m, double factor, const Vec3& n) noexcept {
  return {m.xx + factor * n.x() * n.x(), m.xy + factor * n.x() * n.y(), m.xz + factor * n.x() * n.z(),
          m.yy + factor * n.y() * n.y(), m.yz + factor * n.y() * n.z(), m.zz + factor * n.z() * n.z()};
}

bool is_plane(const PlaneMetric& m) noexcept { return dot(m.normal, m.normal) > 0; }

/// Invariants of a metric of a plane, in any orthonormal basis: the sum and the product of its eigenvalues.
struct Invariants {
  double trace, product;

  explicit Invariants(const PlaneMetric& p) noexcept {
    const Metric3& m = p.metric;
    trace = m.xx + m.yy + m.zz;
    product = m.xx * m.yy - m.xy * m.xy + m.yy * m.zz - m.yz * m.yz + m.xx * m.zz - m.xz * m.xz;
  }
  [[nodiscard]] double major() const noexcept {
    return trace / 2 + std::sqrt(std::max(0.0, trace * trace / 4 - product));
  }
  [[nodiscard]] double minor() const noexcept { return product / major(); }
};

/// Two orthonormal vectors that are orthogonal to the unit vector n.
std::array<Vec3, 2> basis_of(const Vec3& n) noexcept {
  const Vec3 aside = std::abs(n.x()) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  Vec3 e = cross(n, aside);
  e = e / norm(e);
  return {e, cross(n, e)};
}

}  // namespace

PlaneMetric plane_metric(const SurfaceJet& jet, Metric2 metric, double h) noexcept {
  const auto frame = TangentFrame::of(jet.su, jet.sv);
  if (!frame) return {isotropic_metric3(h), {}};
  return {frame->in_space(frame->of_parameters(metric), 0), cross(frame->e1, frame->e2)};
}

PlaneMetric interpolate(const std::array<const PlaneMetric*, 3>& corners, const std::array<double, 3>& weights,
                        const Vec3& normal) noexcept {
  const std::array<Vec3, 2> basis = basis_of(normal);
  Metric2 sizes{0, 0, 0};  // a tensor whose eigenvalues are sizes
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(weights[i] > 0)) continue;
    std::array<Vec3, 2> e = basis;
    if (is_plane(*corners[i])) {
      const Vec3 n = dot(corners[i]->normal, normal) < 0 ? Vec3(-corners[i]->normal) : corners[i]->normal;
      const double k = 1 / (1 + dot(n, normal));
      for (Vec3& d : e) d = d - (k * dot(n, d)) * (n + normal);
    }
    const Metric2 here = gram(corners[i]->metric, e[0], e[1]);
    // The inverse of the square root of a symmetric tensor, in closed form.
    const double root = std::sqrt(determinant(here)), k = 1 / (root * std::sqrt(here.a + here.c + 2 * root));
    sizes = sizes + weights[i] * Metric2{k * (here.c + root), -k * here.b, k * (here.a + root)};
  }
  const double det = determinant(sizes);
  const Metric2 inverse = (1 / det) * Metric2{sizes.c, -sizes.b, sizes.a}, m = square(inverse);
  const auto& [p, q] = basis;
  PlaneMetric made{{0, 0, 0, 0, 0, 0}, normal};
  const Vec3 mp = m.a * p + m.b * q, mq = m.b * p + m.c * q;
  made.metric = {p.x() * mp.x() + q.x() * mq.x(), p.x() * mp.y() + q.x() * mq.y(), p.x() * mp.z() + q.x() * mq.z(),
                 p.y() * mp.y() + q.y() * mq.y(), p.y() * mp.z() + q.y() * mq.z(), p.z() * mp.z() + q.z() * mq.z()};
  return made;
}

Metric3 where_planes_meet(std::span<const PlaneMetric> planes) {
  if (planes.size() == 1) return planes[0].metric;
  std::vector<Metric3> all;
  for (const PlaneMetric& p : planes)
    all.push_back(is_plane(p) ? with_normal(p.metric, Invariants(p).minor(), p.normal) : p.metric);
  return intersection(all);
}

double mean_size(const PlaneMetric& m) noexcept {
  return is_plane(m) ? 1 / std::sqrt(std::sqrt(Invariants(m).product)) : 1 / std::sqrt(m.metric.xx);
}

double anisotropy(const PlaneMetric& m) noexcept {
  if (!is_plane(m)) return 1;
  const Invariants of(m);
  return std::sqrt(of.major() / of.minor());
}

double length_between(double l_p, double l_q) noexcept {
  return std::abs(l_q - l_p) > 1e-6 * l_p ? l_p * l_q * std::log(l_p / l_q) / (l_p - l_q) : l_p;
}

Metric2 gram(const Metric3& m, const Vec3& p, const Vec3& q) noexcept {
  const Vec3 mp = apply(m, p), mq = apply(m, q);
  return {dot(p, mp), dot(p, mq), dot(q, mq)};
}

double quality_q2(Metric2 gram) noexcept {
  const double squares = 2 * (gram.a + gram.c - gram.b);
  return squares > 0 ? 4 * half_root3 * std::sqrt(std::max(0.0, determinant(gram))) / squares : 0;
}

}  // namespace carreau
