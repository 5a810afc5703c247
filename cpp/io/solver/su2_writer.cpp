// SPDX-License-Identifier: BSD-3-Clause
// SU2's native format (SU2 documentation, "Mesh File"). A mesh of the plane z = 0: elements, and a marker a curve. A surface in
// space: it bounds a volume that is not there, so that there are no elements, and its faces are markers.
#include <map>

#include "io/mesh_writers.h"
#include "io/solver/element_sets.h"
#include "support/format.h"

namespace carreau {

namespace {

constexpr std::size_t max_marker_name = 80;
constexpr int written_line = 3, written_triangle = 5, written_quad = 9;

void add_element(int type, const std::int32_t* nodes, int count, std::string& text) {
  text += std::to_string(type);
  for (int k = 0; k < count; ++k) text.append(" ").append(std::to_string(nodes[k]));
}

void add_cell(const Cell& cell, std::string& text) {
  const int corners = corner_count(cell.kind);
  add_element(corners == 4 ? written_quad : written_triangle, cell.nodes.data(), corners, text);
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

/// One marker a name; a set without a name is a separate marker.
template <typename Set>
std::vector<NamedSets> markers_of(const std::vector<Set>& sets, const std::vector<NamedSets>& named) {
  std::vector<std::string> names;
  for (const Set& set : sets) names.push_back(set.name);
  for (const NamedSets& each : named)
    for (const std::size_t i : each.sets) names[i] = each.name;
  std::vector<NamedSets> markers;
  std::map<std::string, std::size_t> place;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto [at, fresh] = place.emplace(names[i], markers.size());
    if (fresh) markers.push_back({names[i], {}});
    markers[at->second].sets.push_back(i);
  }
  return markers;
}

/// Markers of sets, each with the elements of its sets: `elements(set)` is their list, `add` writes one.
template <typename Set, typename Elements, typename Add>
void add_markers(const std::vector<Set>& sets, const std::vector<NamedSets>& named, const Elements& elements, const Add& add, std::string& text) {
  const std::vector<NamedSets> markers = markers_of(sets, named);
  text += "NMARK= " + std::to_string(markers.size()) + "\n";
  for (const NamedSets& marker : markers) {
    std::size_t count = 0;
    for (const std::size_t i : marker.sets) count += elements(sets[i]).size();
    text += "MARKER_TAG= " + marker.name + "\nMARKER_ELEMS= " + std::to_string(count) + "\n";
    for (const std::size_t i : marker.sets)
      for (const auto& element : elements(sets[i])) add(element), text += '\n';
  }
}

}  // namespace

std::string su2_text(const FlatMesh& mesh) {
  refuse_second_order(mesh, ".su2");
  const ElementSets sets = sets_of(mesh, max_marker_name);
  bool flat = true;
  for (const Vec3& p : mesh.vertices) flat = flat && (mesh.dimension == 2 || p.z() == 0);
  std::string text = flat ? "NDIME= 2\n" : "NDIME= 3\n";
  if (flat) add_plane_elements(sets, text);  // no count of 0 in space: meshio does not take it
  add_points(mesh, flat, text);
  if (flat)
    add_markers(sets.curves, sets.curve_names, [](const auto& curve) -> const auto& { return curve.edges; },
                [&](const auto& edge) { add_element(written_line, edge.data(), 2, text); }, text);
  else
    add_markers(sets.faces, sets.names, [](const auto& face) -> const auto& { return face.cells; },
                [&](const Cell& cell) { add_cell(cell, text); }, text);
  return text;
}

}  // namespace carreau
