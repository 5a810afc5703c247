// SPDX-License-Identifier: BSD-3-Clause
// VTK's legacy format, version 3.0, which every reader takes: UNSTRUCTURED_GRID as text or in big-endian binary form.
#include <bit>
#include <cmath>

#include "io/mesh_writers.h"
#include "io/raw_numbers.h"
#include "io/vtk/vtk_output.h"
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

/// Blanks would end the name.
std::string legacy_name(const std::string& name) {
  std::string text = name.empty() ? "field" : name;
  for (char& c : text) c = static_cast<unsigned char>(c) <= ' ' ? '_' : c;
  return text;
}

void add_fields(LegacyFile& file, const VtkOutput& cells, bool on_vertices) {
  const FlatMesh& mesh = cells.mesh();
  std::size_t count = 0;
  for (const MeshField& field : mesh.fields) count += field.on_vertices == on_vertices ? 1 : 0;
  if (count == 0) return;
  file.line("FIELD FieldData " + std::to_string(count));
  const std::size_t tuples = on_vertices ? mesh.vertices.size() : cells.size();
  for (const MeshField& field : mesh.fields) {
    if (field.on_vertices != on_vertices) continue;
    const auto n = static_cast<std::size_t>(field.components);
    file.line(legacy_name(field.name) + " " + std::to_string(n) + " " + std::to_string(tuples) + " double");
    const std::vector<double> of_cells = on_vertices ? std::vector<double>{} : cells.values(field);
    const std::vector<double>& values = on_vertices ? field.values : of_cells;
    for (std::size_t i = 0; i < tuples; ++i) {
      for (std::size_t k = 0; k < n; ++k) file.number(values[i * n + k]);
      file.end_record();
    }
    file.end_section();
  }
}

}  // namespace

std::string vtk_text(const FlatMesh& mesh, bool ascii) {
  LegacyFile file(ascii);
  const VtkOutput cells(mesh);
  file.line("POINTS " + std::to_string(mesh.vertices.size()) + " double");
  for (const Vec3& p : mesh.vertices) {
    file.number(p.x()), file.number(p.y()), file.number(mesh.dimension == 3 ? p.z() : 0.0);
    file.end_record();
  }
  file.end_section();
  std::vector<std::int32_t> nodes;
  for (std::size_t c = 0; c < cells.size(); ++c) cells.append_nodes(c, nodes);
  file.line("CELLS " + std::to_string(cells.size()) + " " + std::to_string(cells.size() + nodes.size()));
  for (std::size_t c = 0; c < cells.size(); ++c) {
    nodes.clear();
    cells.append_nodes(c, nodes);
    file.number(static_cast<std::int32_t>(nodes.size()));
    for (const std::int32_t v : nodes) file.number(v);
    file.end_record();
  }
  file.end_section();
  file.line("CELL_TYPES " + std::to_string(cells.size()));
  for (std::size_t c = 0; c < cells.size(); ++c) file.number(std::int32_t{cells.type(c)}), file.end_record();
  file.end_section();
  file.line("POINT_DATA " + std::to_string(mesh.vertices.size()));
  file.line("SCALARS reference int 1\nLOOKUP_TABLE default");
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) file.number(ref_of(mesh.vertex_refs, v)), file.end_record();
  file.end_section();
  add_fields(file, cells, true);
  file.line("CELL_DATA " + std::to_string(cells.size()));
  file.line("SCALARS reference int 1\nLOOKUP_TABLE default");
  for (std::size_t c = 0; c < cells.size(); ++c) file.number(cells.ref(c)), file.end_record();
  file.end_section();
  add_fields(file, cells, false);
  return file.take();
}

}  // namespace carreau
