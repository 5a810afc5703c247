// SPDX-License-Identifier: BSD-3-Clause
// Algebra of metrics for hosts.
#include <algorithm>
#include <cmath>
#include <string>

#include "arguments.h"
#include "carreau.h"
#include "curve/metric_curve.h"
#include "guard.h"
#include "metric/largest_ellipsoid.h"
#include "metric_rows.h"

using carreau::InvalidArgument;
using carreau::Metric2;
using carreau::Metric3;
using carreau::MetricLaw;
using carreau::Vec2;
using carreau::Vec3;
using namespace carreau::abi;

namespace {

/// Vectors and metrics of a dimension as rows of numbers.
template <int D>
struct Kind;
template <>
struct Kind<2> {
  using Metric = Metric2;
  using Vec = Vec2;
  static constexpr int width = 3;
};
template <>
struct Kind<3> {
  using Metric = Metric3;
  using Vec = Vec3;
  static constexpr int width = 6;
};

/// run(Kind of the dimension), once the counts are sound.
template <typename Run>
void in_dimension(std::int32_t dimension, std::int64_t n, Run&& run) {
  if (n < 0) throw InvalidArgument("n is " + std::to_string(n) + ", below 0");
  if (dimension == 2) return run(std::integral_constant<int, 2>());
  if (dimension == 3) return run(std::integral_constant<int, 3>());
  throw InvalidArgument("dimension is " + std::to_string(dimension) + "; it must be 2 or 3");
}

MetricLaw law_of(std::int32_t law) {
  if (law < 0 || law > 2)
    throw InvalidArgument("law is " + std::to_string(law) + "; it must be 0 (linear), 1 (geometric) or 2 (sinusoidal)");
  return static_cast<MetricLaw>(law);
}

template <int D>
typename Kind<D>::Metric metric_at(const double* rows, std::int64_t rank, const char* name) {
  typename Kind<D>::Metric m;
  read(rows + rank * Kind<D>::width, m);
  if (!carreau::is_positive_definite(m))
    throw InvalidArgument("metric " + std::to_string(rank) + " of " + name + " is not positive definite");
  return m;
}

void write(const Metric2& m, double* out) { out[0] = m.a, out[1] = m.b, out[2] = m.c; }
void write(const Metric3& m, double* out) {
  out[0] = m.xx, out[1] = m.xy, out[2] = m.xz, out[3] = m.yy, out[4] = m.yz, out[5] = m.zz;
}

/// Rows of results, given to the caller when all are there: an error leaves the caller's as they were.
class Rows {
 public:
  Rows(std::int64_t n, int width, double* out) : width_(width), values_(static_cast<std::size_t>(n * width)), out_(out) {}
  [[nodiscard]] double* operator[](std::int64_t i) { return values_.data() + i * width_; }
  void give() const { std::copy(values_.begin(), values_.end(), out_); }

 private:
  int width_;
  std::vector<double> values_;
  double* out_;
};

/// Sizes ascending, axes one after another.
void decompose(const Metric2& m, double* sizes, double* axes) {
  const carreau::Eigen2 e = carreau::eigen(m);
  sizes[0] = 1 / std::sqrt(e.major), sizes[1] = 1 / std::sqrt(e.minor);
  axes[0] = e.direction.x(), axes[1] = e.direction.y(), axes[2] = -e.direction.y(), axes[3] = e.direction.x();
}
void decompose(const Metric3& m, double* sizes, double* axes) {
  const carreau::Eigen3 e = carreau::eigen(m);
  for (std::size_t i = 0; i < 3; ++i) {
    sizes[i] = 1 / std::sqrt(e.value[i]);
    std::copy_n(e.axis[i].data(), 3, axes + 3 * i);
  }
}

Metric2 composed(const double* k, const Vec2* axis) {
  return {k[0] * axis[0].x() * axis[0].x() + k[1] * axis[1].x() * axis[1].x(),
          k[0] * axis[0].x() * axis[0].y() + k[1] * axis[1].x() * axis[1].y(),
          k[0] * axis[0].y() * axis[0].y() + k[1] * axis[1].y() * axis[1].y()};
}
Metric3 composed(const double* k, const Vec3* axis) {
  return carreau::compose(carreau::Eigen3{{k[0], k[1], k[2]}, {axis[0], axis[1], axis[2]}});
}

/// Directions that are orthogonal in both metrics, of any length.
void conjugate(const Metric3& p, const Metric3& q, Vec3* directions) {
  const carreau::Reduction3 r = carreau::reduce(p, q);
  const double volume = carreau::dot(r.axis[0], carreau::cross(r.axis[1], r.axis[2]));
  for (int i = 0; i < 3; ++i) directions[i] = carreau::cross(r.axis[(i + 1) % 3], r.axis[(i + 2) % 3]) / volume;
}
// In space, with a ratio across the plane that no ratio in it reaches.
void conjugate(const Metric2& p, const Metric2& q, Vec2* directions) {
  const double largest = carreau::length_ratios(q, p).largest;
  Vec3 found[3];
  conjugate(Metric3{p.a, p.b, 0, p.c, 0, 1}, Metric3{q.a, q.b, 0, q.c, 0, 4 * largest * largest}, found);
  for (int i = 0; i < 2; ++i) directions[i] = {found[i + 1].x(), found[i + 1].y()};
}

}  // namespace

carreau_status carreau_metric_sizes(carreau_session* session, int32_t dimension, int64_t n, const double* metrics,
                                    double* out_sizes, double* out_axes) {
  return guarded(session, [&] {
    in_dimension(dimension, n, [&](auto d) {
      required(metrics, "metrics"), required(out_sizes, "out_sizes");
      Rows sizes(n, d, out_sizes), axes(n, d * d, out_axes);
      for (std::int64_t i = 0; i < n; ++i) decompose(metric_at<d>(metrics, i, "metrics"), sizes[i], axes[i]);
      sizes.give();
      if (out_axes != nullptr) axes.give();
    });
  });
}

carreau_status carreau_metric_of_sizes(carreau_session* session, int32_t dimension, int64_t n, const double* sizes,
                                       const double* axes, double* out_metrics) {
  return guarded(session, [&] {
    in_dimension(dimension, n, [&](auto d) {
      required(sizes, "sizes"), required(axes, "axes"), required(out_metrics, "out_metrics");
      Rows result(n, Kind<d>::width, out_metrics);
      for (std::int64_t i = 0; i < n; ++i) {
        typename Kind<d>::Vec axis[d];
        double inverse[d];
        for (int k = 0; k < d; ++k) {
          const double h = sizes[i * d + k];
          if (!(h > 0) || !std::isfinite(h))
            throw InvalidArgument("size " + std::to_string(i * d + k) + " of sizes is not finite and positive");
          inverse[k] = 1 / (h * h);
          read(axes + (i * d + k) * d, axis[k]);
          const double given = axis[k].norm();
          for (int j = 0; j < k; ++j) axis[k] -= axis[j].dot(axis[k]) * axis[j];
          const double left = axis[k].norm();
          constexpr double parallel = 1e-10;
          if (!(left > parallel * given) || !std::isfinite(given))
            throw InvalidArgument("axis " + std::to_string(i * d + k) + " of axes is zero, or no other direction than those before it");
          axis[k] /= left;
        }
        write(composed(inverse, axis), result[i]);
      }
      result.give();
    });
  });
}

carreau_status carreau_metric_interpolate(carreau_session* session, int32_t dimension, int32_t law, int64_t n,
                                          const double* p, const double* q, const double* share, double* out_metrics) {
  return guarded(session, [&] {
    const MetricLaw follows = law_of(law);
    in_dimension(dimension, n, [&](auto d) {
      required(p, "p"), required(q, "q"), required(share, "share"), required(out_metrics, "out_metrics");
      Rows result(n, Kind<d>::width, out_metrics);
      for (std::int64_t i = 0; i < n; ++i) {
        if (!(share[i] >= 0 && share[i] <= 1)) throw InvalidArgument("share " + std::to_string(i) + " is not between 0 and 1");
        const auto from = metric_at<d>(p, i, "p"), to = metric_at<d>(q, i, "q");
        write(carreau::interpolate(from, to, share[i], follows), result[i]);
      }
      result.give();
    });
  });
}

carreau_status carreau_metric_intersect(carreau_session* session, int32_t dimension, int32_t how, int64_t n,
                                        int64_t count, const double* metrics, double* out_metrics) {
  return guarded(session, [&] {
    if (how != CARREAU_INTERSECT_IN_TURN && how != CARREAU_INTERSECT_LARGEST)
      throw InvalidArgument("how is " + std::to_string(how) + "; it must be 0 (in turn) or 1 (largest)");
    if (count < 1) throw InvalidArgument("there is no metric: count is " + std::to_string(count));
    in_dimension(dimension, n, [&](auto d) {
      required(metrics, "metrics"), required(out_metrics, "out_metrics");
      std::vector<typename Kind<d>::Metric> here(static_cast<std::size_t>(count));
      Rows result(n, Kind<d>::width, out_metrics);
      for (std::int64_t i = 0; i < n; ++i) {
        for (std::int64_t k = 0; k < count; ++k) here[static_cast<std::size_t>(k)] = metric_at<d>(metrics, i * count + k, "metrics");
        const std::span<const typename Kind<d>::Metric> all(here);
        write(how == CARREAU_INTERSECT_LARGEST ? carreau::largest_inside(all) : carreau::intersection(all),
              result[i]);
      }
      result.give();
    });
  });
}

carreau_status carreau_metric_reduce(carreau_session* session, int32_t dimension, int64_t n, const double* p,
                                     const double* q, double* out_p_sizes, double* out_q_sizes,
                                     double* out_directions) {
  return guarded(session, [&] {
    in_dimension(dimension, n, [&](auto d) {
      required(p, "p"), required(q, "q"), required(out_directions, "out_directions");
      required(out_p_sizes, "out_p_sizes"), required(out_q_sizes, "out_q_sizes");
      Rows of_p(n, d, out_p_sizes), of_q(n, d, out_q_sizes), directions(n, d * d, out_directions);
      for (std::int64_t i = 0; i < n; ++i) {
        const auto first = metric_at<d>(p, i, "p"), second = metric_at<d>(q, i, "q");
        typename Kind<d>::Vec direction[d];
        conjugate(first, second, direction);
        for (int k = 0; k < d; ++k) {
          direction[k].normalize();
          of_p[i][k] = 1 / length(first, direction[k]);
          of_q[i][k] = 1 / length(second, direction[k]);
          std::copy_n(direction[k].data(), int(d), directions[i] + k * d);
        }
      }
      of_p.give(), of_q.give(), directions.give();
    });
  });
}

carreau_status carreau_metric_lengths(carreau_session* session, int32_t dimension, int32_t law, int64_t n,
                                      const double* edges, const double* metrics, double* out_lengths) {
  return guarded(session, [&] {
    const MetricLaw follows = law_of(law);
    in_dimension(dimension, n, [&](auto d) {
      required(edges, "edges"), required(metrics, "metrics"), required(out_lengths, "out_lengths");
      using Vec = typename Kind<d>::Vec;
      using Metric = typename Kind<d>::Metric;
      constexpr double fine = 0.02;  // longest trapezoid
      Rows result(n, 1, out_lengths);
      for (std::int64_t i = 0; i < n; ++i) {
        Vec a, b;
        read(edges + 2 * i * d, a), read(edges + (2 * i + 1) * d, b);
        const Metric at_a = metric_at<d>(metrics, 2 * i, "metrics"), at_b = metric_at<d>(metrics, 2 * i + 1, "metrics");
        const double far = (b - a).norm();
        if (!std::isfinite(far)) throw InvalidArgument("edge " + std::to_string(i) + " has an end that is not finite");
        *result[i] = far > 0 ? carreau::MetricCurve<Vec, Metric>({a, b}, {0, far}, {at_a, at_b}, follows).gradation(fine).length() : 0;
      }
      result.give();
    });
  });
}
