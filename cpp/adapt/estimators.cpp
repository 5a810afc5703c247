// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/estimators.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "adapt/thresholds.h"
#include "metric/metric2_algebra.h"
#include "metric/metric3_algebra.h"
#include "support/error.h"
#include "support/format.h"
#include "support/work_sizes.h"

namespace carreau {
namespace {

using namespace thresholds::adapt;

void check_options(const ScalarField& field, const EstimatorOptions& o) {
  if (!(o.hmin > 0) || !(o.hmax >= o.hmin) || !std::isfinite(o.hmax))
    throw InvalidArgument("an estimator's bounds must be positive, finite and ascending; they are " +
                          format_number(o.hmin) + " and " + format_number(o.hmax));
  if (!(o.tolerance > 0) || !std::isfinite(o.tolerance))
    throw InvalidArgument("an estimator's tolerance must be positive; it is " + format_number(o.tolerance));
  if (o.source == ErrorSource::curvature && !(o.tolerance < 90))
    throw InvalidArgument("an estimator's angle must be below 90 degrees; it is " + format_number(o.tolerance));
  if (!(o.ratio >= 1)) throw InvalidArgument("a ratio of sizes is at least 1; it is " + format_number(o.ratio));
  if (!(o.relative_floor > 0)) throw InvalidArgument("the floor of a relative error must be positive");
  if (o.source == ErrorSource::hessian && o.shape == ErrorShape::graph)
    throw InvalidArgument("the Hessian gives no sizes in the tangent planes of the graph");
  if (o.source == ErrorSource::hessian) return;
  for (const Vec3& p : field.vertices)
    if (p.z() != 0) throw InvalidArgument("a graph is estimated over a mesh of the plane z = 0 only");
}

/// The graph z = field at a vertex: root of its first fundamental form, curvatures and their directions.
struct Graph {
  Metric2 root;    ///< (I + g g^T)^(1/2): lengths in the tangent plane
  double slope2;   ///< |g|^2
  Eigen2 bending;  ///< absolute principal curvatures, directions in the coordinates root . d
};

Metric2 sandwich(Metric2 s, Metric2 m) noexcept {  // S M S
  const Vec2 p{m.a * s.a + m.b * s.b, m.b * s.a + m.c * s.b}, q{m.a * s.b + m.b * s.c, m.b * s.b + m.c * s.c};
  return {s.a * p.x() + s.b * p.y(), s.a * q.x() + s.b * q.y(), s.b * q.x() + s.c * q.y()};
}

/// Identity plus (factor - 1) along g.
Metric2 stretched_along(const Vec2& g, double factor) noexcept {
  const double g2 = dot(g, g);
  if (!(g2 > 0)) return {1, 0, 1};
  const double k = (factor - 1) / g2;
  return {1 + k * g.x() * g.x(), k * g.x() * g.y(), 1 + k * g.y() * g.y()};
}

/// Absolute values; the larger first.
Eigen2 absolute(Eigen2 e) noexcept {
  e.major = std::abs(e.major);
  e.minor = std::abs(e.minor);
  if (e.major < e.minor) e = {e.minor, e.major, {-e.direction.y(), e.direction.x()}};
  return e;
}

Graph graph_at(const LocalDerivatives& d) noexcept {
  const double slope2 = dot(d.gradient, d.gradient), w = std::sqrt(1 + slope2);
  // Second fundamental form H / w (HDR eq. 4.92 to 4.94), in coordinates that are orthonormal in the tangent plane.
  const Metric2 form = sandwich(stretched_along(d.gradient, 1 / w), (1 / w) * d.hessian);
  return {stretched_along(d.gradient, w), slope2, absolute(eigen(form))};
}

class Estimate {
 public:
  Estimate(const ScalarField& field, const EstimatorOptions& options) : field_(field), options_(options) {
    largest_ = largest_value(field.values);
    if (options.source == ErrorSource::deformation && options.shape != ErrorShape::anisotropic)
      neighbours_ = neighbours_of(field.vertices.size(), field.triangles);
  }

  /// The metric of the mesh's plane at a vertex.
  [[nodiscard]] Metric2 metric_at(std::size_t v, const LocalDerivatives& d) const {
    if (!d.reliable) return isotropic(options_.hmax);
    if (options_.source == ErrorSource::hessian) {
      // 2/9 h^2 |d^T H d| = error in each direction (HDR eq. 3.3 to 3.5).
      const Eigen2 e = absolute(eigen(d.hessian));
      const double k = 2 / (9 * tolerance_at(v));
      return compose(bounded({k * e.major, k * e.minor, e.direction}));
    }
    const Graph graph = graph_at(d);
    if (options_.shape == ErrorShape::anisotropic)
      return sandwich(graph.root, compose(bounded(anisotropic_in_tangent_plane(v, graph))));
    const double h = std::clamp(size_in_tangent_plane(v, d, graph), options_.hmin, options_.hmax);
    // The circle's projection, or the largest circle inside it (HDR sec. 3.4.3 a.2).
    if (options_.shape == ErrorShape::graph) return limited_ratio(sandwich(graph.root, isotropic(h)));
    return isotropic(h / std::sqrt(1 + graph.slope2));
  }

  /// The error that the vertex sees along the edge to w, in the unit of the tolerance.
  [[nodiscard]] double error_along(std::size_t v, std::size_t w, const LocalDerivatives& d) const {
    const Vec2 r = d.frame.in_plane(field_.vertices[w] - field_.vertices[v]);
    const double share = options_.tolerance / tolerance_at(v);
    if (options_.source == ErrorSource::hessian)
      return 2.0 / 9 * share *
             std::abs(d.hessian.a * r.x() * r.x() + 2 * d.hessian.b * r.x() * r.y() + d.hessian.c * r.y() * r.y());
    const double rise = field_.values[w] - field_.values[v];
    const double away = std::abs(rise - dot(d.gradient, r)) / std::sqrt(1 + dot(d.gradient, d.gradient));
    if (options_.source == ErrorSource::deformation) return share * away;
    const double length = std::sqrt(dot(r, r) + rise * rise);
    return length > 0 ? std::asin(std::min(1.0, away / length)) * 180 / std::numbers::pi : 0;
  }

 private:
  static Metric2 isotropic(double h) noexcept { return {1 / (h * h), 0, 1 / (h * h)}; }

  [[nodiscard]] Metric2 limited_ratio(Metric2 m) const noexcept {
    Eigen2 e = eigen(m);
    e.minor = std::max(e.minor, e.major / (options_.ratio * options_.ratio));
    return compose(e);
  }
  [[nodiscard]] Eigen2 bounded(Eigen2 e) const noexcept {
    const double low = 1 / (options_.hmax * options_.hmax), high = 1 / (options_.hmin * options_.hmin);
    e.major = std::clamp(e.major, low, high);
    e.minor = std::clamp(std::max(e.minor, e.major / (options_.ratio * options_.ratio)), low, high);
    return e;
  }
  [[nodiscard]] double tolerance_at(std::size_t v) const noexcept {
    if (!options_.relative || !(largest_ > 0)) return options_.tolerance;
    return options_.tolerance * std::max(std::abs(field_.values[v]), options_.relative_floor * largest_);
  }
  [[nodiscard]] double angle() const noexcept { return options_.tolerance * std::numbers::pi / 180; }

  /// Squared inverse sizes along the principal directions.
  [[nodiscard]] Eigen2 anisotropic_in_tangent_plane(std::size_t v, const Graph& graph) const noexcept {
    Eigen2 e = graph.bending;
    if (options_.source == ErrorSource::deformation) {
      const double k = 1 / (2 * tolerance_at(v));  // h^2 kappa / 2 = error
      return {k * e.major, k * e.minor, e.direction};
    }
    // 4 delta (2 rho - delta) in both directions, delta = (1 - cos eps) rho_1 (HDR eq. 4.40), times kappa.
    if (!(e.major > 0)) return {0, 0, e.direction};
    const double delta = (1 - std::cos(angle())) / e.major;
    const auto inverse = [&](double kappa) { return kappa / (4 * delta * (2 - delta * kappa)); };
    return {inverse(e.major), inverse(e.minor), e.direction};
  }

  [[nodiscard]] double size_in_tangent_plane(std::size_t v, const LocalDerivatives& d, const Graph& graph) const {
    if (options_.source == ErrorSource::curvature) return 2 * std::sin(angle()) / graph.bending.major;  // HDR eq. 4.35
    // HDR eq. 3.8 takes the size inversely proportional to the distance of neighbours from the tangent plane, which
    // grows with the mesh's own size. Dividing by the squared distance makes it a property of the surface.
    double steepest = 0;
    for (const std::int32_t w : neighbours_.of(static_cast<std::int32_t>(v))) {
      const Vec3 r = field_.vertices[static_cast<std::size_t>(w)] - field_.vertices[v];
      const double rise = field_.values[static_cast<std::size_t>(w)] - field_.values[v];
      const double away = std::abs(rise - dot(d.gradient, Vec2{r.x(), r.y()})) / std::sqrt(1 + graph.slope2);
      const double along2 = r.x() * r.x() + r.y() * r.y() + rise * rise - away * away;
      if (along2 > 0) steepest = std::max(steepest, away / along2);
    }
    return steepest > 0 ? std::sqrt(tolerance_at(v) / steepest) : options_.hmax;
  }

  const ScalarField& field_;
  const EstimatorOptions& options_;
  double largest_ = 0;
  Neighbours neighbours_;
};

/// The metric of space that is `m` in the plane of the frame.
Metric3 in_space(Metric2 m, const VertexFrame& f) noexcept {
  const double across = eigen(m).major;
  const auto entry = [&](double x1, double y1, double z1, double x2, double y2, double z2) {
    return m.a * x1 * x2 + m.b * (x1 * y2 + y1 * x2) + m.c * y1 * y2 + across * z1 * z2;
  };
  const Vec3 p = f.e1, q = f.e2, n = f.normal;
  return {entry(p.x(), q.x(), n.x(), p.x(), q.x(), n.x()), entry(p.x(), q.x(), n.x(), p.y(), q.y(), n.y()),
          entry(p.x(), q.x(), n.x(), p.z(), q.z(), n.z()), entry(p.y(), q.y(), n.y(), p.y(), q.y(), n.y()),
          entry(p.y(), q.y(), n.y(), p.z(), q.z(), n.z()), entry(p.z(), q.z(), n.z(), p.z(), q.z(), n.z())};
}

/// Metrics in the planes of the frames of all vertices.
struct PlaneMetrics {
  std::vector<Metric2> metrics;
  std::vector<char> reliable;
};

/// Distributes rows by vertex.
struct Sharing {
  Sharing(const Executor& of, Monitor* told) : executor(of), monitor(told != nullptr ? *told : silent) {}
  Executor executor;
  Monitor silent;
  Monitor& monitor;

  /// metric_at(v) for each vertex below n.
  template <typename MetricAt>
  std::vector<Metric2> metrics(std::size_t n, const MetricAt& metric_at) {
    constexpr std::size_t width = 3;
    const auto fill = [&](std::size_t first, std::size_t last, double* out, Monitor&) {
      for (std::size_t v = first; v < last; ++v, out += width) {
        const Metric2 m = metric_at(v);
        out[0] = m.a, out[1] = m.b, out[2] = m.c;
      }
    };
    const std::vector<double> rows =
        shared_rows(executor, "metrics of a field", {.count = n, .width = width, .at_once = work_sizes::piece_of(n)}, fill, monitor);
    std::vector<Metric2> result;
    result.reserve(n);
    for (const double* row = rows.data(); result.size() < n; row += width) result.push_back({row[0], row[1], row[2]});
    return result;
  }
};

PlaneMetrics plane_metrics(const ScalarField& field, const std::vector<LocalDerivatives>& derivatives,
                           const EstimatorOptions& options, Sharing& sharing) {
  check_field(field);
  check_options(field, options);
  if (derivatives.size() != field.vertices.size())
    throw InvalidArgument("an estimator needs derivatives at each vertex; there are " +
                          std::to_string(derivatives.size()));
  const Estimate estimate(field, options);
  PlaneMetrics result;
  result.metrics =
      sharing.metrics(derivatives.size(), [&](std::size_t v) { return estimate.metric_at(v, derivatives[v]); });
  for (const LocalDerivatives& d : derivatives) result.reliable.push_back(d.reliable ? 1 : 0);
  return result;
}

std::vector<LocalDerivatives> derivatives_of(const ScalarField& field, const EstimatorOptions& options, Sharing& sharing) {
  switch (options.recovery) {
    case Recovery::projection:
      return project_derivatives(field);
    case Recovery::quadric:
      return quadric_derivatives(field);
    case Recovery::fit:
      break;
  }
  return recover_derivatives(field, sharing.executor, &sharing.monitor);
}

PlaneMetrics intersection_of(std::vector<PlaneMetrics> each, Sharing& sharing) {
  if (each.size() == 1) return std::move(each.front());
  PlaneMetrics all;
  all.metrics = sharing.metrics(each.front().metrics.size(), [&](std::size_t v) {
    std::vector<Metric2> here;
    for (const PlaneMetrics& one : each) here.push_back(one.metrics[v]);
    return intersection(here);
  });
  all.reliable = each.front().reliable;
  for (const PlaneMetrics& one : each)
    for (std::size_t v = 0; v < all.reliable.size(); ++v)
      all.reliable[v] = static_cast<char>(all.reliable[v] & one.reliable[v]);
  return all;
}

VertexPrescriptions prescriptions_of(const PlaneMetrics& found, const std::vector<LocalDerivatives>& derivatives,
                                     ErrorShape shape) {
  VertexPrescriptions result;
  for (std::size_t v = 0; v < derivatives.size(); ++v) {
    if (found.reliable[v] == 0) ++result.unreliable;
    const Metric2& m = found.metrics[v];
    if (shape == ErrorShape::isotropic)
      result.sizes.push_back(1 / std::sqrt(eigen(m).major));
    else
      result.metrics.push_back(in_space(m, derivatives[v].frame));
  }
  return result;
}

}  // namespace

VertexPrescriptions estimate(const ScalarField& field, const std::vector<LocalDerivatives>& derivatives,
                             const EstimatorOptions& options, const Executor& executor, Monitor* monitor) {
  Sharing sharing(executor, monitor);
  return prescriptions_of(plane_metrics(field, derivatives, options, sharing), derivatives, options.shape);
}

double estimated_error(const ScalarField& field, const std::vector<LocalDerivatives>& derivatives, const EstimatorOptions& options) {
  check_options(field, options);
  const Estimate estimate(field, options);
  double largest = 0;
  for (const auto& t : field.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(t[k]), w = static_cast<std::size_t>(t[(k + 1) % 3]);
      if (derivatives[v].reliable) largest = std::max(largest, estimate.error_along(v, w, derivatives[v]));
      if (derivatives[w].reliable) largest = std::max(largest, estimate.error_along(w, v, derivatives[w]));
    }
  return largest;
}

double estimated_error(const ScalarField& field, const EstimatorOptions& options, const Executor& executor, Monitor* monitor) {
  check_field(field);
  Sharing sharing(executor, monitor);
  return estimated_error(field, derivatives_of(field, options, sharing), options);
}

VertexPrescriptions estimate(const ScalarField& field, const EstimatorOptions& options, const Executor& executor,
                             Monitor* monitor) {
  check_field(field);
  check_options(field, options);
  Sharing sharing(executor, monitor);
  return estimate(field, derivatives_of(field, options, sharing), options, executor, monitor);
}

VertexPrescriptions estimate_all(std::span<const Vec3> vertices,
                                 std::span<const std::array<std::int32_t, 3>> triangles,
                                 std::span<const double> values, std::size_t fields, const EstimatorOptions& options,
                                 const Executor& executor, Monitor* monitor) {
  if (fields == 0 || values.size() != fields * vertices.size())
    throw InvalidArgument("an estimator needs a value of each of " + std::to_string(fields) + " fields at each of " +
                          std::to_string(vertices.size()) + " vertices; there are " + std::to_string(values.size()));
  Sharing sharing(executor, monitor);
  std::vector<double> one(vertices.size());
  std::vector<LocalDerivatives> derivatives;
  std::vector<PlaneMetrics> each;
  for (std::size_t f = 0; f < fields; ++f) {
    for (std::size_t v = 0; v < one.size(); ++v) one[v] = values[v * fields + f];
    const ScalarField field{vertices, triangles, one};
    check_field(field);
    check_options(field, options);
    derivatives = derivatives_of(field, options, sharing);  // frames do not depend on the field
    each.push_back(plane_metrics(field, derivatives, options, sharing));
  }
  return prescriptions_of(intersection_of(std::move(each), sharing), derivatives, options.shape);
}

double estimated_error_of_all(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                              std::span<const double> values, std::size_t fields, const EstimatorOptions& options,
                              const Executor& executor, Monitor* monitor) {
  double largest = 0;
  std::vector<double> one(vertices.size());
  for (std::size_t f = 0; f < fields; ++f) {
    for (std::size_t v = 0; v < one.size(); ++v) one[v] = values[v * fields + f];
    largest = std::max(largest, estimated_error({vertices, triangles, one}, options, executor, monitor));
  }
  return largest;
}

}  // namespace carreau
