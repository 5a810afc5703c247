// SPDX-License-Identifier: BSD-3-Clause
#include "session/adaptation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "arguments.h"
#include "guard.h"
#include "metric/metric3_algebra.h"
#include "session/file_adaptation.h"

using carreau::EstimatorOptions;
using carreau::FieldFunction;
using carreau::InvalidArgument;
using carreau::Metric2;
using carreau::Metric3;
using carreau::SurfaceMesh;
using carreau::Vec3;
using carreau::VertexPrescriptions;
using carreau::VertexValues;
using namespace carreau::abi;

static_assert(int(carreau::ErrorSource::hessian) == CARREAU_HESSIAN);
static_assert(int(carreau::ErrorSource::curvature) == CARREAU_CURVATURE);
static_assert(int(carreau::ErrorSource::deformation) == CARREAU_DEFORMATION);
static_assert(int(carreau::Recovery::fit) == CARREAU_FIT);
static_assert(int(carreau::Recovery::projection) == CARREAU_PROJECTION);
static_assert(int(carreau::Recovery::quadric) == CARREAU_QUADRIC);
static_assert(int(carreau::ErrorShape::isotropic) == CARREAU_ISOTROPIC);
static_assert(int(carreau::ErrorShape::graph) == CARREAU_GRAPH);
static_assert(int(carreau::ErrorShape::anisotropic) == CARREAU_ANISOTROPIC);

namespace {

constexpr std::int64_t largest_count = std::numeric_limits<std::int32_t>::max();

/// Order of the interface: xx xy xz yy yz zz.
Metric3 metric_of(const double* m) { return {m[0], m[1], m[2], m[3], m[4], m[5]}; }

std::vector<Metric3> metrics_of(const double* values, std::size_t n) {
  std::vector<Metric3> metrics;
  metrics.reserve(n);
  for (std::size_t i = 0; i < n; ++i) metrics.push_back(metric_of(values + 6 * i));
  return metrics;
}

const SurfaceMesh& mesh_of(const carreau_session& handle) {
  if (!handle.session.has_mesh()) throw StatusError(CARREAU_ERR_SEQUENCE, "there is no mesh yet");
  return handle.session.mesh();
}

/// Throws unless `n` is the number of nodes or the number of corners of the mesh.
std::size_t checked_nodes(std::int64_t n, const SurfaceMesh& mesh, const char* which) {
  const std::size_t nodes = carreau::node_count(mesh), corners = mesh.vertices.size();
  if (n >= 0 && (std::uint64_t(n) == nodes || std::uint64_t(n) == corners)) return static_cast<std::size_t>(n);
  throw InvalidArgument("there are " + std::to_string(n) + " rows, but the " + which + " has " + std::to_string(corners) +
                        (nodes == corners ? " vertices"
                                          : " corners, and " + std::to_string(nodes) + " nodes with those on edges"));
}

std::size_t checked_count(std::int64_t n, const char* name) {
  if (n >= 0 && n <= largest_count) return static_cast<std::size_t>(n);
  throw InvalidArgument(std::string(name) + " is " + std::to_string(n) + "; it must lie between 0 and " +
                        std::to_string(largest_count));
}

/// `count` rows of N indices, member `name` of the struct.
template <std::size_t N>
std::vector<std::array<std::int32_t, N>> elements_of(const std::int32_t* rows, std::int64_t count, const char* each,
                                                     const char* name) {
  const std::size_t n = checked_count(count, (std::string("background->") + each + "_count").c_str());
  if (n > 0) required(rows, (std::string("background->") + name).c_str());
  std::vector<std::array<std::int32_t, N>> elements(n);
  for (std::size_t i = 0; i < n; ++i) std::copy_n(rows + N * i, N, elements[i].begin());
  return elements;
}

carreau::BackgroundMesh background_mesh(const carreau_background& given) {
  carreau::BackgroundMesh mesh;
  mesh.dimension = given.dimension;
  if (given.dimension != 2 && given.dimension != 3)
    throw InvalidArgument("background->dimension is " + std::to_string(given.dimension) + "; it must be 2 or 3");
  const std::size_t n = checked_count(given.vertex_count, "background->vertex_count");
  const std::size_t m = checked_count(given.triangle_count, "background->triangle_count");
  mesh.triangles = elements_of<3>(given.triangles, given.triangle_count, "triangle", "triangles");
  mesh.tetrahedra = elements_of<4>(given.tetrahedra, given.tetrahedron_count, "tetrahedron", "tetrahedra");
  mesh.edges = elements_of<2>(given.edges, given.edge_count, "edge", "edges");
  if ((given.sizes != nullptr) == (given.metrics != nullptr))
    throw InvalidArgument(
        "a background mesh has either sizes or metrics: one of background->sizes and "
        "background->metrics must be NULL, the other not");
  if (n > 0) required(given.vertices, "background->vertices");
  const auto width = static_cast<std::size_t>(given.dimension);
  for (std::size_t i = 0; i < n; ++i) {
    const double* p = given.vertices + width * i;
    mesh.vertices.push_back({p[0], p[1], width == 3 ? p[2] : 0});
  }
  if (given.faces != nullptr) {
    if (width == 3) throw InvalidArgument("background->faces is for meshes of dimension 2 only");
    mesh.faces.assign(given.faces, given.faces + m);
  }
  if (given.sizes != nullptr) {
    mesh.values.sizes.assign(given.sizes, given.sizes + n);
  } else if (width == 3) {
    mesh.values.space = metrics_of(given.metrics, n);
  } else {
    for (std::size_t i = 0; i < n; ++i)
      mesh.values.parameter.push_back(
          Metric2{given.metrics[3 * i], given.metrics[3 * i + 1], given.metrics[3 * i + 2]});
  }
  return mesh;
}

void check_choice(const char* name, std::int32_t value) {
  if (value < 0 || value > 2)
    throw InvalidArgument(std::string(name) + " is " + std::to_string(value) + "; it must be 0, 1 or 2");
}

EstimatorOptions options_of(const carreau_estimator* estimator) {
  const carreau_estimator known = read_struct(estimator, "estimator");
  check_choice("estimator->source", known.source);
  check_choice("estimator->shape", known.shape);
  EstimatorOptions options;
  options.source = static_cast<carreau::ErrorSource>(known.source);
  options.shape = static_cast<carreau::ErrorShape>(known.shape);
  options.relative = known.relative != 0;
  if (known.recovery < 0 || known.recovery > 2)
    throw InvalidArgument("estimator->recovery is " + std::to_string(known.recovery) + "; it must be 0, 1 or 2");
  options.recovery = static_cast<carreau::Recovery>(known.recovery);
  if (known.tolerance != 0) options.tolerance = known.tolerance;
  if (known.relative_floor != 0) options.relative_floor = known.relative_floor;
  if (known.ratio != 0) options.ratio = known.ratio;
  options.hmin = known.hmin;
  options.hmax = known.hmax;
  return options;
}

/// Positions as plain numbers: the callback's form.
FieldFunction function_of(carreau_field_fn field, void* user, const carreau::Monitor& monitor) {
  return [field, user, &monitor](std::span<const Vec3> points, std::span<double> values) {
    std::vector<double> xyz;
    constexpr std::size_t batch = 4096;
    for (std::size_t from = 0; from < points.size(); from += batch) {
      const std::size_t n = std::min(batch, points.size() - from);
      xyz.clear();
      for (const Vec3& p : points.subspan(from, n)) xyz.insert(xyz.end(), {p.x(), p.y(), p.z()});
      const std::int32_t status = field(std::int64_t(n), xyz.data(), values.data() + from, user);
      if (monitor.stop_requested()) throw carreau::Cancelled("stopped by the host");
      if (status != 0)
        throw carreau::CallbackError({}, "the callback of the field returned the status " + std::to_string(status));
    }
  };
}

/// In place of an earlier one, and of sizes at the points of a plane domain: those are for its first mesh.
void use_background(carreau_session& session, std::shared_ptr<carreau::BackgroundField> background) {
  session.session.set_background(std::move(background));
  session.session.set_prescription_source(nullptr);
}

}  // namespace

carreau_status carreau_set_background_mesh(carreau_session* session, const char* mesh_path, const char* sol_path) {
  return guarded(session, [&] {
    use_background(*session, carreau::read_background(required(mesh_path, "mesh_path"), required(sol_path, "sol_path"),
                                                      session->model().plane,
                                                      session->session.parameters().integer("sol_field")));
  });
}

carreau_status carreau_set_background(carreau_session* session, const carreau_background* background) {
  return guarded(session, [&] {
    use_background(*session,
                   std::make_shared<carreau::BackgroundField>(background_mesh(read_struct(background, "background"))));
  });
}

carreau_status carreau_set_vertex_sizes(carreau_session* session, int64_t n, const double* sizes) {
  return guarded(session, [&] {
    const std::size_t rows = checked_nodes(n, mesh_of(*session), "mesh");
    required(sizes, "sizes");
    use_background(*session, carreau::background_of(session->session,
                                                    {.sizes = {sizes, sizes + rows}, .space = {}, .parameter = {}}));
  });
}

carreau_status carreau_set_vertex_metrics(carreau_session* session, int64_t n, const double* metrics) {
  return guarded(session, [&] {
    const std::size_t rows = checked_nodes(n, mesh_of(*session), "mesh");
    use_background(
        *session,
        carreau::background_of(
            session->session, {.sizes = {}, .space = metrics_of(required(metrics, "metrics"), rows), .parameter = {}}));
  });
}

carreau_status carreau_add_attractor(carreau_session* session, int64_t vertex_count, const double* vertices,
                                     int64_t element_count, const int32_t* elements, double size, double surrounding,
                                     double reach) {
  return guarded(session, [&] {
    carreau::Attractor attractor{.vertices = {}, .elements = {}, .size = size, .surrounding = surrounding, .reach = reach};
    const std::size_t n = checked_count(vertex_count, "vertex_count"), m = checked_count(element_count, "element_count");
    if (n > 0) required(vertices, "vertices");
    for (std::size_t i = 0; i < n; ++i) attractor.vertices.push_back({vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]});
    if (m > 0) required(elements, "elements");
    attractor.elements.resize(m);
    for (std::size_t i = 0; i < m; ++i) std::copy_n(elements + 3 * i, 3, attractor.elements[i].begin());
    session->session.add_attractor(attractor);
  });
}

carreau_status carreau_clear_attractors(carreau_session* session) {
  return guarded(session, [&] { session->session.clear_attractors(); });
}

carreau_status carreau_add_layers(carreau_session* session, int64_t curve_count, const int32_t* curves, double first,
                                  double ratio, int32_t count) {
  return guarded(session, [&] {
    const std::size_t n = checked_count(curve_count, "curve_count");
    if (n > 0) required(curves, "curves");
    session->session.add_layers({.curves = {curves, curves + n}, .first = first, .ratio = ratio, .count = count});
  });
}

carreau_status carreau_clear_layers(carreau_session* session) {
  return guarded(session, [&] { session->session.clear_layers(); });
}

carreau_status carreau_session_layers(carreau_session* session, int64_t index, carreau_layers_report* out_report) {
  return guarded(session, [&] {
    mesh_of(*session);
    const std::vector<carreau::LayerFigures>& all = session->session.layer_figures();
    if (index < 0 || static_cast<std::size_t>(index) >= all.size())
      throw InvalidArgument("index is " + std::to_string(index) + ", but the mesh has " + std::to_string(all.size()) + " sets of layers");
    const carreau::LayerFigures& figures = all[static_cast<std::size_t>(index)];
    carreau_layers_report result{};
    result.cells = figures.cells;
    result.rows = figures.rows, result.fewest_rows = figures.fewest_rows;
    result.first_min = figures.first_min, result.first_mean = figures.first_mean, result.first_max = figures.first_max;
    result.growth_min = figures.growth_min, result.growth_mean = figures.growth_mean, result.growth_max = figures.growth_max;
    write_struct(result, out_report, "out_report");
  });
}

carreau_status carreau_clear_background(carreau_session* session) {
  return guarded(session, [&] { session->session.set_background(nullptr); });
}

carreau_status carreau_session_background(carreau_session* session, carreau_background_report* out_report) {
  return guarded(session, [&] {
    mesh_of(*session);
    const carreau::BackgroundReport& report = session->session.background_report();
    carreau_background_report result{};
    result.asked = report.asked;
    result.outside = report.outside;
    result.farthest = report.farthest;
    result.estimated_error = report.estimated_error;
    result.tolerance = report.tolerance;
    write_struct(result, out_report, "out_report");
  });
}

carreau_status carreau_estimate(carreau_session* session, const carreau_estimator* estimator, int64_t n,
                                const double* values, double* out_sizes, double* out_metrics) {
  return guarded(session, [&] {
    const std::size_t rows = checked_nodes(n, mesh_of(*session), "mesh");
    const EstimatorOptions options = options_of(estimator);
    if (out_sizes == nullptr && out_metrics == nullptr)
      throw InvalidArgument("out_sizes and out_metrics are both NULL: the result has no place");
    if (options.shape != carreau::ErrorShape::isotropic && out_metrics == nullptr)
      throw InvalidArgument("the shape of the estimator gives metrics, but out_metrics is NULL");
    session->monitor.begin_run();
    const VertexPrescriptions wanted =
        carreau::estimate_on_mesh(session->session, std::span(required(values, "values"), rows), options);
    for (std::size_t v = 0; v < rows; ++v) {
      const bool sized = !wanted.sizes.empty();
      const Metric3 m = sized ? carreau::isotropic_metric3(wanted.sizes[v]) : wanted.metrics[v];
      if (out_metrics != nullptr) {
        const std::array<double, 6> row{m.xx, m.xy, m.xz, m.yy, m.yz, m.zz};
        std::copy(row.begin(), row.end(), out_metrics + 6 * v);
      }
      if (out_sizes != nullptr) out_sizes[v] = sized ? wanted.sizes[v] : 1 / std::sqrt(carreau::eigen(m).value[0]);
    }
  });
}

carreau_status carreau_transfer(carreau_session* session, int32_t components, int64_t n, const double* values,
                                int64_t capacity, double* out_values, int64_t* out_outside) {
  return guarded(session, [&] {
    const SurfaceMesh& to = mesh_of(*session);
    if (!session->session.has_previous_mesh())
      throw StatusError(CARREAU_ERR_SEQUENCE, "there is no mesh before this one: fields are transferred from it");
    const SurfaceMesh& from = session->session.previous_mesh();
    const std::size_t rows = checked_nodes(n, from, "mesh before this one");
    if (components < 1)
      throw InvalidArgument("components is " + std::to_string(components) + "; a field has one component at least");
    check_capacity(capacity, rows == carreau::node_count(from) ? carreau::node_count(to) : to.vertices.size(), "nodes");
    required(out_values, "out_values");
    const auto width = static_cast<std::size_t>(components);
    const std::span<const double> given(required(values, "values"), rows * width);
    carreau::TransferredField result;
    session->monitor.begin_run();
    session->session.together([&](const carreau::Executor& executor) {
      carreau::require_same_values(executor, given, {});
      result = carreau::transfer_field(from, to, given, width, executor, &session->monitor);
    });
    std::copy(result.values.begin(), result.values.end(), out_values);
    if (out_outside != nullptr) *out_outside = result.outside;
  });
}

carreau_status carreau_set_background_fields(carreau_session* session, const char* mesh_path, const char* sol_path) {
  return guarded(session, [&] {
    required(mesh_path, "mesh_path");
    required(sol_path, "sol_path");
    session->monitor.begin_run();
    session->commit_model();
    use_background(*session, carreau::background_of_fields(session->session, mesh_path, sol_path));
  });
}

carreau_status carreau_transfer_files(carreau_session* session, const char* mesh_path, const char* sol_path,
                                      const char* out_path, int64_t* out_outside) {
  return guarded(session, [&] {
    mesh_of(*session);
    session->monitor.begin_run();
    const std::int64_t outside =
        carreau::transfer_files(session->session, required(mesh_path, "mesh_path"), required(sol_path, "sol_path"),
                                required(out_path, "out_path"));
    if (out_outside != nullptr) *out_outside = outside;
  });
}

carreau_status carreau_adapt(carreau_session* session, const carreau_adaptation* adaptation,
                             carreau_adaptation_report* out_report) {
  return guarded(session, [&] {
    const carreau_adaptation known = read_struct(adaptation, "adaptation");
    carreau_adaptation_report result{};
    if (out_report != nullptr) write_struct(result, out_report, "out_report");  // a wrong size is found before the work
    if (!session->has_cad)
      throw StatusError(CARREAU_ERR_SEQUENCE,
                        "no geometry is registered: call carreau_set_cad or carreau_set_cad_m first");
    if (session->model().faces.empty()) throw StatusError(CARREAU_ERR_SEQUENCE, "the model has no face yet");
    carreau::AdaptationOptions options;
    options.estimator = options_of(known.estimator);
    options.differences = known.differences != 0;
    if (known.iterations != 0) options.iterations = known.iterations;
    options.convergence = known.convergence;
    const FieldFunction field = function_of(required(known.field, "adaptation->field"), known.user, session->monitor);
    session->monitor.begin_run();
    session->commit_model();
    const carreau::AdaptationReport report = carreau::adapt(session->session, field, options, session->monitor);
    const carreau::AdaptationStep &first = report.steps.front(), &best = report.steps[report.best];
    result.iterations = std::int32_t(report.steps.size()) - 1;
    result.converged = report.converged ? 1 : 0;
    result.vertices = best.vertices;
    result.triangles = best.triangles;
    result.triangles_before = first.triangles;
    result.error_max = best.error.largest;
    result.error_rms = best.error.rms;
    result.error_max_before = first.error.largest;
    result.error_rms_before = first.error.rms;
    result.size_min = best.smallest_size;
    result.stretch_max = best.largest_stretch;
    result.outside = best.background.outside;
    result.best = std::int32_t(report.best);
    result.tolerance = options.estimator.tolerance;
    result.within = report.within(result.tolerance) ? 1 : 0;
    result.estimated_error = best.estimate;
    if (out_report != nullptr) write_struct(result, out_report, "out_report");
    report_failed_faces(session->session);
  });
}
