// SPDX-License-Identifier: BSD-3-Clause
// VTK's legacy format ("VTK File Formats", versions 1.0 to 5.1), ASCII and binary (big-endian): POLYDATA and
// UNSTRUCTURED_GRID.
#include <bit>
#include <cmath>
#include <limits>
#include <map>

#include "io/mesh_files.h"
#include "io/raw_numbers.h"
#include "io/text.h"
#include "io/vtk/vtk_cells.h"
#include "io/words.h"

namespace carreau {

namespace {

enum class LegacyType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64, bits, text };

struct LegacyName {
  const char* name;
  LegacyType type;
  std::size_t size;
};
constexpr LegacyName legacy_types[] = {
    {"char", LegacyType::int8, 1},          {"unsigned_char", LegacyType::uint8, 1},
    {"short", LegacyType::int16, 2},        {"unsigned_short", LegacyType::uint16, 2},
    {"int", LegacyType::int32, 4},          {"unsigned_int", LegacyType::uint32, 4},
    {"long", LegacyType::int64, 8},         {"unsigned_long", LegacyType::uint64, 8},
    {"vtktypeint64", LegacyType::int64, 8}, {"vtktypeuint64", LegacyType::uint64, 8},
    {"vtktypeint32", LegacyType::int32, 4}, {"vtkidtype", LegacyType::int32, 4},
    {"float", LegacyType::float32, 4},      {"double", LegacyType::float64, 8},
    {"bit", LegacyType::bits, 0},           {"string", LegacyType::text, 1}};

class LegacyReader : private Words {
 public:
  LegacyReader(std::string_view content, const std::string& name) : Words(content, name) {}

  FlatMesh read() {
    header();
    for (std::string_view key = word(); !key.empty(); key = word()) section(in_capitals(key), key.data());
    if (!has_points_) fail(end(), "the file has no POINTS");
    if (sections_.empty()) fail(end(), "the file has no cells: it may be truncated");
    add_cells();
    add_data();
    return std::move(mesh_);
  }

 private:
  /// Data of points or cells, as the file has them.
  struct Data {
    std::string name;
    bool on_vertices = true;
    std::size_t components = 1;
    std::vector<double> values;
    const char* at = nullptr;
  };
  /// Cells of one section: their points, one after the other.
  struct Cells {
    std::vector<std::int64_t> offsets{0}, points;
    const char* at = nullptr;
  };

  void header() {
    const char* const start = position();
    if (!in_capitals(rest_of_line()).starts_with("# VTK DATAFILE"))
      fail(start, "a .vtk file starts with '# vtk DataFile Version'");
    rest_of_line();  // the title
    const char* at = position();
    const std::string form = in_capitals(word());
    if (form != "ASCII" && form != "BINARY") fail(at, "ASCII or BINARY was expected, not " + shown(form));
    binary_ = form == "BINARY";
    if (binary_) count_bytes();
    at = position();
    if (in_capitals(word()) != "DATASET") fail(at, "DATASET was expected");
    const std::string_view kind = word();
    const std::string known = in_capitals(kind);
    if (known != "POLYDATA" && known != "UNSTRUCTURED_GRID")
      fail(kind.empty() ? end() : kind.data(), "the data set is " + shown(kind) + "; POLYDATA and UNSTRUCTURED_GRID are read");
    is_grid_ = known == "UNSTRUCTURED_GRID";
  }

  void section(const std::string& key, const char* at) {
    if (key == "POINTS")
      points(at);
    else if (key == "CELLS" && is_grid_)
      cells(0, at);
    else if (key == "CELL_TYPES" && is_grid_)
      types();
    else if (key == "VERTICES" && !is_grid_)
      cells(vtk_points, at);
    else if (key == "LINES" && !is_grid_)
      cells(vtk_polyline, at);
    else if (key == "POLYGONS" && !is_grid_)
      cells(vtk_polygon, at);
    else if (key == "TRIANGLE_STRIPS" && !is_grid_)
      cells(vtk_strip, at);
    else if (key == "POINT_DATA" || key == "CELL_DATA")
      on_vertices_ = key == "POINT_DATA", tuples_ = entities(), in_data_ = true;
    else if (key == "FIELD")
      fields();
    else if (key == "METADATA")
      metadata();
    else if (in_data_)
      attribute(key, at);
    else
      fail(at, "the name of a section was expected, not " + shown(key));
  }

  std::size_t entities() {
    const std::int64_t n = integer_64("a number of entities");
    if (n < 0 || n > std::numeric_limits<std::int32_t>::max())
      fail(position(), "the number of entities is " + std::to_string(n));
    return static_cast<std::size_t>(n);
  }

  const LegacyName& type() {
    const std::string_view name = word();
    std::string lower(name);
    for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    for (const LegacyName& known : legacy_types)
      if (lower == known.name) return known;
    fail(name.empty() ? end() : name.data(), "the type of numbers was expected, not " + shown(name));
  }

  template <typename Number>
  Number raw(const LegacyName& of, const char* at) const {
    constexpr bool swapped = std::endian::native == std::endian::little;
    switch (of.type) {
      case LegacyType::int8:
        return static_cast<Number>(raw_number<std::int8_t>(at, swapped));
      case LegacyType::uint8:
        return static_cast<Number>(raw_number<std::uint8_t>(at, swapped));
      case LegacyType::int16:
        return static_cast<Number>(raw_number<std::int16_t>(at, swapped));
      case LegacyType::uint16:
        return static_cast<Number>(raw_number<std::uint16_t>(at, swapped));
      case LegacyType::int32:
        return static_cast<Number>(raw_number<std::int32_t>(at, swapped));
      case LegacyType::uint32:
        return static_cast<Number>(raw_number<std::uint32_t>(at, swapped));
      case LegacyType::int64:
        return static_cast<Number>(raw_number<std::int64_t>(at, swapped));
      case LegacyType::uint64:
        return static_cast<Number>(raw_number<std::uint64_t>(at, swapped));
      default:
        break;
    }
    if constexpr (std::is_floating_point_v<Number>) {
      if (of.type == LegacyType::float32) return static_cast<Number>(raw_number<float>(at, swapped));
      if (of.type == LegacyType::float64) return static_cast<Number>(raw_number<double>(at, swapped));
    }
    fail(at, std::string("numbers of type ") + of.name + " were not expected here");
  }

  /// `n` numbers behind the line that announces them.
  template <typename Number>
  std::vector<Number> numbers(std::size_t n, const LegacyName& of) {
    std::vector<Number> values;
    if (!binary_) {
      values.reserve(checked_count(static_cast<std::int64_t>(n), position(), "numbers", 1));
      for (std::size_t i = 0; i < n; ++i)
        if constexpr (std::is_floating_point_v<Number>)
          values.push_back(real_or_nan("a number"));
        else
          values.push_back(integer_64("a number"));
      return values;
    }
    rest_of_line();
    const auto left = static_cast<std::size_t>(end() - position());
    const std::size_t bytes = of.type == LegacyType::bits ? (n + 7) / 8 : n * of.size;
    if (bytes > left)
      fail(position(), std::to_string(n) + " numbers of type " + of.name + " are announced, and " + std::to_string(left) +
                           " bytes are left: the file may be truncated");
    values.reserve(n);
    for (std::size_t i = 0; i < n; ++i)
      values.push_back(of.type == LegacyType::bits
                           ? static_cast<Number>(static_cast<unsigned char>(position()[i / 8]) >> (7 - i % 8) & 1)
                           : raw<Number>(of, position() + i * of.size));
    go_back(position() + bytes);
    return values;
  }

  void points(const char* at) {
    if (has_points_) fail(at, "POINTS comes twice");
    has_points_ = true;
    const std::size_t n = entities();
    const std::vector<double> x = numbers<double>(3 * n, type());
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3& p = mesh_.vertices.emplace_back(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
      if (!is_finite(p)) fail(at, "point " + std::to_string(i) + " (from 0) has a coordinate that is not finite");
    }
    mesh_.vertex_refs.assign(n, 0);
  }

  /// "CELLS n size", each with the number of its points before them; or, since version 5.0, offsets and points.
  void cells(std::int64_t type_of_all, const char* at) {
    Cells read;
    read.at = at;
    const std::size_t n = entities(), size = entities();
    const char* const before = position();
    if (in_capitals(word()) == "OFFSETS") {
      read.offsets = numbers<std::int64_t>(n, type());
      if (n == 0) read.offsets = {0};
      const char* const found = position();
      if (in_capitals(word()) != "CONNECTIVITY") fail(found, "CONNECTIVITY was expected");
      read.points = numbers<std::int64_t>(size, type());
    } else {
      go_back(before);
      const std::vector<std::int64_t> all = numbers<std::int64_t>(size, legacy_types[4]);
      for (std::size_t i = 0, cell = 0; cell < n; ++cell) {
        if (i >= size || all[i] < 0 || static_cast<std::uint64_t>(all[i]) > size - i - 1)
          fail(at, "cell " + std::to_string(cell) + " (from 0) has more points than are announced");
        for (std::int64_t k = 1; k <= all[i]; ++k) read.points.push_back(all[i + static_cast<std::size_t>(k)]);
        i += static_cast<std::size_t>(all[i]) + 1;
        read.offsets.push_back(static_cast<std::int64_t>(read.points.size()));
      }
    }
    // Cells of POLYDATA have this order, whatever the order of the sections.
    if (!sections_.emplace(type_of_all, std::move(read)).second) fail(at, "cells of one kind come twice");
  }

  void types() {
    const std::size_t n = entities();
    types_ = numbers<std::int64_t>(n, legacy_types[4]);
    has_types_ = true;
  }

  void add_cells() {
    if (is_grid_ && !sections_.empty() && !has_types_) fail(end(), "the file has no CELL_TYPES");
    std::vector<std::int32_t> corners;
    for (const std::int64_t kind : {std::int64_t{0}, vtk_points, vtk_polyline, vtk_polygon, vtk_strip}) {
      const auto found = sections_.find(kind);
      if (found == sections_.end()) continue;
      const Cells& own = found->second;
      const std::size_t n = own.offsets.size() - 1;
      if (kind == 0 && types_.size() != n)
        fail(own.at, "there are " + std::to_string(n) + " cells and " + std::to_string(types_.size()) + " types");
      for (std::size_t c = 0; c < n; ++c, ++cells_) {
        corners.clear();
        const std::int64_t from = own.offsets[c], to = own.offsets[c + 1];
        if (from < 0 || to < from || static_cast<std::uint64_t>(to) > own.points.size())
          fail(own.at, "the offset of cell " + std::to_string(c) + " (from 0) cannot be");
        for (std::int64_t i = from; i < to; ++i) corners.push_back(vertex(own.points[static_cast<std::size_t>(i)], own.at));
        const std::int64_t cell_type = kind == 0 ? types_[c] : kind;
        if (const std::string wrong = elements_.add(cell_type, corners, cells_, mesh_.vertices); !wrong.empty())
          fail(own.at, wrong);
      }
    }
    elements_.give_to(mesh_);
  }

  std::int32_t vertex(std::int64_t point, const char* at) const {
    if (point < 0 || static_cast<std::uint64_t>(point) >= mesh_.vertices.size())
      fail(at, "a cell names point " + std::to_string(point) + " of " + std::to_string(mesh_.vertices.size()));
    return static_cast<std::int32_t>(point);
  }

  void metadata() {
    rest_of_line();
    while (position() != end() && !rest_of_line().empty()) {
    }
  }

  void fields() {
    word();  // its name
    const std::size_t n = entities();
    for (std::size_t i = 0; i < n; ++i) {
      const char* const at = position();
      std::string name(word());
      if (in_capitals(name) == "METADATA") {
        metadata(), --i;
        continue;
      }
      const std::size_t components = entities(), tuples = entities();
      const LegacyName& of = type();
      if (of.type == LegacyType::text)
        strings(components * tuples);
      else
        take(std::move(name), components, tuples, of, at);
    }
  }

  /// A line each; in the binary form the length comes first, in one to eight bytes.
  void strings(std::size_t n) {
    rest_of_line();
    for (std::size_t i = 0; i < n && position() != end(); ++i) {
      if (!binary_) {
        rest_of_line();
        continue;
      }
      const auto first = static_cast<unsigned char>(*position());
      const std::size_t bytes = std::size_t{8} >> (first >> 6);
      std::uint64_t length = first & 63u;
      if (static_cast<std::size_t>(end() - position()) < bytes) fail(end(), "the file ends inside a string");
      for (std::size_t k = 1; k < bytes; ++k) length = length << 8 | static_cast<unsigned char>(position()[k]);
      if (length > static_cast<std::uint64_t>(end() - position()) - bytes) fail(end(), "the file ends inside a string");
      go_back(position() + bytes + length);
    }
  }

  void take(std::string name, std::size_t components, std::size_t tuples, const LegacyName& of, const char* at) {
    constexpr std::size_t max_components = 1000;
    if (components < 1 || components > max_components)
      fail(at, shown(name) + " has " + std::to_string(components) + " components");
    std::vector<double> values = numbers<double>(components * tuples, of);
    if (in_data_ && tuples == tuples_)
      data_.push_back({without_controls(name), on_vertices_, components, std::move(values), at});
  }

  /// SCALARS, VECTORS and their sisters.
  void attribute(const std::string& key, const char* at) {
    std::string name(word());
    if (key == "SCALARS") {
      const LegacyName& of = type();
      const std::string_view rest = rest_of_line();
      const std::size_t components = rest.size() == 1 && rest[0] >= '1' && rest[0] <= '4' ? std::size_t(rest[0] - '0') : 1;
      const char* const before = position();
      if (in_capitals(word()) != "LOOKUP_TABLE")
        go_back(binary_ ? before - 1 : before);  // numbers() takes the end of a line first
      else
        word();
      return take(std::move(name), components, tuples_, of, at);
    }
    if (key == "COLOR_SCALARS" || key == "LOOKUP_TABLE") {
      const std::size_t n = entities(), components = key == "LOOKUP_TABLE" ? 4 : n;
      (void)numbers<double>(components * (key == "LOOKUP_TABLE" ? n : tuples_), legacy_types[1]);
      return;
    }
    if (key == "TEXTURE_COORDINATES") {
      const std::size_t components = entities();
      return take(std::move(name), components, tuples_, type(), at);
    }
    const std::size_t components = key == "VECTORS" || key == "NORMALS" ? 3
                                   : key == "TENSORS"                   ? 9
                                   : key == "TENSORS6"                  ? 6
                                   : key == "GLOBAL_IDS" || key == "PEDIGREE_IDS" ? 1 : 0;
    if (components == 0) fail(at, "the name of a section was expected, not " + shown(key));
    take(std::move(name), components, tuples_, type(), at);
  }

  void add_data() {
    for (const Data& each : data_) {
      const std::size_t expected = each.on_vertices ? mesh_.vertices.size() : cells_;
      if (each.values.size() != expected * each.components) continue;
      if (each.name == "reference" && each.components == 1)
        add_references(each);
      else
        add_field(each);
    }
    mesh_.triangle_refs.resize(mesh_.triangles.size(), 0);
    mesh_.edge_refs.resize(mesh_.edges.size(), 0);
  }

  void add_references(const Data& data) {
    const auto ref = [&](std::size_t i) {
      const double value = data.values[i];
      const bool fits = std::abs(value) <= std::numeric_limits<std::int32_t>::max() && value == std::floor(value);
      if (!fits) fail(data.at, "a reference is not a number of 32 bits");
      return static_cast<std::int32_t>(value);
    };
    if (data.on_vertices)
      for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) mesh_.vertex_refs[v] = ref(v);
    mesh_.triangle_refs.clear(), mesh_.edge_refs.clear();
    if (data.on_vertices) return;
    for (const std::size_t cell : elements_.cell_of_triangle()) mesh_.triangle_refs.push_back(ref(cell));
    for (const std::size_t cell : elements_.cell_of_edge()) mesh_.edge_refs.push_back(ref(cell));
  }

  void add_field(const Data& data) {
    MeshField field{.name = data.name, .on_vertices = data.on_vertices, .components = static_cast<int>(data.components), .values = {}};
    const auto pick = [&](const std::vector<std::size_t>& cells, std::vector<double>& list) {
      for (const std::size_t cell : cells)
        for (std::size_t k = 0; k < data.components; ++k) list.push_back(data.values[cell * data.components + k]);
    };
    if (data.on_vertices)
      field.values = data.values;
    else
      pick(elements_.cell_of_triangle(), field.values), pick(elements_.cell_of_edge(), field.edge_values);
    mesh_.fields.push_back(std::move(field));
  }

  static constexpr std::int64_t vtk_points = 2, vtk_polyline = 4, vtk_strip = 6, vtk_polygon = 7;

  FlatMesh mesh_;
  VtkCells elements_;
  std::map<std::int64_t, Cells> sections_;  // by type of all their cells; 0: they have types
  std::vector<std::int64_t> types_;
  std::vector<Data> data_;
  std::size_t cells_ = 0, tuples_ = 0;
  bool binary_ = false, is_grid_ = false, has_points_ = false, has_types_ = false, on_vertices_ = true, in_data_ = false;
};

}  // namespace

FlatMesh read_mesh_vtk(std::string_view content, const std::string& name) {
  return LegacyReader(without_byte_order_mark(content), name).read();
}

}  // namespace carreau
