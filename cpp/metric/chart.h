// SPDX-License-Identifier: BSD-3-Clause
// Normal coordinates of a metric field about a point, to second order.
#pragma once

#include <algorithm>
#include <cmath>

#include "metric/metric2.h"

namespace carreau {

/// A metric and its derivatives by u and v.
struct MetricSlopes {
  Metric2 metric, by_u, by_v;
};

/// y(p) = J (e + Gamma(e, e) / 2), e = p - origin, where J^T J is the metric and Gamma holds its Christoffel symbols at
/// the origin. Distances of the field between close points equal distances in the plane of y up to third order; a
/// tensor alone errs in the first. Triangles keep their orientation near the origin.
class Chart {
 public:
  /// `s`: positive definite, at `origin`.
  Chart(Vec2 origin, const MetricSlopes& s) noexcept : origin_(origin) {
    const Metric2 m = s.metric;
    const double det = std::max(determinant(m), 1e-300);
    p_ = std::sqrt(m.a), q_ = m.b / p_, r_ = std::sqrt(det) / p_;
    // Symbols of the first kind (d_i g_jl + d_j g_il - d_l g_ij) / 2, at uu, uv, vv, for l = u and l = v.
    const double u11 = 0.5 * s.by_u.a, u12 = 0.5 * s.by_v.a, u22 = s.by_v.b - 0.5 * s.by_u.c;
    const double v11 = s.by_u.b - 0.5 * s.by_v.a, v12 = 0.5 * s.by_u.c, v22 = 0.5 * s.by_v.c;
    const double k = 0.5 / det;
    u_ = {k * (m.c * u11 - m.b * v11), k * (m.c * u12 - m.b * v12), k * (m.c * u22 - m.b * v22)};
    v_ = {k * (m.a * v11 - m.b * u11), k * (m.a * v12 - m.b * u12), k * (m.a * v22 - m.b * u22)};
  }

  [[nodiscard]] Vec2 origin() const noexcept { return origin_; }
  [[nodiscard]] Vec2 at(const Vec2& p) const noexcept { return at_offset(p - origin_); }
  /// y of origin + e.
  [[nodiscard]] Vec2 at_offset(const Vec2& e) const noexcept {
    return to_frame({e.x() + squared_length(u_, e), e.y() + squared_length(v_, e)});
  }

  /// J^-1 d: the offset that the tensor alone gives.
  [[nodiscard]] Vec2 offset(const Vec2& d) const noexcept { return {(d.x() - q_ * d.y() / r_) / p_, d.y() / r_}; }
  /// The point at y, by Newton's method from a point nearby, which is returned if the chart folds.
  [[nodiscard]] Vec2 point(const Vec2& y, const Vec2& near) const noexcept {
    constexpr int steps = 4;           // from within a unit length: 1e-8 after three
    constexpr double min_det = 0.1;  // of the derivative: 1 at the origin, 0 on the fold
    Vec2 e = near - origin_;
    for (int k = 0; k < steps; ++k) {
      const Vec2 d = y - at_offset(e), w = offset(d);
      const double a = 1 + 2 * (u_.a * e.x() + u_.b * e.y()), b = 2 * (u_.b * e.x() + u_.c * e.y()),
                   c = 2 * (v_.a * e.x() + v_.b * e.y()), f = 1 + 2 * (v_.b * e.x() + v_.c * e.y()), det = a * f - b * c;
      if (!(det > min_det)) return near;
      e = e + (1 / det) * Vec2{f * w.x() - b * w.y(), a * w.y() - c * w.x()};
    }
    return origin_ + e;
  }

  /// |Gamma / 2| in an orthonormal frame: largest distance between straight and geodesic lines of unit length.
  [[nodiscard]] double bend() const noexcept {
    const Vec2 e{1 / p_, 0}, f{-q_ / (p_ * r_), 1 / r_};  // orthonormal
    const auto symbol = [&](Vec2 s, Vec2 t) { return to_frame({dot(u_, s, t), dot(v_, s, t)}); };
    const Vec2 ee = symbol(e, e), ef = symbol(e, f), ff = symbol(f, f);
    return std::sqrt(dot(ee, ee) + 2 * dot(ef, ef) + dot(ff, ff));
  }

 private:
  [[nodiscard]] Vec2 to_frame(const Vec2& w) const noexcept { return {p_ * w.x() + q_ * w.y(), r_ * w.y()}; }

  Vec2 origin_;
  double p_ = 1, q_ = 0, r_ = 1;  // J = (p q; 0 r)
  Metric2 u_, v_;                 // the components of Gamma / 2
};

/// Bend of a field by the change of its shapes and directions alone: as if sizes were kept, the determinant constant.
inline double bend_of_shapes(const MetricSlopes& s) noexcept {
  const Metric2 m = s.metric;
  const auto traceless = [&](Metric2 d) {
    const double half_trace = 0.5 * (m.c * d.a - 2 * m.b * d.b + m.a * d.c) / determinant(m);
    return d + -half_trace * m;
  };
  return Chart({}, {m, traceless(s.by_u), traceless(s.by_v)}).bend();
}

}  // namespace carreau
