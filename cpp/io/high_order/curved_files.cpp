// SPDX-License-Identifier: BSD-3-Clause
#include "io/high_order/curved_files.h"

#include <algorithm>
#include <map>
#include <set>

#include "io/files.h"
#include "support/error.h"
#include "support/format.h"
#include "support/infinity.h"

namespace carreau {

namespace {

std::string number(double x) { return format_number(x); }
std::string number(std::int64_t x) { return std::to_string(x); }

void put_point(const Vec3& p, std::string& text) {
  for (int i = 0; i < 3; ++i) text += number(p[i]) + (i < 2 ? " " : "\n");
}

/// Elements of one kind, in rows.
struct Rows {
  int dimension, gmsh;
  std::size_t width;
  const std::vector<std::int32_t>&nodes, &refs;
};

std::vector<Rows> rows_of(const HighOrderMesh& mesh) {
  const int k = mesh.order - 2;
  constexpr int edges[]{8, 26, 27}, triangles[]{9, 21, 23}, quads[]{10, 36, 37};
  const auto p = static_cast<std::size_t>(mesh.order);
  return {{1, edges[k], p + 1, mesh.edges, mesh.edge_refs},
          {2, triangles[k], (p + 1) * (p + 2) / 2, mesh.triangles, mesh.triangle_refs},
          {2, quads[k], (p + 1) * (p + 1), mesh.quads, mesh.quad_refs}};
}

// VTK orders nodes of quadrilaterals along s and t: the third and fourth edge run backwards, and inner nodes are rows.
std::vector<std::size_t> vtk_of_quad(int order) {
  const std::vector<std::array<int, 2>> gmsh = node_indices(true, order);
  std::vector<std::array<int, 2>> vtk(gmsh.begin(), gmsh.begin() + 4);
  for (int i = 1; i < order; ++i) vtk.push_back({i, 0});
  for (int i = 1; i < order; ++i) vtk.push_back({order, i});
  for (int i = 1; i < order; ++i) vtk.push_back({i, order});
  for (int i = 1; i < order; ++i) vtk.push_back({0, i});
  for (int k = 1; k < order; ++k)
    for (int i = 1; i < order; ++i) vtk.push_back({i, k});
  std::vector<std::size_t> rank;
  for (const auto& index : vtk) rank.push_back(static_cast<std::size_t>(std::find(gmsh.begin(), gmsh.end(), index) - gmsh.begin()));
  return rank;
}

// MFEM orders nodes of discontinuous elements by rows of t.
std::vector<std::size_t> mfem_of(bool quad, int order) {
  const std::vector<std::array<int, 2>> gmsh = node_indices(quad, order);
  std::vector<std::size_t> rank;
  for (int k = 0; k <= order; ++k)
    for (int i = 0; i <= (quad ? order : order - k); ++i)
      rank.push_back(static_cast<std::size_t>(std::find(gmsh.begin(), gmsh.end(), std::array<int, 2>{i, k}) - gmsh.begin()));
  return rank;
}

std::string suffix(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  std::string end = dot == std::string::npos ? "" : path.substr(dot);
  for (char& c : end) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return end;
}

std::string quoted(std::string name) {
  std::replace_if(name.begin(), name.end(), [](char c) { return c == '"' || static_cast<unsigned char>(c) < 32; }, '_');
  return '"' + name + '"';
}

}  // namespace

std::string curved_msh(const HighOrderMesh& given) {
  const HighOrderMesh mesh = with_places(given, NodePlaces::equidistant);
  std::string text = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  struct Entity {
    Vec3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
    std::string rows;
    std::map<int, std::pair<std::size_t, std::string>> elements = {};  // by type
  };
  std::map<std::pair<int, std::int32_t>, Entity> entities;
  std::int64_t tag = 0;
  std::vector<char> used(mesh.nodes.size(), 0);
  for (const Rows& rows : rows_of(mesh))
    for (std::size_t e = 0; e < rows.refs.size(); ++e) {
      Entity& entity = entities[{rows.dimension, rows.refs[e]}];
      auto& [count, lines] = entity.elements[rows.gmsh];
      ++count;
      lines += number(++tag);
      for (std::size_t i = 0; i < rows.width; ++i) {
        const std::int32_t node = rows.nodes[e * rows.width + i];
        used[node] = 1;
        lines += " " + number(std::int64_t{node} + 1);
        entity.low = entity.low.cwiseMin(mesh.nodes[node]), entity.high = entity.high.cwiseMax(mesh.nodes[node]);
      }
      lines += "\n";
    }
  std::map<int, std::string> faces(mesh.face_names.begin(), mesh.face_names.end());
  std::string names;
  std::size_t named = 0, curves = 0, surfaces = 0, blocks = 0;
  std::string list[3];
  for (const auto& [key, entity] : entities) {
    const auto [dimension, ref] = key;
    ++(dimension == 1 ? curves : surfaces);
    blocks += entity.elements.size();
    const auto& of = dimension == 1 ? mesh.names.curves : faces;
    const auto name = of.find(ref);
    ++named;
    names += std::to_string(dimension) + " " + std::to_string(ref) + " " +
             quoted(name != of.end() ? name->second : (dimension == 1 ? "curve_" : "surface_") + std::to_string(ref)) + "\n";
    std::string& line = list[dimension];
    line += std::to_string(ref);
    for (const Vec3& p : {entity.low, entity.high})
      for (int i = 0; i < 3; ++i) line += " " + number(p[i]);
    line += " 1 " + std::to_string(ref) + " 0\n";
  }
  text += "$PhysicalNames\n" + std::to_string(named) + "\n" + names + "$EndPhysicalNames\n";
  text += "$Entities\n0 " + std::to_string(curves) + " " + std::to_string(surfaces) + " 0\n" + list[1] + list[2] + "$EndEntities\n";
  // Nodes belong to the first entity of lowest dimension that has them.
  std::map<std::pair<int, std::int32_t>, std::vector<std::int32_t>> of_entity;
  std::vector<char> listed(mesh.nodes.size(), 0);
  std::int64_t nodes = 0;
  for (const Rows& rows : rows_of(mesh))
    for (std::size_t i = 0; i < rows.nodes.size(); ++i)
      if (const std::int32_t node = rows.nodes[i]; listed[node] == 0) {
        listed[node] = 1, ++nodes;
        of_entity[{rows.dimension, rows.refs[i / rows.width]}].push_back(node);
      }
  text += "$Nodes\n" + std::to_string(of_entity.size()) + " " + std::to_string(nodes) + " 1 " + std::to_string(mesh.nodes.size()) + "\n";
  for (auto& [key, list_of] : of_entity) {
    std::sort(list_of.begin(), list_of.end());
    text += std::to_string(key.first) + " " + std::to_string(key.second) + " 0 " + std::to_string(list_of.size()) + "\n";
    for (const std::int32_t node : list_of) text += number(std::int64_t{node} + 1) + "\n";
    for (const std::int32_t node : list_of) put_point(mesh.nodes[node], text);
  }
  text += "$EndNodes\n$Elements\n" + std::to_string(blocks) + " " + number(tag) + " 1 " + number(tag) + "\n";
  for (const auto& [key, entity] : entities)
    for (const auto& [type, block] : entity.elements)
      text += std::to_string(key.first) + " " + std::to_string(key.second) + " " + std::to_string(type) + " " + std::to_string(block.first) + "\n" + block.second;
  return text + "$EndElements\n";
}

std::string curved_vtu(const HighOrderMesh& given) {
  const HighOrderMesh mesh = with_places(given, NodePlaces::equidistant);
  const std::vector<std::size_t> quad = vtk_of_quad(mesh.order);
  std::string connectivity, offsets, types, refs;
  std::size_t offset = 0, cells = 0;
  for (const Rows& rows : rows_of(mesh))
    for (std::size_t e = 0; e < rows.refs.size(); ++e, ++cells) {
      const bool is_quad = &rows.nodes == &mesh.quads;
      for (std::size_t i = 0; i < rows.width; ++i) connectivity += std::to_string(rows.nodes[e * rows.width + (is_quad ? quad[i] : i)]) + (i + 1 < rows.width ? " " : "\n");
      offset += rows.width;
      offsets += std::to_string(offset) + "\n", refs += std::to_string(rows.refs[e]) + "\n";
      types += rows.dimension == 1 ? "68\n" : is_quad ? "70\n" : "69\n";
    }
  std::string points;
  for (const Vec3& p : mesh.nodes) put_point(p, points);
  const auto array = [](const std::string& type, const std::string& name, const std::string& more, const std::string& values) {
    return "<DataArray type=\"" + type + "\" Name=\"" + name + "\"" + more + " format=\"ascii\">\n" + values + "</DataArray>\n";
  };
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"2.2\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
         std::to_string(mesh.nodes.size()) + "\" NumberOfCells=\"" + std::to_string(cells) + "\">\n<CellData>\n" + array("Int32", "reference", "", refs) +
         "</CellData>\n<Points>\n" + array("Float64", "Points", " NumberOfComponents=\"3\"", points) + "</Points>\n<Cells>\n" +
         array("Int64", "connectivity", "", connectivity) + array("Int64", "offsets", "", offsets) + array("UInt8", "types", "", types) +
         "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

std::string curved_mfem(const HighOrderMesh& given) {
  const HighOrderMesh mesh = with_places(given, NodePlaces::gauss_lobatto);
  std::string text = "MFEM mesh v1.0\n\ndimension\n2\n\nelements\n" + std::to_string(mesh.triangle_refs.size() + mesh.quad_refs.size()) + "\n", nodes, boundary;
  const std::vector<Rows> all = rows_of(mesh);
  for (const Rows& rows : {all[1], all[2]}) {
    const bool quad = rows.gmsh == all[2].gmsh;
    const std::vector<std::size_t> order = mfem_of(quad, mesh.order);
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

void write_curved(const HighOrderMesh& mesh, const std::string& path) {
  const std::string end = suffix(path);
  if (end == ".msh") return write_file(path, curved_msh(mesh));
  if (end == ".vtu") return write_file(path, curved_vtu(mesh));
  if (end == ".mesh") return write_file(path, curved_mfem(mesh));
  throw InvalidArgument("'" + path + "' cannot hold elements of order " + std::to_string(mesh.order) + ": .msh, .vtu and .mesh (of MFEM) can");
}

}  // namespace carreau
