// SPDX-License-Identifier: BSD-3-Clause
// VTK XML (UnstructuredGrid): points, triangles, lines; references and fields of the file's arrays.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "io/mesh_files.h"
#include "io/text.h"
#include "io/vtk/vtk_cells.h"
#include "io/curved_rows.h"
#include "io/vtk/vtu_arrays.h"
#include "support/format.h"

namespace carreau {

namespace {

/// Arrays of one kind, by name.
using Arrays = std::map<std::string, VtuArray>;

class VtuReader {
 public:
  /// `curved`: takes elements of order 3 and 4; nullptr: they are errors.
  VtuReader(std::string_view content, const std::string& name, HighOrderMesh* curved) : content_(content), name_(name), tags_(content, name), curved_(curved) {
    if (curved != nullptr) elements_.set_curved(*curved);
  }

  FlatMesh read() {
    const XmlTag root = tags_.next();
    if (root.name.empty()) tags_.fail(content_.data() + content_.size(), "the file has no tag of XML");
    if (root.name != "VTKFile") tags_.fail(root.at, "a .vtu file starts with VTKFile, not with " + shown(root.name));
    VtuArrays numbers(content_, name_, root);
    collect(numbers);
    if (pieces_.empty()) tags_.fail(root.at, "the file has no Piece");
    for (Piece& piece : pieces_) add_points(numbers, piece);
    for (Piece& piece : pieces_) add_cells(numbers, piece);
    elements_.give_to(mesh_);  // add_fields() has references
    add_fields(numbers);
    add_faces(numbers);
    return std::move(mesh_);
  }

 private:
  struct Piece {
    XmlTag tag{};
    std::map<std::string, Arrays> sections = {};
    std::size_t points = 0, cells = 0, first_point = 0, first_cell = 0;  ///< of all points and cells of the file
  };

  void collect(VtuArrays& numbers);
  std::size_t text_size(const VtuArray& array);
  void add_array(const std::string& section, VtuArray array);
  const VtuArray& array(const Piece& piece, const std::string& section, const std::string& name) const;
  [[nodiscard]] std::size_t piece_count(const Piece& piece, const char* attribute) const;
  std::int32_t index(const Piece& piece, const VtuArray& array, std::int64_t value) const;
  void add_points(VtuArrays& numbers, Piece& piece);
  void add_cells(VtuArrays& numbers, Piece& piece);
  std::vector<char> ghosts(VtuArrays& numbers, const Piece& piece) const;
  void add_fields(VtuArrays& numbers);
  void add_refs(VtuArrays& numbers, bool on_vertices);
  void add_field(VtuArrays& numbers, const std::string& name, bool on_vertices);
  [[nodiscard]] int components_of(const VtuArray& array) const;
  void add_cell_field(const std::string& name, int components, const std::vector<double>& values);
  std::vector<std::int32_t> refs(const VtuArray& array, const std::vector<std::int64_t>& values) const;
  void add_strings(VtuArrays& numbers, const VtuArray& array, std::string FlatFace::*text);
  void add_faces(VtuArrays& numbers);

  std::string_view content_;
  const std::string& name_;
  XmlTags tags_;
  HighOrderMesh* curved_;
  std::vector<Piece> pieces_;
  Arrays field_data_;
  FlatMesh mesh_;
  std::vector<std::int32_t> vertex_of_;  ///< of each point of the file
  std::map<std::array<double, 3>, std::int32_t> vertex_at_;  ///< vertices of the pieces before, by place; empty for one piece
  std::size_t cells_ = 0;
  VtkCells elements_;
};

void VtuReader::add_array(const std::string& section, VtuArray array) {
  // The only array of Points may have any name.
  const std::string name = section == "Points" ? "" : array.name();
  const XmlTag& tag = array.tag;
  const char* const at = tag.at;
  const std::string shown_name = array.shown_name();
  if (section != "FieldData" && pieces_.empty()) return;
  Arrays& arrays = section == "FieldData" ? field_data_ : pieces_.back().sections[section];
  if (!arrays.emplace(name, std::move(array)).second) tags_.fail(at, shown_name + " of " + section + " is given twice");
}

/// Bytes of the numbers between the tags of an array. Tags inside it (InformationKey of VTK) end the numbers, and are
/// skipped up to the closing tag.
std::size_t VtuReader::text_size(const VtuArray& array) {
  const char* end = nullptr;
  for (;;) {
    const XmlTag tag = tags_.next();
    if (end == nullptr) end = tag.at;
    if (tag.name == array.tag.name && !tag.opens) return static_cast<std::size_t>(end - array.tag.after);
    const bool outside = tag.name == "DataArray" || tag.name == "Array" || tag.name == "Piece" || tag.name == "VTKFile";
    if (tag.name.empty() || outside) tags_.fail(array.tag.at, array.shown_name() + " is not closed");
  }
}

/// Reads the tags: the places of the arrays.
void VtuReader::collect(VtuArrays& numbers) {
  std::string section;
  for (XmlTag tag = tags_.next();; tag = tags_.next()) {
    if (tag.name.empty()) tags_.fail(tag.at, "the file ends before </VTKFile>: it may be truncated");
    if (tag.name == "VTKFile") return;
    if (tag.name == "AppendedData" && tag.opens) return numbers.set_appended(tag);  // bytes, no tags, follow
    if (tag.name == "Piece" && tag.opens) pieces_.push_back({.tag = tag});
    if (tag.name == "DataArray" || tag.name == "Array") {
      if (!tag.opens) continue;
      VtuArray array{.tag = tag, .text = {tag.after, 0}};
      if (!tag.closes) array.text = {tag.after, text_size(array)};
      add_array(section, std::move(array));
      continue;
    }
    section = tag.opens && !tag.closes ? std::string(tag.name) : "";
  }
}

const VtuArray& VtuReader::array(const Piece& piece, const std::string& section, const std::string& name) const {
  const auto arrays = piece.sections.find(section);
  if (arrays != piece.sections.end())
    if (const auto found = arrays->second.find(name); found != arrays->second.end()) return found->second;
  tags_.fail(piece.tag.at, section + " has no array" + (name.empty() ? "" : " '" + name + "'"));
}

std::size_t VtuReader::piece_count(const Piece& piece, const char* attribute) const {
  const std::string given = piece.tag.attribute(attribute);
  int n = 0;  // indices have 32 bits
  if (!parse_number(given, n) || n < 0)
    tags_.fail(piece.tag.at, std::string(attribute) + " is " + shown(given) + " instead of a number of 32 bits");
  return static_cast<std::size_t>(n);
}

/// A point at the place of one of an earlier piece is the same vertex: pieces of one mesh repeat the points between
/// them.
void VtuReader::add_points(VtuArrays& numbers, Piece& piece) {
  piece.first_point = vertex_of_.size();
  piece.points = piece_count(piece, "NumberOfPoints");
  if (piece.first_point + piece.points > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    tags_.fail(piece.tag.at, "the pieces have more points than 32 bits can count");
  const std::size_t first = mesh_.vertices.size();
  const std::vector<double> x =
      piece.points > 0 ? numbers.reals(array(piece, "Points", ""), 3 * piece.points, true) : std::vector<double>{};
  for (std::size_t i = 0; i < piece.points; ++i) {
    const auto known = vertex_at_.find({x[3 * i], x[3 * i + 1], x[3 * i + 2]});
    vertex_of_.push_back(known != vertex_at_.end() ? known->second : static_cast<std::int32_t>(mesh_.vertices.size()));
    if (known == vertex_at_.end()) mesh_.vertices.push_back({x[3 * i], x[3 * i + 1], x[3 * i + 2]});
  }
  for (std::size_t v = first; v < mesh_.vertices.size() && pieces_.size() > 1; ++v) {
    const Vec3& p = mesh_.vertices[v];
    vertex_at_.emplace(std::array{p.x(), p.y(), p.z()}, static_cast<std::int32_t>(v));
  }
  mesh_.vertex_refs.assign(mesh_.vertices.size(), 0);
}

std::int32_t VtuReader::index(const Piece& piece, const VtuArray& array, std::int64_t value) const {
  if (value < 0 || static_cast<std::uint64_t>(value) >= piece.points)
    tags_.fail(array.tag.at, "a cell names point " + std::to_string(value) + " of " + std::to_string(piece.points));
  return vertex_of_[piece.first_point + static_cast<std::size_t>(value)];
}

/// Cells that another piece has, too, or that are hidden (vtkDataSetAttributes: DUPLICATECELL, HIDDENCELL).
std::vector<char> VtuReader::ghosts(VtuArrays& numbers, const Piece& piece) const {
  std::vector<char> result(piece.cells, 0);
  const auto data = piece.sections.find("CellData");
  if (data == piece.sections.end()) return result;
  const auto found = data->second.find("vtkGhostType");
  if (found == data->second.end()) return result;
  constexpr std::int64_t duplicate = 1, hidden = 32;
  const std::vector<std::int64_t> bits = numbers.integers(found->second, piece.cells);
  for (std::size_t c = 0; c < piece.cells; ++c) result[c] = (bits[c] & (duplicate | hidden)) != 0 ? 1 : 0;
  return result;
}

void VtuReader::add_cells(VtuArrays& numbers, Piece& piece) {
  piece.first_cell = cells_;
  piece.cells = piece_count(piece, "NumberOfCells");
  cells_ += piece.cells;
  if (piece.cells == 0) return;
  const VtuArray& corners_array = array(piece, "Cells", "connectivity");
  const std::vector<std::int64_t> types = numbers.integers(array(piece, "Cells", "types"), piece.cells),
                                  offsets = numbers.integers(array(piece, "Cells", "offsets"), piece.cells),
                                  all = numbers.all_integers(corners_array);
  const std::vector<char> skipped = ghosts(numbers, piece);
  std::vector<std::int32_t> corners;
  std::int64_t begin = 0;
  for (std::size_t c = 0; c < piece.cells; ++c) {
    const std::int64_t end = offsets[c];
    if (end < begin || static_cast<std::uint64_t>(end) > all.size())
      tags_.fail(array(piece, "Cells", "offsets").tag.at, "the offset of cell " + std::to_string(c) + " (from 0) is " +
                                                              std::to_string(end) + ", which cannot be");
    corners.clear();
    for (; begin < end; ++begin) corners.push_back(index(piece, corners_array, all[static_cast<std::size_t>(begin)]));
    if (skipped[c] != 0) continue;
    if (const std::string wrong = elements_.add(types[c], corners, piece.first_cell + c, mesh_.vertices);
        !wrong.empty())
      tags_.fail(array(piece, "Cells", "types").tag.at, wrong);
  }
}

std::vector<std::int32_t> VtuReader::refs(const VtuArray& array, const std::vector<std::int64_t>& values) const {
  std::vector<std::int32_t> result;
  for (const std::int64_t value : values) {
    if (value < std::numeric_limits<std::int32_t>::min() || value > std::numeric_limits<std::int32_t>::max())
      tags_.fail(array.tag.at, "the reference " + std::to_string(value) + " does not fit in 32 bits");
    result.push_back(static_cast<std::int32_t>(value));
  }
  return result;
}

/// Values of triangles and of edges; a list of NaN alone only fills the array of the writer.
void VtuReader::add_cell_field(const std::string& name, int components, const std::vector<double>& values) {
  MeshField field{.name = name, .on_vertices = false, .components = components, .values = {}};
  const auto n = static_cast<std::size_t>(components);
  const auto take = [&](const std::vector<std::size_t>& cells, std::vector<double>& list) {
    for (const std::size_t cell : cells)
      for (std::size_t k = 0; k < n; ++k) list.push_back(values[cell * n + k]);
    return std::all_of(list.begin(), list.end(), [](double value) { return std::isnan(value); });
  };
  const bool no_triangle = take(elements_.cell_of_triangle(), field.values),
             no_edge = take(elements_.cell_of_edge(), field.edge_values);
  if (no_edge)
    field.edge_values.clear();
  else if (no_triangle)
    field.values.clear();
  mesh_.fields.push_back(std::move(field));
}

/// References that a piece does not have are 0.
void VtuReader::add_refs(VtuArrays& numbers, bool on_vertices) {
  std::vector<std::int32_t> found(cells_, 0);
  for (Piece& piece : pieces_) {
    const Arrays& arrays = piece.sections[on_vertices ? "PointData" : "CellData"];
    const auto array = arrays.find("reference");
    if (array == arrays.end()) continue;
    const std::vector<std::int32_t> own =
        refs(array->second, numbers.integers(array->second, on_vertices ? piece.points : piece.cells));
    for (std::size_t i = 0; i < own.size(); ++i)
      if (on_vertices)
        mesh_.vertex_refs[static_cast<std::size_t>(vertex_of_[piece.first_point + i])] = own[i];
      else
        found[piece.first_cell + i] = own[i];
  }
  if (on_vertices) return;
  for (const std::size_t cell : elements_.cell_of_triangle()) mesh_.triangle_refs.push_back(found[cell]);
  for (const std::size_t cell : elements_.cell_of_edge()) mesh_.edge_refs.push_back(found[cell]);
  for (const int corners : {2, 3, 4})
    for (std::size_t k = 0; k < elements_.cell_of_curved(corners).size(); ++k)
      (corners == 2 ? curved_->edge_refs : corners == 3 ? curved_->triangle_refs : curved_->quad_refs)[k] = found[elements_.cell_of_curved(corners)[k]];
}

int VtuReader::components_of(const VtuArray& array) const {
  const std::string given = array.tag.attribute("NumberOfComponents");
  int components = 1;
  constexpr int most = 1000;  // so that numbers of values cannot overflow
  if (!given.empty() && (!parse_number(given, components) || components < 1 || components > most))
    tags_.fail(array.tag.at, array.shown_name() + " has " + shown(given) + " components");
  return components;
}

/// Takes a field that all pieces have, which VTK does likewise.
void VtuReader::add_field(VtuArrays& numbers, const std::string& name, bool on_vertices) {
  int components = 0;
  std::vector<double> values;
  for (Piece& piece : pieces_) {
    const std::size_t count = on_vertices ? piece.points : piece.cells;
    const Arrays& arrays = piece.sections[on_vertices ? "PointData" : "CellData"];
    const auto found = arrays.find(name);
    if (found == arrays.end() && count == 0) continue;
    if (found == arrays.end() || found->second.tag.name != "DataArray") return;  // strings
    const int own = components_of(found->second);
    if (components != 0 && own != components) return;
    components = own;
    const auto n = static_cast<std::size_t>(components);
    const std::vector<double> read = numbers.reals(found->second, count * n, false);
    if (!on_vertices) {
      values.insert(values.end(), read.begin(), read.end());
      continue;
    }
    values.resize(mesh_.vertices.size() * n);
    for (std::size_t i = 0; i < read.size(); ++i)
      values[static_cast<std::size_t>(vertex_of_[piece.first_point + i / n]) * n + i % n] = read[i];
  }
  if (components == 0) return;
  if (on_vertices)
    mesh_.fields.push_back({.name = name, .on_vertices = true, .components = components, .values = values});
  else
    add_cell_field(name, components, values);
}

void VtuReader::add_fields(VtuArrays& numbers) {
  const bool of_faces = field_data_.contains("face_status");
  for (const char* section : {"PointData", "CellData"}) {
    const bool on_vertices = section == std::string("PointData");
    add_refs(numbers, on_vertices);
    for (const auto& [name, each] : pieces_.front().sections[section]) {
      if (name == "reference" || name == "vtkGhostType") continue;
      // add_faces() has read it from the data of faces.
      if (of_faces && !on_vertices && (name == "status" || name == "rgb")) continue;
      add_field(numbers, name, on_vertices);
    }
  }
}

void VtuReader::add_strings(VtuArrays& numbers, const VtuArray& array, std::string FlatFace::*text) {
  std::size_t face = 0;
  for (const std::int64_t code : numbers.all_integers(array)) {
    if (face == mesh_.faces.size() || code < 0 || code > 255)
      tags_.fail(array.tag.at, array.shown_name() + " has more strings than there are faces, or no text");
    if (code == 0)
      ++face;
    else
      mesh_.faces[face].*text += static_cast<char>(code);
  }
}

/// The writer's data of faces.
void VtuReader::add_faces(VtuArrays& numbers) {
  const Arrays& arrays = field_data_;
  const auto found = arrays.find("face_reference"), status = arrays.find("face_status"),
             colours = arrays.find("face_rgb");
  if (found == arrays.end() || status == arrays.end()) return;
  for (const std::int32_t ref : refs(found->second, numbers.all_integers(found->second)))
    mesh_.faces.push_back({.ref = ref});
  const std::size_t n = mesh_.faces.size();
  const std::vector<std::int64_t> states = numbers.integers(status->second, n);
  for (std::size_t f = 0; f < n; ++f) {
    if (states[f] < 0 || states[f] > static_cast<std::int64_t>(FaceStatus::collapsed))
      tags_.fail(status->second.tag.at, "there is no status " + std::to_string(states[f]));
    mesh_.faces[f].status = static_cast<FaceStatus>(states[f]);
  }
  if (colours != arrays.end()) {
    const std::vector<std::int32_t> rgb = refs(colours->second, numbers.integers(colours->second, n));
    for (std::size_t f = 0; f < n; ++f) mesh_.faces[f].rgb = rgb[f] >= 0 && rgb[f] <= 0xFFFFFF ? rgb[f] : -1;
  }
  if (const auto names = arrays.find("face_name"); names != arrays.end())
    add_strings(numbers, names->second, &FlatFace::name);
  if (const auto why = arrays.find("face_why"); why != arrays.end()) add_strings(numbers, why->second, &FlatFace::why);
}

}  // namespace

FlatMesh read_mesh_vtu(std::string_view content, const std::string& name) {
  return VtuReader(without_byte_order_mark(content), name, nullptr).read();
}
FlatMesh read_mesh_vtu(std::string_view content, const std::string& name, HighOrderMesh& curved) {
  return VtuReader(without_byte_order_mark(content), name, &curved).read();
}

}  // namespace carreau
