// SPDX-License-Identifier: BSD-3-Clause
#include "session/file_adaptation.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <utility>

#include "adapt/transfer.h"
#include "io/files.h"
#include "io/medit/sol_files.h"
#include "io/mesh_files.h"
#include "io/plane/plane_files.h"
#include "mesh/elements/over_nodes.h"
#include "mesh/simplices/simplices.h"
#include "metric/metric2_algebra.h"
#include "metric/metric3_algebra.h"
#include "session/adaptation.h"

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
  options.relative_floor = parameters.real("adapt_floor");
  options.ratio = parameters.real("adapt_ratio");
  options.recovery = choice<Recovery>(parameters, "adapt_recovery", {"fit", "projection", "quadric"});
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

/// Nodes on edges of elements of second order, as faces have them: quadrilaterals come first. Values of these nodes
/// follow the values of all vertices (with_nodes_on_edges()).
void add_elements(const FlatMesh& flat, const std::vector<std::size_t>& first_triangle, const std::vector<char>& chosen,
                  const std::vector<std::int32_t>& mid_of, FaceMesh& face) {
  face.triangles.clear();
  for (const int corners : {4, 3})
    for (std::size_t c = 0; c < flat.cells.size(); ++c) {
      const Cell& cell = flat.cells[c];
      if (corner_count(cell.kind) != corners || chosen[first_triangle[c]] == 0) continue;
      const auto& n = cell.nodes;
      const auto mid = [&](int i) { return mid_of[n[i]]; };
      if (corners == 3) {
        face.triangles.push_back({n[0], n[1], n[2]});
        face.mid.push_back({mid(3), mid(4), mid(5)});
        continue;
      }
      ++face.quads;
      face.triangles.push_back({n[0], n[1], n[2]}), face.triangles.push_back({n[0], n[2], n[3]});
      face.mid.push_back({mid(4), mid(5), -1}), face.mid.push_back({-1, mid(6), mid(7)});
    }
}

/// For each vertex of a file's mesh: its rank among the nodes on edges; -1: not on an edge.
std::vector<std::int32_t> nodes_on_edges(const FlatMesh& flat) {
  std::vector<std::int32_t> rank(flat.vertices.size(), -1);
  if (!flat.is_quadratic()) return rank;
  for (const Cell& cell : flat.cells)
    for (int i = corner_count(cell.kind); i < node_count(cell.kind); ++i) rank[cell.nodes[i]] = 0;
  std::int32_t count = 0;
  for (std::int32_t& r : rank)
    if (r == 0) r = count++;
  return rank;
}

/// Values at the vertices of a file's mesh, followed by copies for the nodes on edges: the order of surface_of().
std::vector<double> with_nodes_on_edges(const FlatMesh& flat, std::vector<double> values, std::size_t components) {
  const std::vector<std::int32_t> rank = nodes_on_edges(flat);
  for (std::size_t v = 0; v < rank.size(); ++v)
    for (std::size_t k = 0; rank[v] >= 0 && k < components; ++k) values.push_back(values[v * components + k]);
  return values;
}

/// A mesh of a file as one whose faces lie in their parameter planes (dimension 2), or in none (space; a plane model,
/// whose parameter planes are one).
SurfaceMesh surface_of(const FlatMesh& flat, const Model& model) {
  SurfaceMesh mesh;
  mesh.vertices = flat.vertices;
  mesh.vertex_ref.assign(flat.vertices.size(), 0);
  FaceMesh whole;
  for (std::size_t v = 0; v < flat.vertices.size(); ++v) {
    whole.uv.push_back({flat.vertices[v].x(), flat.vertices[v].y()});
    whole.vertex.push_back(static_cast<std::int32_t>(v));
  }
  const std::vector<std::int32_t> mid_of = nodes_on_edges(flat);
  std::vector<std::size_t> first_triangle;
  for (std::size_t c = 0, t = 0; flat.is_quadratic() && c < flat.cells.size(); ++c) {
    first_triangle.push_back(t);
    t += corner_count(flat.cells[c].kind) == 4 ? 2 : 1;
  }
  for (std::size_t v = 0; v < mid_of.size(); ++v) {
    if (mid_of[v] < 0) continue;
    whole.mid_uv.push_back(whole.uv[v]), whole.mid_vertex.push_back(mid_of[v]);
    mesh.mid_vertices.push_back(flat.vertices[v]);
  }
  const auto add = [&](FaceMesh face, const std::vector<char>& chosen) {
    for (std::size_t i = 0; i < flat.triangles.size(); ++i)
      if (chosen[i] != 0) face.triangles.push_back(flat.triangles[i]);
    if (flat.is_quadratic()) add_elements(flat, first_triangle, chosen, mid_of, face);
    if (!face.triangles.empty()) mesh.faces.push_back(std::move(face));
  };
  const auto part = [&](int ref, int named) {
    FaceMesh face = whole;
    face.ref = ref;
    std::vector<char> chosen(flat.triangles.size(), 0);
    for (std::size_t i = 0; i < chosen.size(); ++i) chosen[i] = flat.triangle_refs[i] == named ? 1 : 0;
    add(std::move(face), chosen);
  };
  if (flat.dimension == 2 && !model.plane) {
    for (const Face& face : model.faces) {
      const bool named =
          std::find(flat.triangle_refs.begin(), flat.triangle_refs.end(), face.ref) != flat.triangle_refs.end();
      part(face.ref, named ? face.ref : 0);
    }
  } else {  // no face of a model has this reference: looked up in space
    whole.ref = std::numeric_limits<int>::min();
    add(std::move(whole), std::vector<char>(flat.triangles.size(), 1));
  }
  return mesh;
}

/// On parameter planes sizes are lengths of the plane, so they become metrics.
VertexValues values_on(int dimension, const VertexPrescriptions& wanted) {
  if (dimension == 3) return {wanted.sizes, wanted.metrics, {}};
  VertexValues values;
  for (const double h : wanted.sizes) values.parameter.push_back({1 / (h * h), 0, 1 / (h * h)});
  for (const Metric3& m : wanted.metrics) values.parameter.push_back({m.xx, m.xy, m.yy});
  return values;
}

void check_count(const Solution& solution, const std::string& path, std::size_t vertices, const std::string& mesh) {
  if (solution.count() != vertices)
    throw FileError({.file = path}, "it has values at " + std::to_string(solution.count()) + " vertices, but " + mesh +
                                        " has " + std::to_string(vertices));
}

void check_elements(const FlatMesh& mesh, const std::string& path) {
  if (mesh.triangles.empty() && mesh.tetrahedra.empty() && mesh.edges.empty())
    throw FileError({.file = path}, "a background mesh needs triangles, tetrahedra or edges; it has none");
}

/// A mesh that carries fields: of a volume mesh its surface, the triangles of the file or the faces of one tetrahedron.
FlatMesh read_carrier(const std::string& path) {
  FlatMesh mesh = read_mesh(path);
  if (!mesh.triangles.empty() || mesh.tetrahedra.empty()) return mesh;
  mesh.triangles = boundary_of(mesh.vertices, mesh.tetrahedra);
  mesh.triangle_refs.assign(mesh.triangles.size(), 0);
  return mesh;
}

/// Fields are estimated on triangles.
void keep_triangles(FlatMesh& mesh) {
  mesh.tetrahedra.clear();
  mesh.edges.clear();
}

/// Fields of a file at the vertices of a mesh.
Solution read_fields(const std::string& path, const FlatMesh& mesh, const std::string& mesh_name, std::int32_t field = 0) {
  if (mesh.triangles.empty()) throw FileError({.file = mesh_name}, "a mesh with a field needs triangles or tetrahedra; it has none");
  Solution fields = read_solution(path, {SolutionUse::fields, field});
  check_count(fields, path, mesh.vertices.size(), mesh_name);
  return fields;
}

bool is_metric(const Solution& fields) {
  return fields.fields.size() == 1 && fields.fields.front() == ValueType::symmetric;
}

/// Each scalar, and each component of a vector, as a separate field.
std::vector<double> scalars_of(const Solution& fields, const std::string& path) {
  for (const ValueType type : fields.fields)
    if (type == ValueType::symmetric || type == ValueType::full)
      throw FileError({.file = path}, "it has tensors among other fields; a mesh is adapted to scalars and "
                                      "vectors, or to one metric");
  return fields.values;
}

struct EstimatedFields {
  VertexPrescriptions wanted;
  double error = 0, tolerance = 0;
};

EstimatedFields estimate_fields(Session& session, const FlatMesh& mesh, const Solution& fields, const std::string& path) {
  const std::vector<double> values = scalars_of(fields, path);
  const EstimatorOptions options = estimator_of(session.parameters(), mesh.vertices);
  EstimatedFields result{.wanted = {}, .error = 0, .tolerance = options.tolerance};
  session.together([&](const Executor& executor) {
    require_same_values(executor, values, options);
    Monitor& monitor = session.monitor();
    result.wanted = estimate_all(mesh.vertices, mesh.triangles, values, fields.components(), options, executor, &monitor);
    result.error = estimated_error_of_all(mesh.vertices, mesh.triangles, values, fields.components(), options, executor, &monitor);
  });
  return result;
}

std::shared_ptr<BackgroundField> field_of(const FlatMesh& mesh, bool one_plane, VertexValues values) {
  const bool by_face = mesh.dimension == 2 && !one_plane;
  return std::make_shared<BackgroundField>(
      BackgroundMesh{mesh.dimension, mesh.vertices, mesh.triangles,
                     by_face ? mesh.triangle_refs : std::vector<std::int32_t>{}, std::move(values), mesh.tetrahedra,
                     mesh.edges});
}

/// Metrics of a file of fields, checked as prescriptions are. Throws FileError with the line.
VertexValues metrics_of(const std::string& sol_path, int dimension, const std::string& mesh_name, std::int32_t field) {
  const Solution metrics = read_solution(sol_path, {SolutionUse::prescription, field});
  if (metrics.dimension != dimension)
    throw FileError({.file = sol_path}, "its dimension is " + std::to_string(metrics.dimension) + ", but the dimension of " +
                                            mesh_name + " is " + std::to_string(dimension));
  return values_of(metrics);
}

/// The fields in space of another dimension: vectors get or lose z.
Solution in_dimension(const Solution& fields, int dimension, const std::string& path) {
  if (fields.dimension == dimension) return fields;
  Solution result{.dimension = dimension, .tensor = false, .values = {}, .fields = fields.fields};
  const std::size_t width = fields.components();
  for (std::size_t row = 0; row < fields.values.size(); row += width) {
    std::size_t at = row;
    for (const ValueType type : fields.fields) {
      if (type == ValueType::symmetric || type == ValueType::full)
        throw FileError({.file = path}, "it has tensors of dimension " + std::to_string(fields.dimension) +
                                            ", but the new mesh is of dimension " + std::to_string(dimension));
      const std::size_t known = components_of(type, fields.dimension);
      for (std::size_t k = 0; k < components_of(type, dimension); ++k)
        result.values.push_back(k < known ? fields.values[at + k] : 0);
      at += known;
    }
  }
  return result;
}

/// Returns the number of vertices outside. One process of an executor writes. `values`: the values of `fields` at the nodes
/// of `from`.
std::int64_t write_transferred(Session& session, const SurfaceMesh& from, const std::vector<double>& values, const Solution& fields,
                               const std::string& sol_path, const std::string& out_path, const Executor& executor) {
  TransferredField moved = transfer_field(from, session.mesh(), values, fields.components(), executor, &session.monitor());
  if (executor.team != nullptr && executor.team->rank() != 0) return moved.outside;
  Solution result{
      .dimension = fields.dimension, .tensor = false, .values = std::move(moved.values), .fields = fields.fields};
  write_solution(in_dimension(result, session.model().plane ? 2 : 3, sol_path), out_path);
  return moved.outside;
}

Solution read_prescription(const std::string& path, std::int32_t field = 0) {
  const std::string suffix = suffix_of(path);
  if (suffix == ".h" || suffix == ".hc" || suffix == ".hg") return read_bl2d_sizes_text(read_file(path), path);
  return read_solution(path, {SolutionUse::prescription, field});
}

}  // namespace

std::vector<Metric3> read_metrics(const std::string& sol_path, std::size_t vertices) {
  const Solution solution = read_prescription(sol_path);
  check_count(solution, sol_path, vertices, "the mesh");
  std::vector<Metric3> metrics;
  for (std::size_t v = 0; v < vertices; ++v) {
    if (!solution.tensor) {
      metrics.push_back(isotropic_metric3(solution.values[v]));
    } else if (solution.dimension == 3) {
      metrics.push_back(space_tensor(solution, v));
    } else {
      const Metric2 m = plane_tensor(solution, v);
      metrics.push_back({m.a, m.b, 0, m.c, 0, eigen(m).major});
    }
  }
  return metrics;
}

std::shared_ptr<BackgroundField> read_background(const std::string& mesh_path, const std::string& sol_path,
                                                 bool one_plane, std::int32_t field) {
  const FlatMesh flat = straight_over_nodes(read_mesh(mesh_path));
  const Solution solution = read_prescription(sol_path, field);
  check_elements(flat, mesh_path);
  if (solution.dimension != flat.dimension)
    throw FileError({.file = sol_path}, "its dimension is " + std::to_string(solution.dimension) + ", but the dimension of " +
                                            mesh_path + " is " + std::to_string(flat.dimension));
  check_count(solution, sol_path, flat.vertices.size(), mesh_path);
  return field_of(flat, one_plane, values_of(solution));
}

namespace {

std::shared_ptr<BackgroundField> background_of_fields_here(Session& session, const std::string& mesh_path,
                                                           const std::string& sol_path) {
  FlatMesh mesh = straight_over_nodes(read_carrier(mesh_path));
  const bool one_plane = session.model().plane;
  const std::int32_t field = session.parameters().integer("sol_field");
  const Solution fields = read_fields(sol_path, mesh, mesh_path, field);
  if (is_metric(fields)) return field_of(mesh, one_plane, metrics_of(sol_path, mesh.dimension, mesh_path, field));
  const EstimatedFields estimated = estimate_fields(session, mesh, fields, sol_path);
  keep_triangles(mesh);
  std::shared_ptr<BackgroundField> background = field_of(mesh, one_plane, values_on(mesh.dimension, estimated.wanted));
  background->set_estimate(estimated.error, estimated.tolerance);
  return background;
}

}  // namespace

std::shared_ptr<BackgroundField> background_of_fields(Session& session, const std::string& mesh_path,
                                                      const std::string& sol_path) {
  std::shared_ptr<BackgroundField> background;
  session.together([&](const Executor&) { background = background_of_fields_here(session, mesh_path, sol_path); });
  return background;
}

std::int64_t transfer_files(Session& session, const std::string& mesh_path, const std::string& sol_path,
                            const std::string& out_path) {
  std::int64_t outside = 0;
  session.together([&](const Executor& executor) {
    const FlatMesh mesh = read_carrier(mesh_path);
    const Solution fields = read_fields(sol_path, mesh, mesh_path);
    outside = write_transferred(session, surface_of(mesh, session.model()),
                                with_nodes_on_edges(mesh, fields.values, fields.components()), fields, sol_path, out_path, executor);
  });
  return outside;
}

namespace {

/// The input of `call adapt`.
struct Start {
  bool own = false;  ///< the session's mesh
  FlatMesh mesh;     ///< straight, over all nodes
  SurfaceMesh from;  ///< with its elements
  std::vector<double> values;  ///< at the nodes of `from`
  Solution fields;
  std::string sol_path;
};

Start start_of(Session& session) {
  const Parameters& parameters = session.parameters();
  const std::string mesh_path = parameters.text("adapt_mesh");
  Start start;
  start.sol_path = parameters.text("adapt_sol");
  if (start.sol_path.empty()) throw InvalidArgument("call adapt needs a field: the parameter adapt_sol names no file");
  if (parameters.integer("hphy_flag") == 0)
    throw InvalidArgument("an adaptation prescribes physical sizes, but hphy_flag is 0: they would be ignored");
  if (mesh_path.empty() && !session.has_mesh())
    throw InvalidArgument("call adapt needs a mesh: none was made yet, and the parameter adapt_mesh names no file");
  start.own = mesh_path.empty();
  const FlatMesh mesh = start.own ? flatten(session.mesh(), false) : read_carrier(mesh_path);
  start.fields = read_fields(start.sol_path, mesh, start.own ? "the mesh made last" : mesh_path, parameters.integer("sol_field"));
  start.from = start.own ? session.mesh() : surface_of(mesh, session.model());
  start.values = start.own ? start.fields.values : with_nodes_on_edges(mesh, start.fields.values, start.fields.components());
  start.mesh = straight_over_nodes(mesh);
  if (!is_metric(start.fields)) keep_triangles(start.mesh);
  return start;
}

VertexPrescriptions wanted_by(Session& session, const Start& start) {
  if (!is_metric(start.fields)) return estimate_fields(session, start.mesh, start.fields, start.sol_path).wanted;
  VertexPrescriptions wanted;
  wanted.metrics = metrics_of(start.sol_path, 3, "the model", session.parameters().integer("sol_field")).space;
  return wanted;
}

}  // namespace

namespace {

void adapt_by_files(Session& session, const Executor& executor, Monitor& monitor) {
  Parameters& parameters = session.parameters();
  const Start start = start_of(session);
  const std::string out_path = parameters.text("adapt_out");
  const bool plane = session.model().plane;
  const bool in_space = start.own || start.mesh.dimension == 3;
  const NoBackgroundAfterwards afterwards(session);
  if (is_metric(start.fields) && !in_space) {
    session.set_background(field_of(start.mesh, plane, metrics_of(start.sol_path, 2, "its mesh", parameters.integer("sol_field"))));
    session.make_mesh();
  } else {
    const VertexPrescriptions wanted = wanted_by(session, start);
    session.set_background(start.own ? background_of(session, values_on(3, wanted))
                                     : field_of(start.mesh, plane, values_on(start.mesh.dimension, wanted)));
    // Lengths of other parameter planes give no bounds in space.
    std::optional<OpenBounds> bounds;
    if (in_space || plane) bounds.emplace(parameters, range_of(wanted));
    session.make_mesh();
  }
  if (out_path.empty()) return;
  if (const std::int64_t outside =
          write_transferred(session, start.from, start.values, start.fields, start.sol_path, out_path, executor);
      outside > 0)
    monitor.message(Level::warning, std::to_string(outside) + " vertices lie outside of the mesh of the field " +
                                        "and have the nearest value");
}

}  // namespace

void adapt_by_files(Session& session, Monitor& monitor) {
  session.together([&](const Executor& executor) { adapt_by_files(session, executor, monitor); });
}

}  // namespace carreau
