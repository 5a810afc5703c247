// SPDX-License-Identifier: BSD-3-Clause
// VTK's legacy format, version 3.0, which every reader takes: UNSTRUCTURED_GRID as text or in big-endian binary form.
#include <bit>
#include <cmath>
#include <limits>

#include "io/element_lists.h"
#include "io/mesh_writers.h"
#include "io/raw_numbers.h"
#include "support/format.h"

namespace carreau {

namespace {

class LegacyFile {
 public:
  explicit LegacyFile(bool ascii) : ascii_(ascii) {
    text_ = std::string("# vtk DataFile Version 3.0\nCarreau\n") + (ascii ? "ASCII" : "BINARY") +
            "\nDATASET UNSTRUCTURED_GRID\n";
  }

  void line(const std::string& words) { text_ += words + "\n"; }
  void number(double value) {
    if (!ascii_) return raw(value);
    text_ += std::isnan(value) ? "nan" : format_number(value);
    text_ += ' ';
  }
  void number(std::int32_t value) {
    if (!ascii_) return raw(value);
    text_ += std::to_string(value) + ' ';
  }
  void end_record() {
    if (ascii_) text_ += '\n';
  }
  void end_section() {
    if (!ascii_) text_ += '\n';
  }
  std::string take() { return std::move(text_); }

 private:
  template <typename T>
  void raw(T value) {
    const T stored = raw_number<T>(reinterpret_cast<const char*>(&value), std::endian::native == std::endian::little);
    text_.append(reinterpret_cast<const char*>(&stored), sizeof stored);
  }

  bool ascii_;
  std::string text_;
};

int vtk_type_of(CellKind kind) {
  switch (kind) {
    case CellKind::triangle3:
      return 5;
    case CellKind::triangle6:
      return 22;
    case CellKind::quad4:
      return 9;
    default:
      return 23;
  }
}

/// An element or an edge of a curve, with its first triangle.
struct Record {
  std::vector<std::int32_t> nodes;
  int type = 0;
  std::int32_t ref = 0;
  std::ptrdiff_t triangle = -1, edge = -1;
  bool halves = false;
};

std::vector<Record> records_of(const FlatMesh& mesh) {
  std::vector<Record> records;
  const auto triangle_ref = [&](std::size_t t) { return ref_of(mesh.triangle_refs, t); };
  std::size_t t = 0;
  for (const Cell& cell : mesh.cells) {
    const bool quad = corner_count(cell.kind) == 4;
    records.push_back({{cell.nodes.begin(), cell.nodes.begin() + node_count(cell.kind)}, vtk_type_of(cell.kind),
                       triangle_ref(t), static_cast<std::ptrdiff_t>(t), -1, quad});
    t += quad ? 2 : 1;
  }
  for (; mesh.cells.empty() && t < mesh.triangles.size(); ++t)
    records.push_back({{mesh.triangles[t].begin(), mesh.triangles[t].end()}, 5, triangle_ref(t), static_cast<std::ptrdiff_t>(t), -1, false});
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    Record& record = records.emplace_back();
    record.nodes = {mesh.edges[e][0], mesh.edges[e][1]}, record.type = 3;
    if (!mesh.edge_mids.empty()) record.nodes.push_back(mesh.edge_mids[e]), record.type = 21;
    record.ref = ref_of(mesh.edge_refs, e), record.edge = static_cast<std::ptrdiff_t>(e);
  }
  return records;
}

/// Blanks would end the name.
std::string legacy_name(const std::string& name) {
  std::string text = name.empty() ? "field" : name;
  for (char& c : text) c = static_cast<unsigned char>(c) <= ' ' ? '_' : c;
  return text;
}

double cell_value(const MeshField& field, const Record& record, std::size_t k) {
  const auto n = static_cast<std::size_t>(field.components);
  const std::vector<double>& values = record.edge >= 0 ? field.edge_values : field.values;
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const std::size_t at = static_cast<std::size_t>(record.edge >= 0 ? record.edge : record.triangle) * n + k;
  return record.halves ? 0.5 * (values[at] + values[at + n]) : values[at];
}

void add_fields(LegacyFile& file, const FlatMesh& mesh, const std::vector<Record>& records, bool on_vertices) {
  std::size_t count = 0;
  for (const MeshField& field : mesh.fields) count += field.on_vertices == on_vertices ? 1 : 0;
  if (count == 0) return;
  file.line("FIELD FieldData " + std::to_string(count));
  const std::size_t tuples = on_vertices ? mesh.vertices.size() : records.size();
  for (const MeshField& field : mesh.fields) {
    if (field.on_vertices != on_vertices) continue;
    const auto n = static_cast<std::size_t>(field.components);
    file.line(legacy_name(field.name) + " " + std::to_string(n) + " " + std::to_string(tuples) + " double");
    for (std::size_t i = 0; i < tuples; ++i) {
      for (std::size_t k = 0; k < n; ++k)
        file.number(on_vertices ? field.values[i * n + k] : cell_value(field, records[i], k));
      file.end_record();
    }
    file.end_section();
  }
}

}  // namespace

std::string vtk_text(const FlatMesh& mesh, bool ascii) {
  LegacyFile file(ascii);
  const std::vector<Record> records = records_of(mesh);
  file.line("POINTS " + std::to_string(mesh.vertices.size()) + " double");
  for (const Vec3& p : mesh.vertices) {
    file.number(p.x()), file.number(p.y()), file.number(mesh.dimension == 3 ? p.z() : 0.0);
    file.end_record();
  }
  file.end_section();
  std::size_t size = records.size();
  for (const Record& record : records) size += record.nodes.size();
  file.line("CELLS " + std::to_string(records.size()) + " " + std::to_string(size));
  for (const Record& record : records) {
    file.number(static_cast<std::int32_t>(record.nodes.size()));
    for (const std::int32_t v : record.nodes) file.number(v);
    file.end_record();
  }
  file.end_section();
  file.line("CELL_TYPES " + std::to_string(records.size()));
  for (const Record& record : records) file.number(std::int32_t{record.type}), file.end_record();
  file.end_section();
  file.line("POINT_DATA " + std::to_string(mesh.vertices.size()));
  file.line("SCALARS reference int 1\nLOOKUP_TABLE default");
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) file.number(ref_of(mesh.vertex_refs, v)), file.end_record();
  file.end_section();
  add_fields(file, mesh, records, true);
  file.line("CELL_DATA " + std::to_string(records.size()));
  file.line("SCALARS reference int 1\nLOOKUP_TABLE default");
  for (const Record& record : records) file.number(record.ref), file.end_record();
  file.end_section();
  add_fields(file, mesh, records, false);
  return file.take();
}

}  // namespace carreau
