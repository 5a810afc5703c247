// SPDX-License-Identifier: BSD-3-Clause
// Universal files of I-DEAS (SDRC, "Universal dataset number" 2411, 2412, 2467; University of Cincinnati's collection): nodes in
// double precision, thin shells and beams, groups of elements.
#include <cstdio>

#include "io/element_words.h"
#include "io/mesh_writers.h"
#include "io/solver/element_sets.h"

namespace carreau {

namespace {

constexpr std::size_t max_group_name = 40;
constexpr int beam = 21, beam_of_order_2 = 24, colour = 7, node_code = 7, element_code = 8;

/// Descriptor of a thin shell.
int descriptor_of(CellKind kind) noexcept { return by_kind(kind, 91, 92, 94, 95); }

void add_integer(std::size_t n, std::string& text) {
  char field[32];
  std::snprintf(field, sizeof field, "%10zu", n);
  text += field;
}

void add_line(std::initializer_list<std::size_t> numbers, std::string& text) {
  for (const std::size_t n : numbers) add_integer(n, text);
  text += '\n';
}

/// Eight a line.
void add_nodes(const std::vector<std::int32_t>& nodes, std::string& text) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (i > 0 && i % 8 == 0) text += '\n';
    add_integer(static_cast<std::size_t>(nodes[i]) + 1, text);
  }
  text += '\n';
}

/// 1P3D25.16, with the decimal point whatever the locale.
void add_real(double x, std::string& text) {
  char field[40];
  std::snprintf(field, sizeof field, "%25.16E", x);
  std::string word = field;
  for (char& c : word) c = c == 'E' ? 'D' : c == ',' ? '.' : c;
  text += word;
}

void begin(int dataset, std::string& text) {
  text += "    -1\n";
  char field[16];
  std::snprintf(field, sizeof field, "%6d\n", dataset);
  text += field;
}

void end(std::string& text) { text += "    -1\n"; }

void add_vertices(const FlatMesh& mesh, std::string& text) {
  begin(2411, text);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3& p = mesh.vertices[v];
    add_line({v + 1, 1, 1, 11}, text);
    for (const double x : {p.x(), p.y(), mesh.dimension == 3 ? p.z() : 0.0}) add_real(x, text);
    text += '\n';
  }
  end(text);
}

/// Physical property: a number a face and, behind them, a curve.
void add_elements(const ElementSets& sets, std::string& text) {
  begin(2412, text);
  std::size_t property = 0;
  for (const FaceSet& face : sets.faces) {
    ++property;
    for (std::size_t k = 0; k < face.cells.size(); ++k) {
      const std::vector<std::int32_t> nodes = around(face.cells[k]);
      add_line({face.first + k, std::size_t(descriptor_of(face.cells[k].kind)), property, 1, colour, nodes.size()}, text);
      add_nodes(nodes, text);
    }
  }
  for (const CurveSet& curve : sets.curves) {
    ++property;
    for (std::size_t k = 0; k < curve.edges.size(); ++k) {
      std::vector<std::int32_t> nodes = curve.edges[k];
      if (nodes.size() == 3) std::swap(nodes[1], nodes[2]);
      add_line({curve.first + k, std::size_t(nodes.size() == 3 ? beam_of_order_2 : beam), property, 1, colour, nodes.size()}, text);
      add_line({0, 1, 1}, text);  // orientation, cross sections of both ends
      add_nodes(nodes, text);
    }
  }
  end(text);
}

struct Range {
  std::size_t first, count;
};

/// Two elements a line.
void add_group(std::size_t number, const std::string& name, const std::vector<Range>& ranges, std::string& text, int code = element_code) {
  std::size_t count = 0, done = 0;
  for (const Range& range : ranges) count += range.count;
  add_line({number, 0, 0, 0, 0, 0, 0, count}, text);
  text += name + "\n";
  for (const Range& range : ranges)
    for (std::size_t k = 0; k < range.count; ++k) {
      for (const std::size_t n : {std::size_t(code), range.first + k, std::size_t(0), std::size_t(0)}) add_integer(n, text);
      if (++done % 2 == 0 || done == count) text += '\n';
    }
}

void add_groups(const ElementSets& sets, std::string& text) {
  begin(2467, text);
  std::size_t number = 0;
  for (const FaceSet& face : sets.faces) add_group(++number, face.name, {{face.first, face.cells.size()}}, text);
  for (const CurveSet& curve : sets.curves) add_group(++number, curve.name, {{curve.first, curve.edges.size()}}, text);
  for (const NamedSets& each : sets.names) {
    std::vector<Range> ranges;
    for (const std::size_t i : each.sets) ranges.push_back({sets.faces[i].first, sets.faces[i].cells.size()});
    add_group(++number, each.name, ranges, text);
  }
  for (const NamedSets& each : sets.curve_names) {
    std::vector<Range> ranges;
    for (const std::size_t i : each.sets) ranges.push_back({sets.curves[i].first, sets.curves[i].edges.size()});
    add_group(++number, each.name, ranges, text);
  }
  for (const NamedVertices& each : sets.point_names) {
    std::vector<Range> ranges;
    for (const std::size_t v : each.vertices) ranges.push_back({v + 1, 1});
    add_group(++number, each.name, ranges, text, node_code);
  }
  end(text);
}

}  // namespace

std::string unv_text(const FlatMesh& mesh) {
  const ElementSets sets = sets_of(mesh, max_group_name);
  std::string text;
  add_vertices(mesh, text);
  add_elements(sets, text);
  add_groups(sets, text);
  return text;
}

}  // namespace carreau
