// SPDX-License-Identifier: BSD-3-Clause
// Pieces that are meshed anew, increment by increment.
#include <cmath>

#include "arguments.h"
#include "carreau_remesh.h"
#include "guard.h"

using carreau::FlatMesh;
using carreau::InvalidArgument;
using carreau::Vec2;
using namespace carreau::abi;
namespace variable = carreau::variable;

static_assert(int(variable::Kind::inside) == CARREAU_NODE_INSIDE);
static_assert(int(variable::Kind::free_boundary) == CARREAU_NODE_FREE);
static_assert(int(variable::Kind::imposed) == CARREAU_NODE_IMPOSED);
static_assert(int(variable::Kind::bound) == CARREAU_NODE_BOUND);
static_assert(int(variable::Faithfulness::smooth) == CARREAU_BOUNDARY_SMOOTH);
static_assert(int(variable::Faithfulness::partly) == CARREAU_BOUNDARY_PARTLY);
static_assert(int(variable::Faithfulness::kept) == CARREAU_BOUNDARY_KEPT);
static_assert(int(variable::Faithfulness::as_given) == CARREAU_BOUNDARY_AS_GIVEN);
static_assert(int(carreau::ErrorSource::hessian) + 1 == CARREAU_ERROR_HESSIAN);
static_assert(int(carreau::ErrorSource::curvature) + 1 == CARREAU_ERROR_CURVATURE);
static_assert(int(carreau::ErrorSource::deformation) + 1 == CARREAU_ERROR_DEFORMATION);

namespace {

std::int32_t choice(std::int32_t value, std::int32_t last, const char* name) {
  if (value >= 0 && value <= last) return value;
  throw InvalidArgument("input->" + std::string(name) + " is " + std::to_string(value) +
                        "; it must lie between 0 and " + std::to_string(last));
}

std::vector<Vec2> points_of(const double* xy, std::size_t n) {
  std::vector<Vec2> points;
  points.reserve(n);
  for (std::size_t i = 0; i < n; ++i) points.emplace_back(xy[2 * i], xy[2 * i + 1]);
  return points;
}

void add_piece(const carreau_remesh_input& given, variable::RemeshInput& input) {
  const std::size_t n = count_of(given.vertex_count, "input->vertex_count"),
                    m = count_of(given.triangle_count, "input->triangle_count");
  if (n > 0) required(given.vertices, "input->vertices");
  if (m > 0) required(given.triangles, "input->triangles");
  input.piece.vertices = points_of(given.vertices, n);
  input.piece.triangles.reserve(m);
  for (std::size_t t = 0; t < m; ++t)
    input.piece.triangles.push_back({given.triangles[3 * t], given.triangles[3 * t + 1], given.triangles[3 * t + 2]});
  if (given.displacements != nullptr) input.displacement = points_of(given.displacements, n);
  if (given.damage != nullptr) input.damage.assign(given.damage, given.damage + m);
  if (given.vertex_kinds != nullptr) input.vertex_kinds.assign(given.vertex_kinds, given.vertex_kinds + input.piece.vertices.size());
}

void add_tools(const carreau_remesh_input& given, variable::RemeshInput& input) {
  const std::size_t n = count_of(given.tool_count, "input->tool_count");
  if (n == 0) return;
  required(given.tool_starts, "input->tool_starts"), required(given.tool_points, "input->tool_points");
  for (std::size_t k = 0; k < n; ++k) {
    const std::int64_t first = given.tool_starts[k], last = given.tool_starts[k + 1];
    if (first < 0 || last < first)
      throw InvalidArgument("input->tool_starts does not ascend from 0 at tool " + std::to_string(k) + " (from 0)");
    variable::Tool& tool = input.tools.emplace_back();
    tool.points = points_of(given.tool_points + 2 * first, static_cast<std::size_t>(last - first));
    if (given.tool_radii != nullptr) tool.radii.assign(given.tool_radii + first, given.tool_radii + last);
    tool.closed = given.tool_closed != nullptr && given.tool_closed[k] != 0;
  }
}

/// One field a component of the elements, since kinds differ; one for all nodal components, and one for the component
/// whose error is estimated.
void add_fields(const carreau_remesh_input& given, variable::RemeshInput& input) {
  const std::size_t nodal = count_of(given.nodal_components, "input->nodal_components"),
                    elements = count_of(given.element_components, "input->element_components");
  const std::size_t n = input.piece.vertices.size(), m = input.piece.triangles.size();
  if (nodal > 0) {
    required(given.nodal_values, "input->nodal_values");
    input.fields.push_back({"nodal_values",
                            variable::FieldKind::nodal,
                            given.nodal_components,
                            {given.nodal_values, given.nodal_values + nodal * n}});
  }
  if (elements > 0) required(given.element_values, "input->element_values");
  for (std::size_t c = 0; c < elements; ++c) {
    const std::int32_t kind =
        given.element_kinds != nullptr ? choice(given.element_kinds[c], 1, "element_kinds") : CARREAU_ELEMENT_MEAN;
    variable::RemeshField field{
        "element_values",
        kind == CARREAU_ELEMENT_CONSERVED ? variable::FieldKind::element_conserved : variable::FieldKind::element_mean,
        1,
        {}};
    for (std::size_t t = 0; t < m; ++t) field.values.push_back(given.element_values[elements * t + c]);
    input.fields.push_back(std::move(field));
  }
}

void add_error(const carreau_remesh_input& given, variable::RemeshInput& input) {
  if (choice(given.error_source, 3, "error_source") == CARREAU_ERROR_NONE) return;
  if (given.error_component < 0 || given.error_component >= given.nodal_components)
    throw InvalidArgument("input->error_component is " + std::to_string(given.error_component) + " of " +
                          std::to_string(given.nodal_components) + " nodal components, counted from 0");
  input.estimator.source = static_cast<carreau::ErrorSource>(given.error_source - 1);
  if (given.error_tolerance != 0) input.estimator.tolerance = given.error_tolerance;
  variable::RemeshField field{"error", variable::FieldKind::nodal, 1, {}};
  const auto stride = static_cast<std::size_t>(given.nodal_components);
  for (std::size_t v = 0; v < input.piece.vertices.size(); ++v)
    field.values.push_back(given.nodal_values[stride * v + static_cast<std::size_t>(given.error_component)]);
  input.error_field = static_cast<int>(input.fields.size());
  input.fields.push_back(std::move(field));
}

void add_options(const carreau_remesh_input& given, variable::RemeshInput& input) {
  input.h_min = given.h_min, input.h_max = given.h_max, input.step = given.step;
  if (choice(given.has_reach, 1, "has_reach") != 0) {
    if (!(given.reach >= 0)) throw InvalidArgument("input->reach is negative or not a number");
    input.reach = given.reach;
  }
  const auto unless_zero = [](double& option, double value) {
    if (value != 0) option = value;
  };
  unless_zero(input.damage_limit, given.damage_limit), unless_zero(input.gradation, given.gradation);
  unless_zero(input.corner_angle, given.corner_angle), unless_zero(input.curvature_angle, given.curvature_angle);
  const std::int32_t curves = choice(given.curves, 2, "curves");
  input.smoothness = curves == CARREAU_SPLINE_TANGENT   ? variable::Smoothness::tangent
                     : curves == CARREAU_SPLINE_NATURAL ? variable::Smoothness::natural
                                                        : variable::Smoothness::polygon;
  input.imposed_smoothing = choice(given.imposed_smoothing, 1000, "imposed_smoothing");
  input.keep_all_parts = choice(given.keep_all_parts, 1, "keep_all_parts") != 0;
  input.remove_overlaps = choice(given.remove_overlaps, 1, "remove_overlaps") != 0;
  input.sizes_by_damage = choice(given.no_damage_sizes, 1, "no_damage_sizes") == 0;
  if (given.max_triangles < 0) throw InvalidArgument("input->max_triangles is negative");
  if (given.max_triangles > 0) input.max_triangles = given.max_triangles;
}

variable::RemeshInput input_of(const carreau_remesh_input& given) {
  variable::RemeshInput input;
  add_options(given, input);
  add_piece(given, input);
  add_tools(given, input);
  add_fields(given, input);
  add_error(given, input);
  return input;
}

FlatMesh flat_of(const variable::RemeshResult& result) {
  FlatMesh flat;
  flat.dimension = 2;
  flat.vertices = variable::in_space(result.piece.vertices);
  flat.vertex_refs = result.vertex_kinds;
  flat.triangles = result.piece.triangles;
  for (const std::int32_t part : result.parts) flat.triangle_refs.push_back(part + 1);
  flat.edges = result.edges;
  flat.edge_refs = result.edge_kinds;
  return flat;
}

RemeshedFields fields_of(const carreau_remesh_input& given, variable::RemeshResult& result) {
  RemeshedFields fields;
  fields.damage = std::move(result.damage);
  std::size_t next = 0;
  if (given.nodal_components > 0) fields.nodal = std::move(result.fields[next++].values);
  fields.nodal_components = given.nodal_components;
  const auto n = static_cast<std::size_t>(given.element_components), m = result.piece.triangles.size();
  fields.elements.resize(n * m);
  for (std::size_t c = 0; c < n; ++c)
    for (std::size_t t = 0; t < m; ++t) fields.elements[n * t + c] = result.fields[next + c].values[t];
  fields.element_components = given.element_components;
  return fields;
}

carreau_remesh_summary summary_of(const variable::RemeshResult& result) {
  const variable::RemeshSummary& told = result.summary;
  carreau_remesh_summary s{};
  s.vertices = std::int64_t(result.piece.vertices.size()), s.triangles = std::int64_t(result.piece.triangles.size());
  s.boundary_edges = std::int64_t(result.edges.size());
  s.bound_vertices = told.bound_vertices, s.free_vertices = told.free_vertices;
  s.imposed_vertices = told.imposed_vertices;
  s.removed_damaged = told.damaged, s.removed_multiple = told.at_multiple_vertices;
  s.removed_dangling = told.dangling, s.removed_parts = told.in_parts;
  s.removed_overlapping = told.overlapping;
  s.parts_found = told.parts_found, s.parts_kept = told.parts_kept;
  s.boundary = int(told.boundary);
  s.area_given = told.area_given, s.area_removed = told.area_removed, s.area_bound = told.area_bound;
  s.area_geometry = told.area_geometry, s.area = told.area;
  return s;
}

const RemeshedFields& remeshed(const carreau_mesh& mesh) {
  if (mesh.session == nullptr && mesh.remeshed.has_value()) return *mesh.remeshed;
  throw StatusError(CARREAU_ERR_SEQUENCE, "the mesh is not a result of carreau_remesh");
}

void copy_rows(const std::vector<double>& values, std::size_t rows, std::int64_t capacity, const char* what,
               double* out) {
  check_capacity(capacity, rows, what);
  if (!values.empty()) std::copy(values.begin(), values.end(), required(out, "out_values"));
}

}  // namespace

carreau_status carreau_remesh(carreau_mesh* mesh, const carreau_remesh_input* input,
                              carreau_remesh_summary* out_summary) {
  return guarded(mesh, [&] {
    const carreau_remesh_input known = read_struct(input, "input");
    if (mesh->session != nullptr)
      throw InvalidArgument("the mesh of a session cannot be replaced: use carreau_mesh_create");
    carreau::Monitor monitor;
    variable::RemeshResult result = variable::remesh(input_of(known), monitor);
    const carreau_remesh_summary summary = summary_of(result);
    FlatMesh flat = flat_of(result);
    RemeshedFields fields = fields_of(known, result);
    auto faces = faces_of(flat);
    if (out_summary != nullptr) write_struct(summary, out_summary, "out_summary");
    mesh->flat_faces = std::move(faces);
    mesh->flat = std::move(flat);
    mesh->corner_uv.clear();
    mesh->filled = true;
    mesh->part.reset();
    mesh->remeshed = std::move(fields);
  });
}

carreau_status carreau_remesh_nodal_values(carreau_mesh* mesh, int64_t capacity, double out_values[]) {
  return guarded(mesh, [&] {
    const RemeshedFields& fields = remeshed(*mesh);
    copy_rows(fields.nodal, mesh->flat.vertices.size(), capacity, "vertices", out_values);
  });
}

carreau_status carreau_remesh_element_values(carreau_mesh* mesh, int64_t capacity, double out_values[]) {
  return guarded(mesh, [&] {
    const RemeshedFields& fields = remeshed(*mesh);
    copy_rows(fields.elements, mesh->flat.triangles.size(), capacity, "triangles", out_values);
  });
}

carreau_status carreau_remesh_damage(carreau_mesh* mesh, int64_t capacity, double out_damage[]) {
  return guarded(mesh, [&] {
    const RemeshedFields& fields = remeshed(*mesh);
    if (fields.damage.empty()) throw StatusError(CARREAU_ERR_SEQUENCE, "carreau_remesh was given no damage");
    copy_rows(fields.damage, mesh->flat.triangles.size(), capacity, "triangles", out_damage);
  });
}

carreau_status carreau_mesh_add_field(carreau_mesh* mesh, const char* name, int32_t on_vertices, int32_t components,
                                      const double values[]) {
  return guarded(mesh, [&] {
    required(name, "name"), required(values, "values");
    if (mesh->session != nullptr) throw InvalidArgument("the mesh of a session takes no field");
    if (!mesh->filled) throw StatusError(CARREAU_ERR_SEQUENCE, "the mesh is empty");
    if (*name == '\0') throw InvalidArgument("the name of the field is empty");
    if (components < 1 || components > 1000)
      throw InvalidArgument("the field has " + std::to_string(components) + " components; there must be 1 to 1000");
    const std::size_t rows = on_vertices != 0 ? mesh->flat.vertices.size() : mesh->flat.triangles.size();
    carreau::MeshField field{.name = name, .on_vertices = on_vertices != 0, .components = components, .values = {}};
    field.values.assign(values, values + rows * static_cast<std::size_t>(components));
    std::erase_if(mesh->flat.fields, [&](const carreau::MeshField& other) {
      return other.name == field.name && other.on_vertices == field.on_vertices;
    });
    mesh->flat.fields.push_back(std::move(field));
  });
}
