// SPDX-License-Identifier: BSD-3-Clause
// VTK XML (UnstructuredGrid, version 1.0): the arrays follow the XML as raw bytes ("appended"), each preceded by its
// length in bytes; `offset` counts from the byte after the underscore.
#include <map>

#include "io/mesh_writers.h"
#include "io/vtk/vtk_output.h"
#include "io/vtk/vtu_places.h"

namespace carreau {

namespace {

std::vector<std::int32_t> all_refs(const std::vector<std::int32_t>& refs, std::size_t count) {
  return refs.empty() ? std::vector<std::int32_t>(count, 0) : refs;
}

void add_cells(VtuFile& file, const VtkOutput& cells) {
  const FlatMesh& mesh = cells.mesh();
  std::vector<std::int32_t> connectivity;
  connectivity.reserve(3 * mesh.triangles.size() + 2 * mesh.edges.size());
  std::vector<std::int64_t> offsets;
  offsets.reserve(cells.size());
  std::vector<std::uint8_t> types;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    cells.append_nodes(c, connectivity);
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    types.push_back(cells.type(c));
  }
  file.xml("<Cells>\n");
  file.array("connectivity", 1, connectivity);
  file.array("offsets", 1, offsets);
  file.array("types", 1, types);
  file.xml("</Cells>\n");
}

/// For each cell the solids on both sides of its face, when any is known.
void add_solids(VtuFile& file, const VtkOutput& all) {
  const std::map<int, std::array<int, 2>>& known = all.mesh().names.face_solids;
  if (known.empty()) return;
  std::vector<std::int32_t> solids;
  for (std::size_t c = 0; c < all.size(); ++c) {
    const auto sides = c < all.elements() ? known.find(all.ref(c)) : known.end();
    for (const std::size_t side : {0U, 1U}) solids.push_back(sides != known.end() ? sides->second[side] : 0);
  }
  file.array("solids", 2, solids);
}

/// For each cell the data that programs for cells only would not find: the status of its face (edges: 0), and its
/// colour when any face has one.
void add_face_data(VtuFile& file, const VtkOutput& all) {
  const FlatMesh& mesh = all.mesh();
  if (mesh.faces.empty()) return;
  std::map<std::int32_t, const FlatFace*> by_ref;
  bool coloured = false;
  for (const FlatFace& face : mesh.faces) by_ref.emplace(face.ref, &face), coloured = coloured || face.rgb >= 0;
  constexpr std::int32_t grey = 0xC0C0C0;  // of cells without a colour
  const std::size_t cells = all.size();
  std::vector<std::uint8_t> status(cells, 0), rgb;
  for (std::size_t c = 0; c < cells; ++c) {
    const auto face =
        c < all.elements() ? by_ref.find(all.ref(c)) : by_ref.end();
    const bool known = face != by_ref.end();
    if (known) status[c] = static_cast<std::uint8_t>(face->second->status);
    const std::int32_t colour = known && face->second->rgb >= 0 ? face->second->rgb : grey;
    for (const int shift : {16, 8, 0}) rgb.push_back(static_cast<std::uint8_t>(colour >> shift & 255));
  }
  file.array("status", 1, status);
  if (coloured) file.array("rgb", 3, rgb);
  add_solids(file, all);
}

std::vector<std::size_t> node_counts(const VtkOutput& cells) {
  std::vector<std::int32_t> nodes;
  std::vector<std::size_t> counts;
  for (std::size_t c = 0; c < cells.elements(); ++c) {
    nodes.clear(), cells.append_nodes(c, nodes);
    counts.push_back(nodes.size());
  }
  return counts;
}

void add_cell_data(VtuFile& file, const VtkOutput& cells, const MeshAssociation* association) {
  std::vector<std::int32_t> refs;
  for (std::size_t c = 0; c < cells.size(); ++c) refs.push_back(cells.ref(c));
  file.xml("<CellData Scalars=\"reference\">\n");
  file.array("reference", 1, refs);
  add_face_data(file, cells);
  // VTK requires a value for every cell; NaN marks a cell without a value, which colour ranges leave out.
  for (const MeshField& field : cells.mesh().fields)
    if (!field.on_vertices) file.array(field.name, field.components, cells.values(field));
  if (association != nullptr && !association->cell_uv.empty()) add_cell_places(file, node_counts(cells), cells.size(), *association);
  file.xml("</CellData>\n");
}

/// Strings are arrays of the bytes of their characters, each string ended by a zero. VTK's own type for strings, <Array
/// type="String">, is not used: programs that know DataArray alone reject such a file.
void add_strings(VtuFile& file, const std::string& name, const std::vector<std::string>& texts) {
  std::string codes;
  std::size_t count = 0;
  for (const std::string& text : texts) {
    for (const char c : text) codes += std::to_string(static_cast<unsigned char>(c)) + " ";
    codes += "0\n";
    count += text.size() + 1;
  }
  file.xml("<DataArray type=\"UInt8\" Name=\"" + name + "\" NumberOfTuples=\"" + std::to_string(count) +
           "\" format=\"ascii\">\n" + codes + "</DataArray>\n");
}

void add_names(VtuFile& file, const std::string& kind, const std::map<int, std::string>& names) {
  if (names.empty()) return;
  std::vector<std::int32_t> refs;
  std::vector<std::string> texts;
  for (const auto& [ref, name] : names) refs.push_back(ref), texts.push_back(name);
  file.field(kind + "_reference", refs);
  add_strings(file, kind + "_name", texts);
}

/// Field data: data of each face, and the names of curves, points and solids.
void add_faces(VtuFile& file, const FlatMesh& mesh) {
  if (mesh.faces.empty()) return;
  std::vector<std::int32_t> refs, status, colours;
  std::vector<std::string> names, whys;
  for (const FlatFace& face : mesh.faces) {
    refs.push_back(face.ref);
    status.push_back(static_cast<std::int32_t>(face.status));
    colours.push_back(face.rgb);
    names.push_back(face.name), whys.push_back(face.why);
  }
  file.xml("<FieldData>\n");
  file.field("face_reference", refs);
  file.field("face_status", status);
  file.field("face_rgb", colours);
  add_strings(file, "face_name", names);
  add_strings(file, "face_why", whys);
  add_names(file, "curve", mesh.names.curves);
  add_names(file, "point", mesh.names.points);
  add_names(file, "solid", mesh.names.solids);
  file.xml("</FieldData>\n");
}

}  // namespace

std::string vtu_bytes(const FlatMesh& mesh, const MeshAssociation* association) {
  std::string bytes;
  write_vtu(mesh, association, [&](std::string_view block) { bytes += block; });
  return bytes;
}

void write_vtu(const FlatMesh& mesh, const MeshAssociation* association, const ByteSink& sink) {
  VtuFile file;
  const VtkOutput cells(mesh);
  file.open("1.0", mesh.vertices.size(), cells.size());
  file.xml("<PointData Scalars=\"reference\">\n");
  file.array("reference", 1, all_refs(mesh.vertex_refs, mesh.vertices.size()));
  for (const MeshField& field : mesh.fields)
    if (field.on_vertices) file.array(field.name, field.components, field.values);
  if (association != nullptr) add_node_places(file, *association);
  file.xml("</PointData>\n");
  add_cell_data(file, cells, association);
  std::vector<double> points;
  points.reserve(3 * mesh.vertices.size());
  for (const Vec3& p : mesh.vertices) points.insert(points.end(), {p.x(), p.y(), mesh.dimension == 3 ? p.z() : 0});
  file.xml("<Points>\n");
  file.array("Points", 3, points);
  file.xml("</Points>\n");
  add_cells(file, cells);
  file.xml("</Piece>\n");
  add_faces(file, mesh);
  file.xml("</UnstructuredGrid>\n");
  file.finish(sink);
}

}  // namespace carreau
