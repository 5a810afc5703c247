#include "session/adaptation.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>

#include "io/files.h"
#include "io/medit/sol_files.h"
#include "io/mesh_files.h"
#include "io/plane/plane_files.h"
#include "metric/metric3_algebra.h"
#include "support/format.h"

namespace carreau {

namespace {

/// Fields belong to corners: without nodes on edges.
FlatMesh straight_mesh(const SurfaceMesh& mesh) {
  FlatMesh flat = flatten(mesh, false);
  flat.vertices.resize(mesh.vertices.size());
  flat.cells.clear();
  return flat;
}

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
    const double share = 1.0 / (options_.iterations + 1);
    if (!session_.has_mesh()) session_.make_mesh(0, share);
    const NoBackgroundAfterwards afterwards(session_);
    look({});
    for (int i = 0; i < options_.iterations && !report_.converged; ++i) {
      const VertexPrescriptions wanted = options_.differences ? estimate_on_mesh(session_, field_, options_.estimator)
                                                              : estimate_on_mesh(session_, values_, options_.estimator);
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
    }
    monitor_.progress(Phase::idle, 0, 1);
    return std::move(report_);
  }

 private:
  /// Evaluates the field on the session's mesh and measures.
  void look(SizeRange range) {
    const FlatMesh mesh = straight_mesh(session_.mesh());
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

template <typename Enum>
Enum choice(const Parameters& parameters, const char* name, std::initializer_list<const char*> texts) {
  const std::string text = parameters.text(name);
  int i = 0;
  for (const char* known : texts) {
    if (text == known) break;
    ++i;
  }
  return static_cast<Enum>(i);
}

EstimatorOptions estimator_of(const Parameters& parameters, const std::vector<Vec3>& vertices) {
  EstimatorOptions options;
  options.source =
      choice<ErrorSource>(parameters, "adapt_source", {"hessian", "curvature", "deformation"});  // order of the values
  options.shape = choice<ErrorShape>(parameters, "adapt_shape", {"isotropic", "graph", "anisotropic"});
  options.tolerance = parameters.real("adapt_tolerance");
  options.relative = parameters.integer("adapt_relative") != 0;
  Vec3 low = vertices.front(), high = low;
  for (const Vec3& p : vertices) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double diagonal = norm(high - low);
  options.hmin = parameters.real("adapt_hmin") > 0 ? parameters.real("adapt_hmin") : diagonal / 500;
  options.hmax = parameters.real("adapt_hmax") > 0 ? parameters.real("adapt_hmax") : diagonal / 5;
  return options;
}

/// A mesh of a file as one whose faces lie in their parameter planes (dimension 2), or in none.
SurfaceMesh surface_of(const FlatMesh& flat, const Model& model) {
  SurfaceMesh mesh;
  mesh.vertices = flat.vertices;
  mesh.vertex_ref.assign(flat.vertices.size(), 0);
  FaceMesh whole;
  for (std::size_t v = 0; v < flat.vertices.size(); ++v) {
    whole.uv.push_back({flat.vertices[v].x(), flat.vertices[v].y()});
    whole.vertex.push_back(static_cast<std::int32_t>(v));
  }
  const auto part = [&](int ref, int named) {
    FaceMesh face = whole;
    face.ref = ref;
    for (std::size_t i = 0; i < flat.triangles.size(); ++i)
      if (flat.triangle_refs[i] == named) face.triangles.push_back(flat.triangles[i]);
    if (!face.triangles.empty()) mesh.faces.push_back(std::move(face));
  };
  if (flat.dimension == 2) {
    for (const Face& face : model.faces) {
      const bool named =
          std::find(flat.triangle_refs.begin(), flat.triangle_refs.end(), face.ref) != flat.triangle_refs.end();
      part(face.ref, named ? face.ref : 0);
    }
  } else {  // no face of a model has this reference: looked up in space
    whole.ref = std::numeric_limits<int>::min();
    whole.triangles = flat.triangles;
    mesh.faces.push_back(std::move(whole));
  }
  return mesh;
}

/// On parameter planes sizes are lengths there: metrics say so.
VertexValues values_on(int dimension, const VertexPrescriptions& wanted) {
  if (dimension == 3) return {wanted.sizes, wanted.metrics, {}};
  VertexValues values;
  for (const double h : wanted.sizes) values.parameter.push_back({1 / (h * h), 0, 1 / (h * h)});
  for (const Metric3& m : wanted.metrics) values.parameter.push_back({m.xx, m.xy, m.yy});
  return values;
}

/// Values of a scalar field of a file at so many vertices.
Solution read_field(const std::string& path, std::size_t vertices, const std::string& mesh_name) {
  Solution field = read_solution(path);
  if (field.tensor) throw FileError({.file = path}, "it has tensors; a field to adapt to is a scalar at each vertex");
  if (field.count() != vertices)
    throw FileError({.file = path}, "it has values at " + std::to_string(field.count()) + " vertices, but " +
                                        mesh_name + " has " + std::to_string(vertices));
  return field;
}

}  // namespace

std::shared_ptr<BackgroundField> read_background(const std::string& mesh_path, const std::string& sol_path,
                                                 bool one_plane) {
  FlatMesh flat = read_mesh(mesh_path);
  const std::string suffix = suffix_of(sol_path);
  const bool of_bl2d = suffix == ".h" || suffix == ".hc" || suffix == ".hg";
  const Solution solution = of_bl2d ? read_bl2d_sizes_text(read_file(sol_path), sol_path)
                                    : read_solution(sol_path, SolutionUse::prescription);
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
  if (flat.dimension == 2 && !one_plane) mesh.faces = std::move(flat.triangle_refs);
  mesh.values = values_of(solution);
  return std::make_shared<BackgroundField>(mesh);
}

std::shared_ptr<BackgroundField> background_of(const Session& session, VertexValues values) {
  return std::make_shared<BackgroundField>(session.mesh(), std::move(values));
}

VertexPrescriptions estimate_on_mesh(Session& session, std::span<const double> values, EstimatorOptions options) {
  const FlatMesh mesh = straight_mesh(session.mesh());
  return estimate({mesh.vertices, mesh.triangles, values}, with_bounds(session, options));
}

VertexPrescriptions estimate_on_mesh(Session& session, const FieldFunction& field, EstimatorOptions options) {
  const FlatMesh mesh = straight_mesh(session.mesh());
  return estimate_function(mesh.vertices, mesh.triangles, field, with_bounds(session, options));
}

AdaptationReport adapt(Session& session, const FieldFunction& field, const AdaptationOptions& options,
                       Monitor& monitor) {
  return Loop(session, field, options, monitor).run();
}

void adapt_by_files(Session& session, Monitor& monitor) {
  Parameters& parameters = session.parameters();
  const std::string mesh_path = parameters.text("adapt_mesh"), sol_path = parameters.text("adapt_sol");
  const std::string out_path = parameters.text("adapt_out");
  if (sol_path.empty()) throw InvalidArgument("call adapt needs a field: the parameter adapt_sol names no file");
  if (parameters.integer("hphy_flag") == 0)
    throw InvalidArgument("an adaptation prescribes physical sizes, but hphy_flag is 0: they would be ignored");
  if (mesh_path.empty() && !session.has_mesh())
    throw InvalidArgument("call adapt needs a mesh: none was made yet, and the parameter adapt_mesh names no file");
  const bool own = mesh_path.empty();
  const FlatMesh flat = own ? flatten(session.mesh(), false) : read_mesh(mesh_path);
  if (flat.triangles.empty()) throw FileError({.file = mesh_path}, "a mesh with a field needs triangles; it has none");
  if (flat.is_quadratic())
    throw InvalidArgument(
        "call adapt: the mesh of the field has elements of second order; a field belongs to the vertices of straight "
        "ones (element p1, q1.0 or q1.1)");
  const Solution field = read_field(sol_path, flat.vertices.size(), own ? "the mesh made last" : mesh_path);
  const VertexPrescriptions wanted =
      estimate({flat.vertices, flat.triangles, field.values}, estimator_of(parameters, flat.vertices));
  const SurfaceMesh from = own ? session.mesh() : surface_of(flat, session.model());
  const NoBackgroundAfterwards afterwards(session);
  if (own) {
    session.set_background(background_of(session, values_on(3, wanted)));
  } else {
    const std::vector<std::int32_t> faces = flat.dimension == 2 ? flat.triangle_refs : std::vector<std::int32_t>{};
    session.set_background(std::make_shared<BackgroundField>(
        BackgroundMesh{flat.dimension, flat.vertices, flat.triangles, faces, values_on(flat.dimension, wanted)}));
  }
  // Lengths of parameter planes say nothing about bounds in space.
  if (flat.dimension == 3) {
    const OpenBounds bounds(parameters, range_of(wanted));
    session.make_mesh();
  } else {
    session.make_mesh();
  }
  if (out_path.empty()) return;
  const TransferredField moved = transfer_field(from, session.mesh(), field.values, 1);
  if (moved.outside > 0)
    monitor.message(Level::warning, std::to_string(moved.outside) + " vertices lie outside of the mesh of the field " +
                                        "and have the nearest value");
  write_solution({.dimension = 3, .tensor = false, .values = moved.values}, out_path);
}

}  // namespace carreau
