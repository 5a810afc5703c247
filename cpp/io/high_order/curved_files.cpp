// SPDX-License-Identifier: BSD-3-Clause
#include "io/high_order/curved_files.h"

#include <algorithm>
#include <span>

#include "io/curved_rows.h"
#include "io/files.h"
#include "io/gmsh/msh_mesh.h"
#include "io/vtk/vtu_places.h"
#include "support/error.h"
#include "support/format.h"
#include "support/infinity.h"

namespace carreau {

namespace {

std::string number(double x) { return format_number(x); }

void put_point(const Vec3& p, std::string& text) {
  for (int i = 0; i < 3; ++i) text += number(p[i]) + (i < 2 ? " " : "\n");
}

/// Elements of one kind, in rows.
struct ElementRows {
  int dimension, corners, gmsh;
  std::size_t width;
  const std::vector<std::int32_t>&nodes, &refs;
};

std::vector<ElementRows> rows_of(const HighOrderMesh& mesh) {
  const int k = mesh.order - 2;
  constexpr int edges[]{8, 26, 27}, triangles[]{9, 21, 23}, quads[]{10, 36, 37};
  const auto p = static_cast<std::size_t>(mesh.order);
  return {{1, 2, edges[k], p + 1, mesh.edges, mesh.edge_refs},
          {2, 3, triangles[k], (p + 1) * (p + 2) / 2, mesh.triangles, mesh.triangle_refs},
          {2, 4, quads[k], (p + 1) * (p + 1), mesh.quads, mesh.quad_refs}};
}

std::string suffix(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  std::string end = dot == std::string::npos ? "" : path.substr(dot);
  for (char& c : end) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return end;
}

HighOrderMesh at_places(const HighOrderMesh& mesh, NodePlaces places, bool association) {
  if (association && mesh.association.entities.empty()) throw InvalidArgument("the places of nodes on the geometry are not known");
  if (association && mesh.places != places)
    throw InvalidArgument("a file with the places of nodes on the geometry requires equidistant nodes: nodes at other places leave the surface in it");
  return with_places(mesh, places);
}

}  // namespace

std::string curved_msh(const HighOrderMesh& given, bool association, bool version_2) {
  const HighOrderMesh mesh = at_places(given, NodePlaces::equidistant, association);
  MshMesh file;
  file.nodes = mesh.nodes;
  std::vector<std::int32_t> refs = mesh.corner_refs;
  refs.resize(mesh.nodes.size(), 0);
  std::vector<FlatFace> faces;
  for (const auto& [ref, name] : mesh.face_names) faces.push_back({.ref = ref, .name = name});
  EntityNames names = mesh.names;
  names.face_solids.clear();  // dolfinx rejects groups of solids, which have no elements here
  file.node_refs = &refs, file.names = &names, file.faces = &faces, file.periodic = &mesh.periodic;
  for (const ElementRows& rows : rows_of(mesh))
    for (std::size_t e = 0; e < rows.refs.size(); ++e)
      file.elements.push_back({rows.dimension, rows.gmsh, rows.corners, rows.refs[e], std::span(rows.nodes).subspan(e * rows.width, rows.width)});
  return msh_text(file, version_2, association ? &mesh.association : nullptr);
}

std::string curved_vtu(const HighOrderMesh& given, bool association) {
  HighOrderMesh mesh = at_places(given, NodePlaces::equidistant, association);
  const std::vector<std::size_t> quad = vtk_ranks_of_quad(mesh.order);
  std::vector<std::int32_t> connectivity, refs;
  std::vector<std::int64_t> offsets;
  std::vector<std::uint8_t> types;
  std::vector<std::size_t> counts;
  std::vector<Vec2> uv;
  std::size_t at = 0;
  for (const ElementRows& rows : rows_of(mesh))
    for (std::size_t e = 0; e < rows.refs.size(); ++e) {
      const bool is_quad = rows.corners == 4;
      for (std::size_t i = 0; i < rows.width; ++i) {
        connectivity.push_back(rows.nodes[e * rows.width + (is_quad ? quad[i] : i)]);
        if (association) uv.push_back(rows.dimension == 2 ? mesh.association.cell_uv[at + (is_quad ? quad[i] : i)] : Vec2(nan, nan));
      }
      if (rows.dimension == 2) at += rows.width;
      counts.push_back(rows.width);
      offsets.push_back(static_cast<std::int64_t>(connectivity.size())), refs.push_back(rows.refs[e]);
      constexpr std::uint8_t kinds[]{68, 69, 70};
      types.push_back(kinds[rows.corners - 2]);
    }
  mesh.association.cell_uv = std::move(uv);
  VtuFile file;
  file.open("2.2", mesh.nodes.size(), types.size());
  file.xml("<PointData>\n");
  if (association) add_node_places(file, mesh.association);
  file.xml("</PointData>\n<CellData Scalars=\"reference\">\n");
  file.array("reference", 1, refs);
  if (association) add_cell_places(file, counts, types.size(), mesh.association);
  file.xml("</CellData>\n<Points>\n");
  std::vector<double> points;
  points.reserve(3 * mesh.nodes.size());
  for (const Vec3& p : mesh.nodes) points.insert(points.end(), {p.x(), p.y(), p.z()});
  file.array("Points", 3, points);
  file.xml("</Points>\n<Cells>\n");
  file.array("connectivity", 1, connectivity);
  file.array("offsets", 1, offsets);
  file.array("types", 1, types);
  file.xml("</Cells>\n</Piece>\n</UnstructuredGrid>\n");
  std::string bytes;
  file.finish([&](std::string_view block) { bytes += block; });
  return bytes;
}

std::string curved_mfem(const HighOrderMesh& given) {
  const HighOrderMesh mesh = with_places(given, NodePlaces::gauss_lobatto);
  std::string text = "MFEM mesh v1.0\n\ndimension\n2\n\nelements\n" + std::to_string(mesh.triangle_refs.size() + mesh.quad_refs.size()) + "\n", nodes, boundary;
  const std::vector<ElementRows> all = rows_of(mesh);
  for (const ElementRows& rows : {all[1], all[2]}) {
    const bool quad = rows.gmsh == all[2].gmsh;
    const std::vector<std::size_t> order = mfem_ranks(quad, mesh.order);
    for (std::size_t e = 0; e < rows.refs.size(); ++e) {
      if (rows.refs[e] < 1) throw InvalidArgument("MFEM's files have no face of reference " + std::to_string(rows.refs[e]) + ": attributes are positive");
      text += std::to_string(rows.refs[e]) + (quad ? " 3" : " 2");
      for (std::size_t i = 0; i < (quad ? 4U : 3U); ++i) text += " " + std::to_string(rows.nodes[e * rows.width + i]);
      text += "\n";
      for (const std::size_t i : order) put_point(mesh.nodes[rows.nodes[e * rows.width + i]], nodes);
    }
  }
  std::size_t sides = 0;
  for (std::size_t e = 0; e < mesh.edge_refs.size(); ++e) {
    if (mesh.edge_refs[e] < 1) continue;
    ++sides;
    boundary += std::to_string(mesh.edge_refs[e]) + " 1 " + std::to_string(mesh.edges[e * all[0].width]) + " " + std::to_string(mesh.edges[e * all[0].width + 1]) + "\n";
  }
  return text + "\nboundary\n" + std::to_string(sides) + "\n" + boundary + "\nvertices\n" + std::to_string(mesh.corners) +
         "\n\nnodes\nFiniteElementSpace\nFiniteElementCollection: L2_T1_2D_P" + std::to_string(mesh.order) + "\nVDim: 3\nOrdering: 1\n\n" + nodes;
}

void write_curved(const HighOrderMesh& mesh, const std::string& path, bool association) {
  const std::string end = suffix(path);
  if (end == ".msh" || end == ".msh2") return write_file(path, curved_msh(mesh, association, end == ".msh2"));
  if (end == ".vtu") return write_file(path, curved_vtu(mesh, association));
  if (end == ".mesh") return write_file(path, curved_mfem(mesh));
  throw InvalidArgument("'" + path + "' cannot hold elements of order " + std::to_string(mesh.order) + ": .msh, .msh2, .vtu and .mesh (of MFEM) can");
}

}  // namespace carreau
