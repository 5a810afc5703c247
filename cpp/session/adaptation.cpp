#include "session/adaptation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/mesh_files.h"
#include "io/sol_files.h"
#include "metric/metric3_algebra.h"
#include "support/format.h"

namespace carreau {

namespace {

VertexValues values_of(const Solution& solution) {
  VertexValues values;
  if (!solution.tensor) {
    values.sizes = solution.values;
    return values;
  }
  for (std::size_t v = 0; v < solution.count(); ++v) {
    if (solution.dimension == 2)
      values.parameter.push_back(plane_tensor(solution, v));
    else
      values.space.push_back(space_tensor(solution, v));
  }
  return values;
}

/// Smallest and largest size, largest ratio of the two in the tangent plane.
struct SizeRange {
  double low = HUGE_VAL, high = 0, stretch = 1;
};

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

/// Bounds that the user has not set are those of the prescriptions, while this lives.
class OpenBounds {
 public:
  OpenBounds(Parameters& parameters, SizeRange range) : parameters_(parameters) {
    open("hphymin", range.low * (1 - 1e-12));
    open("hphymax", range.high * (1 + 1e-12));
  }
  ~OpenBounds() {
    for (const char* name : opened_) parameters_.reset(name);
  }
  OpenBounds(const OpenBounds&) = delete;
  OpenBounds& operator=(const OpenBounds&) = delete;

 private:
  void open(const char* name, double value) {
    if (parameters_.is_set(name)) return;
    parameters_.set(name, value);
    opened_.push_back(name);
  }
  Parameters& parameters_;
  std::vector<const char*> opened_;
};

EstimatorOptions with_bounds(Session& session, EstimatorOptions options) {
  const double diag = session.report().diag;
  if (options.hmin == 0) options.hmin = session.parameters().real("hphymin", diag);
  if (options.hmax == 0) options.hmax = session.parameters().real("hphymax", diag);
  return options;
}

class NoBackgroundAfterwards {
 public:
  explicit NoBackgroundAfterwards(Session& session) : session_(session) {}
  ~NoBackgroundAfterwards() { session_.set_background(nullptr); }
  NoBackgroundAfterwards(const NoBackgroundAfterwards&) = delete;
  NoBackgroundAfterwards& operator=(const NoBackgroundAfterwards&) = delete;

 private:
  Session& session_;
};

class Loop {
 public:
  Loop(Session& session, const FieldFunction& field, const AdaptationOptions& options, Monitor& monitor)
      : session_(session), field_(field), options_(options), monitor_(monitor) {
    if (options.iterations < 1)
      throw InvalidArgument("an adaptation has one iteration at least, not " + std::to_string(options.iterations));
    if (!(options.convergence >= 0) || !std::isfinite(options.convergence))
      throw InvalidArgument("the threshold of convergence must not be negative; it is " +
                            format_number(options.convergence));
    if (session.parameters().integer("hphy_flag") == 0)
      throw InvalidArgument("an adaptation prescribes physical sizes, but hphy_flag is 0: they would be ignored");
  }

  AdaptationReport run() {
    if (!session_.has_mesh()) session_.make_mesh();
    const NoBackgroundAfterwards afterwards(session_);
    look({});
    for (int i = 0; i < options_.iterations && !report_.converged; ++i) {
      const VertexPrescriptions wanted = options_.differences ? estimate_on_mesh(session_, field_, options_.estimator)
                                                              : estimate_on_mesh(session_, values_, options_.estimator);
      const SizeRange range = range_of(wanted);
      {
        const OpenBounds bounds(session_.parameters(), range);
        session_.set_background(background_of(session_, {wanted.sizes, wanted.metrics, {}}));
        session_.make_mesh();
      }
      const auto before = static_cast<double>(report_.steps.back().triangles);
      look(range);
      const auto now = static_cast<double>(report_.steps.back().triangles);
      report_.converged = std::abs(now - before) < options_.convergence * before;
    }
    return std::move(report_);
  }

 private:
  /// Evaluates the field on the session's mesh and measures.
  void look(SizeRange range) {
    const FlatMesh mesh = flatten(session_.mesh(), false);
    values_.resize(mesh.vertices.size());
    field_(mesh.vertices, values_);
    monitor_.checkpoint();
    AdaptationStep step;
    step.vertices = static_cast<std::int64_t>(mesh.vertices.size());
    step.triangles = static_cast<std::int64_t>(mesh.triangles.size());
    step.error = interpolation_error({mesh.vertices, mesh.triangles, values_}, field_);
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

std::shared_ptr<BackgroundField> read_background(const std::string& mesh_path, const std::string& sol_path) {
  FlatMesh flat = read_mesh(mesh_path);
  const Solution solution = read_solution(sol_path, SolutionUse::prescription);
  if (flat.triangles.empty()) throw FileError({.file = mesh_path}, "a background mesh needs triangles; it has none");
  if (solution.dimension != flat.dimension)
    throw FileError({.file = sol_path}, "its dimension is " + std::to_string(solution.dimension) + ", but that of " +
                                            mesh_path + " is " + std::to_string(flat.dimension));
  if (solution.count() != flat.vertices.size())
    throw FileError({.file = sol_path}, "it has values at " + std::to_string(solution.count()) + " vertices, but " +
                                            mesh_path + " has " + std::to_string(flat.vertices.size()));
  BackgroundMesh mesh;
  mesh.dimension = flat.dimension;
  mesh.vertices = std::move(flat.vertices);
  mesh.triangles = std::move(flat.triangles);
  if (flat.dimension == 2) mesh.faces = std::move(flat.triangle_refs);
  mesh.values = values_of(solution);
  return std::make_shared<BackgroundField>(mesh);
}

std::shared_ptr<BackgroundField> background_of(const Session& session, VertexValues values) {
  return std::make_shared<BackgroundField>(session.mesh(), std::move(values));
}

VertexPrescriptions estimate_on_mesh(Session& session, std::span<const double> values, EstimatorOptions options) {
  const FlatMesh mesh = flatten(session.mesh(), false);
  return estimate({mesh.vertices, mesh.triangles, values}, with_bounds(session, options));
}

VertexPrescriptions estimate_on_mesh(Session& session, const FieldFunction& field, EstimatorOptions options) {
  const FlatMesh mesh = flatten(session.mesh(), false);
  return estimate_function(mesh.vertices, mesh.triangles, field, with_bounds(session, options));
}

AdaptationReport adapt(Session& session, const FieldFunction& field, const AdaptationOptions& options,
                       Monitor& monitor) {
  return Loop(session, field, options, monitor).run();
}

}  // namespace carreau
