// SPDX-License-Identifier: BSD-3-Clause
// Bulk data of Nastran (MSC Nastran quick reference guide): GRID, CTRIA3, CTRIA6, CQUAD4, CQUAD8, PLOTEL for edges. Faces
// are properties; names are sets of the case control section.
#include <array>
#include <map>
#include <set>

#include "io/element_words.h"
#include "io/mesh_writers.h"
#include "io/solver/element_sets.h"
#include "io/solver/narrow_numbers.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

constexpr std::size_t max_property_name = 32, small_field = 8, large_field = 16, largest_number = 99'999'999;

const char* card_of(CellKind kind) noexcept { return by_kind(kind, "CTRIA3", "CTRIA6", "CQUAD4", "CQUAD8"); }

std::string padded(std::string field, std::size_t width) {
  field.resize(std::max(field.size(), width), ' ');
  return field;
}

/// Without the blanks at its end.
void end_line(std::string& text) {
  text.erase(text.find_last_not_of(' ') + 1);
  text += '\n';
}

/// A card of numbers in small fields, eight a line.
void add_card(const char* name, const std::vector<std::size_t>& numbers, std::string& text) {
  constexpr std::size_t a_line = 8;
  text += padded(name, small_field);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0 && i % a_line == 0) end_line(text), text += padded("+", small_field);
    text += padded(std::to_string(numbers[i]), small_field);
  }
  end_line(text);
}

/// Small fields if they hold all coordinates exactly, else large ones.
void add_grid(std::size_t number, const Vec3& p, std::string& text) {
  std::string fields[3];
  bool small = true;
  for (int x = 0; x < 3; ++x) {
    fields[x] = nastran_number(p[x], large_field);
    small = small && fields[x].size() <= small_field;
  }
  const std::string id = std::to_string(number);
  if (small) {
    text += padded("GRID", small_field) + padded(id, small_field) + padded("", small_field);
    for (const std::string& field : fields) text += padded(field, small_field);
    end_line(text);
    return;
  }
  text += padded("GRID*", small_field) + padded(id, large_field) + padded("", large_field) +
          padded(fields[0], large_field) + padded(fields[1], large_field) + "\n" + padded("*", small_field) + fields[2] +
          "\n";
}

/// Properties have positive numbers: other references get numbers above the largest one.
std::vector<std::size_t> properties_of(const ElementSets& sets) {
  std::size_t next = 0;
  for (const FaceSet& face : sets.faces) next = std::max<std::size_t>(next, face.ref > 0 ? std::size_t(face.ref) : 0);
  std::vector<std::size_t> properties;
  for (const FaceSet& face : sets.faces)
    properties.push_back(face.ref > 0 && std::size_t(face.ref) <= largest_number ? std::size_t(face.ref) : ++next);
  return properties;
}

/// A set of ranges of numbers.
void add_set(std::size_t number, const std::string& name, const std::vector<std::array<std::size_t, 2>>& ranges, std::string& text) {
  text += "$ set " + std::to_string(number) + ": " + name + "\nSET " + std::to_string(number) + " = ";
  const char* between = "";
  for (const auto& [first, count] : ranges) {
    text += between + std::to_string(first);
    if (count > 1) text += " THRU " + std::to_string(first + count - 1);
    between = ",\n  ";
  }
  text += '\n';
}

/// Faces and curves are numbered through: their elements are ranges. Sets of grids are marked by their names.
void add_sets(const ElementSets& sets, const std::vector<std::size_t>& properties, std::string& text) {
  for (std::size_t i = 0; i < sets.faces.size(); ++i)
    text += "$ property " + std::to_string(properties[i]) + ": " + sets.faces[i].name + "\n";
  std::size_t number = 0;
  const auto add = [&](const std::vector<NamedSets>& names, const auto& all, const auto& count_of) {
    for (const NamedSets& each : names) {
      std::vector<std::array<std::size_t, 2>> ranges;
      for (const std::size_t k : each.sets) ranges.push_back({all[k].first, count_of(all[k])});
      add_set(++number, each.name, ranges, text);
    }
  };
  add(sets.names, sets.faces, [](const FaceSet& face) { return face.cells.size(); });
  add(sets.curve_names, sets.curves, [](const CurveSet& curve) { return curve.edges.size(); });
  for (const NamedVertices& each : sets.point_names) {
    std::vector<std::array<std::size_t, 2>> ranges;
    for (const std::size_t v : each.vertices) ranges.push_back({v + 1, 1});
    add_set(++number, each.name + " (grids)", ranges, text);
  }
}

}  // namespace

std::string bdf_text(const FlatMesh& mesh) {
  const ElementSets sets = sets_of(mesh, max_property_name);
  if (std::max(sets.elements, mesh.vertices.size()) > largest_number)
    throw InvalidArgument("the mesh has more nodes or elements than the eight digits of .bdf can number");
  const std::vector<std::size_t> properties = properties_of(sets);
  std::string text = "$ mesh by Carreau\nCEND\n";
  add_sets(sets, properties, text);
  text += "BEGIN BULK\n";
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    Vec3 p = mesh.vertices[v];
    if (mesh.dimension == 2) p.z() = 0;
    add_grid(v + 1, p, text);
  }
  for (std::size_t i = 0; i < sets.faces.size(); ++i)
    for (std::size_t k = 0; k < sets.faces[i].cells.size(); ++k) {
      const Cell& cell = sets.faces[i].cells[k];
      std::vector<std::size_t> numbers{sets.faces[i].first + k, properties[i]};
      for (int n = 0; n < node_count(cell.kind); ++n) numbers.push_back(std::size_t(cell.nodes[n]) + 1);
      add_card(card_of(cell.kind), numbers, text);
    }
  for (const CurveSet& curve : sets.curves) {
    text += "$ " + curve.name + "\n";
    for (std::size_t k = 0; k < curve.edges.size(); ++k)
      add_card("PLOTEL", {curve.first + k, std::size_t(curve.edges[k][0]) + 1, std::size_t(curve.edges[k][1]) + 1}, text);
  }
  return text + "ENDDATA\n";
}

}  // namespace carreau
