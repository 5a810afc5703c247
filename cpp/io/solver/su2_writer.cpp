// SPDX-License-Identifier: BSD-3-Clause
// SU2's native format (SU2 documentation, "Mesh File"). A mesh of the plane z = 0: elements, and a marker a curve. A surface in
// space: it bounds a volume that is not there, so that there are no elements, and its faces are markers.
#include "io/mesh_writers.h"
#include "io/solver/element_sets.h"
#include "support/format.h"

namespace carreau {

namespace {

constexpr std::size_t longest_name = 80;
constexpr int line_type = 3, triangle_type = 5, quad_type = 9;

void add_element(int type, const std::int32_t* nodes, int count, std::string& text) {
  text += std::to_string(type);
  for (int k = 0; k < count; ++k) text.append(" ").append(std::to_string(nodes[k]));
}

void add_cell(const Cell& cell, std::string& text) {
  const int corners = corner_count(cell.kind);
  add_element(corners == 4 ? quad_type : triangle_type, cell.nodes.data(), corners, text);
}

void add_plane_elements(const ElementSets& sets, std::string& text) {
  std::size_t elements = 0, number = 0;
  for (const FaceSet& face : sets.faces) elements += face.cells.size();
  text += "NELEM= " + std::to_string(elements) + "\n";
  for (const FaceSet& face : sets.faces)
    for (const Cell& cell : face.cells) add_cell(cell, text), text.append(" ").append(std::to_string(number++)).append("\n");
}

void add_points(const FlatMesh& mesh, bool flat, std::string& text) {
  text += "NPOIN= " + std::to_string(mesh.vertices.size()) + "\n";
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3& p = mesh.vertices[v];
    for (int x = 0; x < (flat ? 2 : 3); ++x) append_number(text, p[x]), text += ' ';
    text += std::to_string(v) + "\n";
  }
}

/// Names of faces, where they have some, else their references.
std::vector<std::string> marker_names(const ElementSets& sets) {
  std::vector<std::string> names;
  for (const FaceSet& face : sets.faces) names.push_back(face.name);
  for (const NamedFaces& each : sets.names)
    for (const std::size_t i : each.faces) names[i] = each.name;
  return names;
}

void add_face_markers(const ElementSets& sets, std::string& text) {
  const std::vector<std::string> names = marker_names(sets);
  std::vector<std::vector<std::size_t>> markers;
  std::vector<std::string> order;
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::size_t k = 0;
    while (k < order.size() && order[k] != names[i]) ++k;
    if (k == order.size()) order.push_back(names[i]), markers.emplace_back();
    markers[k].push_back(i);
  }
  text += "NMARK= " + std::to_string(order.size()) + "\n";
  for (std::size_t k = 0; k < order.size(); ++k) {
    std::size_t count = 0;
    for (const std::size_t i : markers[k]) count += sets.faces[i].cells.size();
    text += "MARKER_TAG= " + order[k] + "\nMARKER_ELEMS= " + std::to_string(count) + "\n";
    for (const std::size_t i : markers[k])
      for (const Cell& cell : sets.faces[i].cells) add_cell(cell, text), text += '\n';
  }
}

void add_curve_markers(const ElementSets& sets, std::string& text) {
  text += "NMARK= " + std::to_string(sets.curves.size()) + "\n";
  for (const CurveSet& curve : sets.curves) {
    text += "MARKER_TAG= " + curve.name + "\nMARKER_ELEMS= " + std::to_string(curve.edges.size()) + "\n";
    for (const auto& edge : curve.edges) add_element(line_type, edge.data(), 2, text), text += '\n';
  }
}

}  // namespace

std::string su2_text(const FlatMesh& mesh) {
  refuse_second_order(mesh, ".su2");
  const ElementSets sets = sets_of(mesh, longest_name);
  bool flat = true;
  for (const Vec3& p : mesh.vertices) flat = flat && (mesh.dimension == 2 || p.z() == 0);
  std::string text = flat ? "NDIME= 2\n" : "NDIME= 3\n";
  if (flat) add_plane_elements(sets, text);  // no count of 0 in space: meshio does not take it
  add_points(mesh, flat, text);
  if (flat)
    add_curve_markers(sets, text);
  else
    add_face_markers(sets, text);
  return text;
}

}  // namespace carreau
