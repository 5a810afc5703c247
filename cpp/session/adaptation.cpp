// SPDX-License-Identifier: BSD-3-Clause
#include "session/adaptation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <utility>

#include "mesh/elements/over_nodes.h"
#include "metric/metric3_algebra.h"
#include "support/format.h"

namespace carreau {

namespace {

/// A mesh of the corners alone, without nodes on edges.
FlatMesh straight_mesh(const SurfaceMesh& mesh) {
  FlatMesh flat = flatten(mesh, false);
  flat.vertices.resize(mesh.vertices.size());
  flat.cells.clear();
  return flat;
}

/// A mesh of the places that have `rows` values: all nodes, or corners alone.
FlatMesh straight_mesh(const SurfaceMesh& mesh, std::size_t rows) {
  if (mesh.mid_vertices.empty() || rows != node_count(mesh)) return straight_mesh(mesh);
  return flatten(straight_over_nodes(mesh), false);
}

EstimatorOptions with_bounds(Session& session, EstimatorOptions options) {
  const double diag = session.report().diag;
  if (options.hmin == 0) options.hmin = session.parameters().real("hphymin", diag);
  if (options.hmax == 0) options.hmax = session.parameters().real("hphymax", diag);
  return options;
}

/// The input of the estimator in one process: all processes of a team must have equal input.
std::string checksum_of(std::span<const double> values, const EstimatorOptions& options) {
  LongChecksum sum;
  for (const double value : values) sum.add(std::bit_cast<std::uint64_t>(value));
  for (const int choice : {int(options.source), int(options.shape), int(options.recovery), int(options.relative)})
    sum.add(static_cast<std::uint64_t>(choice));
  for (const double number : {options.tolerance, options.relative_floor, options.hmin, options.hmax, options.ratio})
    sum.add(std::bit_cast<std::uint64_t>(number));
  return sum.text();
}

class Loop {
 public:
  Loop(Session& session, const FieldFunction& field, const AdaptationOptions& options, Monitor& monitor)
      : session_(session), field_(field), options_(options), monitor_(monitor) {
    if (options.iterations < 1)
      throw InvalidArgument("the number of iterations must be at least 1; it is " + std::to_string(options.iterations));
    if (!(options.convergence >= 0) || !std::isfinite(options.convergence))
      throw InvalidArgument("the threshold of convergence must not be negative; it is " +
                            format_number(options.convergence));
    if (session.parameters().integer("hphy_flag") == 0)
      throw InvalidArgument("an adaptation prescribes physical sizes, but hphy_flag is 0: they would be ignored");
  }

  AdaptationReport run() {
    const double share = 1.0 / (options_.iterations + 1);
    if (!session_.has_mesh()) session_.make_mesh(0, share);
    const NoBackgroundAfterwards afterwards(session_);
    look({});
    std::shared_ptr<const KeptMesh> best;
    for (int i = 0; i < options_.iterations && !report_.converged && (i == 0 || !within()); ++i) {
      // The mesh of the start is no result of the loop, however fine it is.
      if (i > 0 && report_.best == report_.steps.size() - 1) best = session_.kept_mesh();
      const VertexPrescriptions wanted = estimated();
      const SizeRange range = range_of(wanted);
      {
        const OpenBounds bounds(session_.parameters(), range);
        session_.set_background(background_of(session_, {wanted.sizes, wanted.metrics, {}}));
        session_.make_mesh((i + 1) * share, (i + 2) * share);
      }
      const auto before = static_cast<double>(report_.steps.back().triangles);
      look(range);
      const auto now = static_cast<double>(report_.steps.back().triangles);
      report_.converged = std::abs(now - before) < options_.convergence * before;
      const std::size_t last = report_.steps.size() - 1;
      if (i == 0 || report_.steps[last].estimate < report_.steps[report_.best].estimate) report_.best = last;
    }
    if (report_.best + 1 < report_.steps.size()) session_.restore(*best);
    describe_end();
    monitor_.progress(Phase::idle, 0, 1);
    return std::move(report_);
  }

 private:
  [[nodiscard]] bool within() const { return report_.within(options_.estimator.tolerance); }

  void describe_end() {
    const AdaptationStep& best = report_.steps[report_.best];
    monitor_.message(Level::summary, "kept adaptation " + std::to_string(report_.best) + " of " +
                                         std::to_string(report_.steps.size() - 1) + ": estimated error " + format_number(best.estimate) +
                                         (within() ? ", within" : ", above") + " the tolerance of " +
                                         format_number(options_.estimator.tolerance));
  }

  /// Estimates the error on the session's mesh, whose values are values_.
  [[nodiscard]] double estimate_of(const FlatMesh& mesh, const InterpolationError& error, const FieldFunction& field, const Executor& executor) {
    const EstimatorOptions options = with_bounds(session_, options_.estimator);
    if (options.source == ErrorSource::hessian) return options.relative ? error.largest_share : error.largest;
    const ScalarField on_mesh{mesh.vertices, mesh.triangles, values_};
    return options_.differences ? estimated_error(on_mesh, field, options) : estimated_error(on_mesh, options, executor, &monitor_);
  }

  VertexPrescriptions estimated() {
    monitor_.checkpoint();
    return options_.differences ? estimate_on_mesh(session_, field_, options_.estimator)
                                : estimate_on_mesh(session_, values_, options_.estimator);
  }

  /// Evaluates the field on the session's mesh and measures.
  void look(SizeRange range) {
    const SurfaceMesh& own = session_.mesh();
    const FlatMesh mesh = straight_mesh(own, node_count(own));
    values_.resize(mesh.vertices.size());
    AdaptationStep step;
    session_.together([&](const Executor& executor) {
      const FieldFunction field = shared_function(field_, executor, monitor_);
      field(mesh.vertices, values_);
      monitor_.checkpoint();
      const double floor = options_.estimator.relative_floor;
      step.error = own.mid_vertices.empty() ? interpolation_error({mesh.vertices, mesh.triangles, values_}, field, floor)
                                            : interpolation_error(own, values_, field, floor);
      step.estimate = estimate_of(mesh, step.error, field, executor);
    });
    step.vertices = static_cast<std::int64_t>(mesh.vertices.size());
    step.triangles = static_cast<std::int64_t>(own.triangle_count());
    if (!report_.steps.empty()) {
      step.smallest_size = range.low;
      step.largest_stretch = range.stretch;
      step.background = session_.background_report();
    }
    const std::string which =
        report_.steps.empty() ? "before adaptation" : "adaptation " + std::to_string(report_.steps.size());
    monitor_.message(Level::summary, which + ": " + std::to_string(step.triangles) +
                                         " triangles, error of the field at most " + format_number(step.error.largest) +
                                         ", root mean square " + format_number(step.error.rms));
    report_.steps.push_back(step);
  }

  Session& session_;
  const FieldFunction& field_;
  const AdaptationOptions& options_;
  Monitor& monitor_;
  std::vector<double> values_;
  AdaptationReport report_;
};

}  // namespace

void require_same_values(const Executor& executor, std::span<const double> values, const EstimatorOptions& options) {
  if (executor.team == nullptr) return;
  executor.team->require_same<InvalidModel>("estimate", checksum_of(values, options), [](int rank) {
    return "the values of the field, or the options, differ on rank " + std::to_string(rank) + " from rank 0";
  });
}

std::shared_ptr<BackgroundField> background_of(const Session& session, VertexValues values) {
  const SurfaceMesh& mesh = session.mesh();
  if (!mesh.mid_vertices.empty() && values.size() == node_count(mesh))
    return std::make_shared<BackgroundField>(straight_over_nodes(mesh), std::move(values));
  return std::make_shared<BackgroundField>(mesh, std::move(values));
}

VertexPrescriptions estimate_on_mesh(Session& session, std::span<const double> values, EstimatorOptions options) {
  const FlatMesh mesh = straight_mesh(session.mesh(), values.size());
  options = with_bounds(session, options);
  VertexPrescriptions wanted;
  session.together([&](const Executor& executor) {
    require_same_values(executor, values, options);
    wanted = estimate({mesh.vertices, mesh.triangles, values}, options, executor, &session.monitor());
  });
  return wanted;
}

VertexPrescriptions estimate_on_mesh(Session& session, const FieldFunction& field, EstimatorOptions options) {
  const FlatMesh mesh = straight_mesh(session.mesh(), node_count(session.mesh()));
  options = with_bounds(session, options);
  VertexPrescriptions wanted;
  session.together([&](const Executor& executor) {
    require_same_values(executor, {}, options);
    wanted = estimate_function(mesh.vertices, mesh.triangles, shared_function(field, executor, session.monitor()), options, executor,
                               &session.monitor());
  });
  return wanted;
}

AdaptationReport adapt(Session& session, const FieldFunction& field, const AdaptationOptions& options,
                       Monitor& monitor) {
  AdaptationReport report;
  session.together([&](const Executor&) { report = Loop(session, field, options, monitor).run(); });
  return report;
}

SizeRange range_of(const VertexPrescriptions& prescriptions) {
  SizeRange range;
  for (const double h : prescriptions.sizes) {
    range.low = std::min(range.low, h);
    range.high = std::max(range.high, h);
  }
  // Across the surface a metric has the smaller of its two sizes.
  for (const Metric3& m : prescriptions.metrics) {
    const Eigen3 e = eigen(m);
    range.low = std::min(range.low, 1 / std::sqrt(e.value[0]));
    range.high = std::max(range.high, 1 / std::sqrt(e.value[2]));
    range.stretch = std::max(range.stretch, std::sqrt(e.value[0] / e.value[2]));
  }
  return range;
}

OpenBounds::OpenBounds(Parameters& parameters, SizeRange range) : parameters_(parameters) {
  open("hphymin", range.low * (1 - 1e-12));
  open("hphymax", range.high * (1 + 1e-12));
}

OpenBounds::~OpenBounds() {
  for (const char* name : opened_) parameters_.reset(name);
}

void OpenBounds::open(const char* name, double value) {
  if (parameters_.is_set(name)) return;
  parameters_.set(name, value);
  opened_.push_back(name);
}

}  // namespace carreau
