// SPDX-License-Identifier: BSD-3-Clause
#include "io/mesh_files.h"

#include <cmath>
#include <cstdint>
#include <filesystem>

#include "io/files.h"
#include "io/mesh_writers.h"
#include "io/bl2d_steps.h"
#include "support/error.h"

namespace carreau {

namespace {

FlatMesh read_medit(std::string_view content, const std::string& name) {
  return starts_as_gmf(content) ? read_mesh_binary(content, name) : read_mesh_text(content, name);
}

struct Format {
  const char* suffix;
  MeshFormat format;
  FlatMesh (*read)(std::string_view content, const std::string& name);
  bool writes = true;
};
constexpr Format formats[] = {{".mesh", MeshFormat::mesh, read_medit},     {".meshb", MeshFormat::meshb, read_medit},
                              {".vtu", MeshFormat::vtu, read_mesh_vtu},    {".stl", MeshFormat::stl, read_mesh_stl},
                              {".msh", MeshFormat::msh, read_mesh_msh},    {".msh2", MeshFormat::msh2, read_mesh_msh},
                              {".bl2d", MeshFormat::bl2d, read_mesh_bl2d}, {".inp", MeshFormat::inp, read_mesh_inp},
                              {".bdf", MeshFormat::bdf, read_mesh_bdf},    {".unv", MeshFormat::unv, read_mesh_unv},
                              {".su2", MeshFormat::su2, read_mesh_su2},    {".off", MeshFormat::off, read_mesh_off},
                              {".obj", MeshFormat::obj, read_mesh_obj},    {".ply", MeshFormat::ply, read_mesh_ply},
                              {".vtk", MeshFormat::vtk, read_mesh_vtk},    {".tri", MeshFormat::tri, read_mesh_tri},
                              {".smesh", MeshFormat::smesh, nullptr},      {".poly", MeshFormat::poly, nullptr},
                              {".vol", MeshFormat::vol, nullptr},          {".geo", MeshFormat::geo, nullptr},
                              {".smo", MeshFormat::bl2d, read_mesh_smo, false}, {".mc", MeshFormat::bl2d, read_mesh_smo, false},
                              {".ms", MeshFormat::bl2d, read_mesh_ms, false}};

/// The format of a name's suffix. Throws InvalidArgument.
const Format& known_format(const std::string& path, bool reading) {
  const std::string suffix = suffix_of(path);
  std::string known;
  for (const Format& format : formats) {
    if (reading ? format.read == nullptr : !format.writes) continue;
    if (suffix == format.suffix) return format;
    known.append(known.empty() ? "" : ", ").append(format.suffix);
  }
  throw InvalidArgument("'" + path + "' does not have a suffix of mesh files: " + known);
}

void check_length(const char* what, std::size_t found, std::size_t expected) {
  if (found != expected)
    throw InvalidArgument("a mesh cannot be written: " + std::string(what) + " has " + std::to_string(found) +
                          " entries instead of " + std::to_string(expected));
}

void check_refs(const char* what, const std::vector<std::int32_t>& refs, std::size_t expected) {
  if (!refs.empty()) check_length(what, refs.size(), expected);
}

/// `who()`: the thing that names the vertex.
template <typename Who>
void check_vertex(std::int32_t vertex, std::size_t vertices, const Who& who) {
  if (vertex < 0 || static_cast<std::size_t>(vertex) >= vertices)
    throw InvalidArgument("a mesh cannot be written: " + who() + " names vertex " + std::to_string(vertex) + " of " + std::to_string(vertices));
}

template <std::size_t N>
void check_indices(const char* what, const std::vector<std::array<std::int32_t, N>>& entities, std::size_t vertices) {
  for (std::size_t i = 0; i < entities.size(); ++i)
    for (const std::int32_t vertex : entities[i]) check_vertex(vertex, vertices, [&] { return what + (" " + std::to_string(i)) + " (from 0)"; });
}

// Elements and triangles are one surface.
void check_cells(const FlatMesh& mesh) {
  std::size_t t = 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const Cell& cell = mesh.cells[c];
    t += corner_count(cell.kind) == 4 ? 2 : 1;
    for (int i = 0; i < node_count(cell.kind); ++i)
      check_vertex(cell.nodes[i], mesh.vertices.size(), [&] { return "element " + std::to_string(c) + " (from 0)"; });
  }
  if (!mesh.cells.empty()) check_length("the list of triangles", mesh.triangles.size(), t);
  if (!mesh.edge_mids.empty()) check_length("the list of nodes on edges", mesh.edge_mids.size(), mesh.edges.size());
  for (const std::int32_t v : mesh.edge_mids) check_vertex(v, mesh.vertices.size(), [] { return std::string("an edge"); });
}

void check_field(const MeshField& field, const FlatMesh& mesh) {
  if (field.components < 1)
    throw InvalidArgument("a mesh cannot be written: field '" + field.name + "' has " +
                          std::to_string(field.components) + " components");
  const std::string what = "field '" + field.name + "'";
  const auto components = static_cast<std::size_t>(field.components);
  if (!field.edge_values.empty())
    check_length((what + " of edges").c_str(), field.edge_values.size(),
                 field.on_vertices ? 0 : mesh.edges.size() * components);
  if (field.values.empty() && !field.edge_values.empty()) return;
  check_length(what.c_str(), field.values.size(),
               (field.on_vertices ? mesh.vertices.size() : mesh.triangles.size()) * components);
}

// Formats and programs that read them count by 32 bits.
void check_count(const char* what, std::size_t count) {
  if (count > INT32_MAX)
    throw InvalidArgument("a mesh cannot be written: it has " + std::to_string(count) + " " + what +
                          ", more than 2147483647");
}

void check_mesh(const FlatMesh& mesh) {
  check_count("vertices", mesh.vertices.size() + mesh.cells.size());  // of quadrilaterals of second order their centres
  check_count("triangles", mesh.triangles.size());
  check_count("edges", mesh.edges.size());
  if (mesh.dimension != 2 && mesh.dimension != 3)
    throw InvalidArgument("a mesh cannot be written: its dimension is " + std::to_string(mesh.dimension));
  check_refs("the list of vertex references", mesh.vertex_refs, mesh.vertices.size());
  check_refs("the list of edge references", mesh.edge_refs, mesh.edges.size());
  check_refs("the list of triangle references", mesh.triangle_refs, mesh.triangles.size());
  check_cells(mesh);
  check_indices("edge", mesh.edges, mesh.vertices.size());
  check_indices("triangle", mesh.triangles, mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    if (!is_finite(mesh.vertices[i]))
      throw InvalidArgument("a mesh cannot be written: vertex " + std::to_string(i) +
                            " (from 0) has a coordinate that is not finite");
  for (const MeshField& field : mesh.fields) check_field(field, mesh);
}

}  // namespace

MeshFormat mesh_format_of(const std::string& path) { return known_format(path, false).format; }

std::string mesh_bytes(const FlatMesh& mesh, MeshFormat format, const MeshFileOptions& options) {
  check_mesh(mesh);
  switch (format) {
    case MeshFormat::mesh:
      return medit_text(mesh, options.association);
    case MeshFormat::meshb:
      return gmf_bytes(mesh, gmf_needs_64_bits(mesh, options.association) ? 3 : 2, options.association);
    case MeshFormat::vtu:
      return vtu_bytes(mesh, options.association);
    case MeshFormat::stl:
      return options.ascii_stl ? stl_text(mesh) : stl_bytes(mesh);
    case MeshFormat::msh:
      return msh_text(mesh, false, options.curve_groups, options.association);
    case MeshFormat::msh2:
      return msh_text(mesh, true, options.curve_groups, options.association);
    case MeshFormat::bl2d:
      return bl2d_text(mesh);
    case MeshFormat::inp:
      return inp_text(mesh);
    case MeshFormat::bdf:
      return bdf_text(mesh);
    case MeshFormat::unv:
      return unv_text(mesh);
    case MeshFormat::su2:
      return su2_text(mesh);
    case MeshFormat::off:
      return off_text(mesh);
    case MeshFormat::obj:
      return obj_text(mesh);
    case MeshFormat::ply:
      return ply_bytes(mesh);
    case MeshFormat::vtk:
      return vtk_text(mesh, options.ascii_stl);
    case MeshFormat::tri:
      return tri_text(mesh);
    case MeshFormat::smesh:
    case MeshFormat::poly:
      return tetgen_text(mesh, format == MeshFormat::poly);
    case MeshFormat::vol:
      return netgen_text(mesh);
    case MeshFormat::geo:
      return geo_text(mesh, options.surface);
  }
  throw InvalidArgument("unknown mesh format " + std::to_string(static_cast<int>(format)));
}

void write_mesh(const FlatMesh& mesh, const std::string& path, MeshFormat format, const MeshFileOptions& options) {
  if (format == MeshFormat::geo) {
    MeshFileOptions beside = options;
    beside.surface = std::filesystem::path(path).stem().string() + ".msh";
    return write_file(path, mesh_bytes(mesh, format, beside));
  }
  if (format != MeshFormat::meshb && format != MeshFormat::vtu)
    return write_file(path, mesh_bytes(mesh, format, options));
  check_mesh(mesh);
  NewFile file(path);
  std::uint64_t at = 0;
  const auto write = [&](std::string_view block) {
    file.write_at(at, block);
    at += block.size();
  };
  if (format == MeshFormat::vtu)
    write_vtu(mesh, options.association, write);
  else
    write_gmf(mesh, gmf_needs_64_bits(mesh, options.association) ? 3 : 2, options.association, write);
  file.commit();
}

FlatMesh read_mesh(const std::string& path) {
  const Format& format = known_format(path, true);
  return format.read(read_file(path), path);
}

}  // namespace carreau
