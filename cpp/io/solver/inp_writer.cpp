// SPDX-License-Identifier: BSD-3-Clause
// Input of Abaqus and CalculiX (Abaqus keywords reference; G. Dhondt, CalculiX CrunchiX user's manual): nodes, shells, sets.
#include <algorithm>
#include <set>

#include "io/element_words.h"
#include "io/mesh_writers.h"
#include "io/solver/element_sets.h"
#include "io/solver/narrow_numbers.h"

namespace carreau {

namespace {

constexpr std::size_t max_set_name = 80, number_width = 20, a_line = 16;

/// Shells of three to eight nodes, which have the order of the format, with the names of CalculiX: S6 is STRI65 in
/// Abaqus.
const char* type_of(CellKind kind) noexcept { return by_kind<const char*>(kind, "S3", "S6", "S4", "S8R"); }

/// Words of a list, sixteen a line; no line ends with a comma.
class List {
 public:
  explicit List(std::string& text) : text_(text) {}
  void add(const std::string& word) {
    if (count_ > 0) text_ += count_ % a_line == 0 ? ",\n" : ", ";
    text_ += word, ++count_;
  }
  void end() {
    if (count_ > 0) text_ += '\n';
  }

 private:
  std::string& text_;
  std::size_t count_ = 0;
};

void add_nodes(const FlatMesh& mesh, std::string& text) {
  text += "*NODE, NSET=all_nodes\n";
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3& p = mesh.vertices[v];
    text += std::to_string(v + 1);
    for (const double x : {p.x(), p.y(), mesh.dimension == 3 ? p.z() : 0.0})
      text.append(", ").append(number_within(x, number_width));
    text += '\n';
  }
}

void add_face(const FaceSet& face, std::string& text) {
  for (std::size_t i = 0; i < face.cells.size(); ++i) {
    const Cell& cell = face.cells[i];
    if (i == 0 || cell.kind != face.cells[i - 1].kind)
      text.append("*ELEMENT, TYPE=").append(type_of(cell.kind)).append(", ELSET=").append(face.name).append("\n");
    text += std::to_string(face.first + i);
    for (int k = 0; k < node_count(cell.kind); ++k) text.append(", ").append(std::to_string(cell.nodes[k] + 1));
    text += '\n';
  }
}

/// The nodes of curves, each once: CalculiX adds up the forces of a node as often as a set lists it.
void add_node_set(const std::string& name, const std::vector<const CurveSet*>& curves, std::string& text) {
  text.append("*NSET, NSET=").append(name).append("\n");
  List list(text);
  std::set<std::int32_t> listed;
  for (const CurveSet* curve : curves)
    for (const auto& edge : curve->edges)
      for (const std::int32_t v : edge)
        if (listed.insert(v).second) list.add(std::to_string(v + 1));
  list.end();
}

// Nodes of both faces of a pair, or of both curves if only curves are periodic, in matching order.
void add_periodic(const FlatMesh& mesh, std::string& text) {
  std::size_t pair = 0;
  int dimension = 0;
  for (const PeriodicLink& link : mesh.periodic) dimension = std::max(dimension, link.dimension);
  for (const PeriodicLink& link : mesh.periodic) {
    if (link.dimension != dimension || dimension == 0) continue;
    ++pair;
    for (const std::size_t side : {0U, 1U}) {
      text.append("*NSET, NSET=periodic_").append(std::to_string(pair)).append(side == 0 ? "_slave" : "_master").append(", UNSORTED\n");
      List list(text);
      for (const auto& nodes : link.nodes) list.add(std::to_string(nodes[side] + 1));
      list.end();
    }
  }
}

}  // namespace

std::string inp_text(const FlatMesh& mesh) {
  const ElementSets sets = sets_of(mesh, max_set_name);
  std::string text = "*HEADING\nmesh by Carreau\n";
  add_nodes(mesh, text);
  for (const FaceSet& face : sets.faces) add_face(face, text);
  const auto add_set = [&](const std::string& name, const auto& faces) {
    if (faces.empty()) return;
    text.append("*ELSET, ELSET=").append(name).append("\n");
    List list(text);
    for (const std::size_t i : faces) list.add(sets.faces[i].name);
    list.end();
  };
  for (const NamedSets& each : sets.names) add_set(each.name, each.sets);
  std::vector<std::size_t> all(sets.faces.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  add_set("all_faces", all);
  for (const CurveSet& curve : sets.curves) add_node_set(curve.name, {&curve}, text);
  for (const NamedSets& each : sets.curve_names) {
    std::vector<const CurveSet*> curves;
    for (const std::size_t i : each.sets) curves.push_back(&sets.curves[i]);
    add_node_set(each.name, curves, text);
  }
  for (const NamedVertices& each : sets.point_names) {
    text.append("*NSET, NSET=").append(each.name).append("\n");
    List list(text);
    for (const std::size_t v : each.vertices) list.add(std::to_string(v + 1));
    list.end();
  }
  add_periodic(mesh, text);
  return text;
}

}  // namespace carreau
