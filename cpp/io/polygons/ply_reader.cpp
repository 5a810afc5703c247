// SPDX-License-Identifier: BSD-3-Clause
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "io/mesh_files.h"
#include "io/polygons/polygon_cutter.h"
#include "io/raw_numbers.h"
#include "io/text.h"
#include "io/words.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

enum class Number { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class Form { ascii, little, big };

struct Property {
  Number type = Number::float32;
  std::optional<Number> count;  ///< of a list
  std::string name;
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;
};

struct TypeName {
  const char* name;
  Number type;
};
constexpr TypeName type_names[] = {
    {"char", Number::int8},   {"uchar", Number::uint8},   {"short", Number::int16},     {"ushort", Number::uint16},
    {"int", Number::int32},   {"uint", Number::uint32},   {"float", Number::float32},   {"double", Number::float64},
    {"int8", Number::int8},   {"uint8", Number::uint8},   {"int16", Number::int16},     {"uint16", Number::uint16},
    {"int32", Number::int32}, {"uint32", Number::uint32}, {"float32", Number::float32}, {"float64", Number::float64}};

constexpr std::size_t size_of(Number type) noexcept {
  switch (type) {
    case Number::int8:
    case Number::uint8:
      return 1;
    case Number::int16:
    case Number::uint16:
      return 2;
    case Number::float64:
      return 8;
    default:
      return 4;
  }
}

double raw_value(Number type, const char* at, bool swapped) noexcept {
  switch (type) {
    case Number::int8:
      return raw_number<std::int8_t>(at, swapped);
    case Number::uint8:
      return raw_number<std::uint8_t>(at, swapped);
    case Number::int16:
      return raw_number<std::int16_t>(at, swapped);
    case Number::uint16:
      return raw_number<std::uint16_t>(at, swapped);
    case Number::int32:
      return raw_number<std::int32_t>(at, swapped);
    case Number::uint32:
      return raw_number<std::uint32_t>(at, swapped);
    case Number::float32:
      return static_cast<double>(raw_number<float>(at, swapped));
    case Number::float64:
      return raw_number<double>(at, swapped);
  }
  return 0;
}

/// The header's words by lines, then numbers as the header declares.
class PlyReader : private Words {
 public:
  PlyReader(std::string_view text, const std::string& name) : Words(text, name), cutter_(mesh_) {}

  FlatMesh read() {
    read_header();
    bool vertices = false, faces = false;
    for (const Element& element : elements_) {
      if (element.name == "vertex") {
        if (vertices) fail(position(), "vertices are announced twice");
        vertices = true;
        read_vertices(element);
      } else if (element.name == "face") {
        if (!vertices) fail(position(), "faces come before the vertices");
        faces = true;
        read_faces(element);
      } else {
        skip(element);
      }
    }
    if (!vertices) fail(position(), "the file has no vertices");
    if (!faces) fail(position(), "the file has no faces: it is a cloud of points");
    mesh_.vertex_refs.assign(mesh_.vertices.size(), 0);
    return std::move(mesh_);
  }

 private:
  void read_header() {
    if (const std::string_view first = word(); first != "ply")
      fail(begin(first), "ply was expected, not " + shown(first));
    for (;;) {
      const std::string_view key = word();
      if (key.empty()) fail(Words::end(), "the file ends inside its header");
      if (key == "end_header") break;
      if (key == "format")
        read_form();
      else if (key == "element")
        read_element();
      else if (key == "property")
        read_property();
      else if (key != "comment" && key != "obj_info")
        fail(key.data(), "the header has an unknown word " + shown(key));
      rest_of_line();
    }
    rest_of_line();
    if (!form_) fail(position(), "the header does not give the format");
    if (form_ == Form::ascii) return;
    count_bytes();
    swapped_ = (form_ == Form::big) != (std::endian::native == std::endian::big);
  }

  [[nodiscard]] const char* begin(std::string_view found) const { return found.empty() ? Words::end() : found.data(); }

  void read_form() {
    const std::string_view name = word();
    if (name == "ascii")
      form_ = Form::ascii;
    else if (name == "binary_little_endian")
      form_ = Form::little;
    else if (name == "binary_big_endian")
      form_ = Form::big;
    else
      fail(begin(name), "the format should be ascii, binary_little_endian or binary_big_endian, not " + shown(name));
  }

  void read_element() {
    Element element;
    element.name = word();
    element.count = integer_64("the number of elements");
    if (element.count < 0 || element.count > std::numeric_limits<std::int32_t>::max())
      fail(position(), "the number of elements " + shown(element.name) +
                           " is negative or too large: " + std::to_string(element.count));
    elements_.push_back(std::move(element));
  }

  Number read_type() {
    const std::string_view name = word();
    for (const TypeName& known : type_names)
      if (name == known.name) return known.type;
    fail(begin(name), "the type of a number was expected, not " + shown(name));
  }

  void read_property() {
    if (elements_.empty()) fail(position(), "a property comes before the first element");
    Property property;
    const char* const before = position();
    if (word() == "list") {
      property.count = read_type();
    } else {
      go_back(before);
    }
    property.type = read_type();
    property.name = word();
    elements_.back().properties.push_back(std::move(property));
  }

  /// Elements without properties take no room, and are none.
  std::size_t count_of(const Element& element) {
    if (element.properties.empty()) return 0;
    if (form_ == Form::ascii)
      return checked_count(element.count, position(), "elements " + shown(element.name), element.properties.size());
    std::size_t bytes = 0;
    for (const Property& property : element.properties) bytes += size_of(property.count.value_or(property.type));
    need(static_cast<std::size_t>(element.count), bytes);
    return static_cast<std::size_t>(element.count);
  }

  void need(std::size_t n, std::size_t bytes_each) {
    const auto left = static_cast<std::size_t>(Words::end() - position());
    if (n > left / bytes_each)
      fail(position(), "the file ends too early: " + std::to_string(n) + " times " + std::to_string(bytes_each) +
                           " bytes are announced, and " + std::to_string(left) + " are left");
  }

  double next(Number type) {
    if (form_ == Form::ascii) return real_or_nan("a number");
    need(1, size_of(type));
    const double value = raw_value(type, position(), swapped_);
    go_back(position() + size_of(type));
    return value;
  }

  std::size_t next_count(const Property& property) {
    const char* const at = position();
    const double n = std::min(next(*property.count), 1e18);
    if (!(n >= 0) || n != std::floor(n)) fail(at, "the length of a list is " + std::to_string(n));
    if (form_ == Form::ascii)
      return checked_count(static_cast<std::int64_t>(n), at, "entries of a list", 1);
    need(static_cast<std::size_t>(n), size_of(property.type));
    return static_cast<std::size_t>(n);
  }

  void skip_property(const Property& property) {
    const std::size_t n = property.count ? next_count(property) : 1;
    for (std::size_t i = 0; i < n; ++i) next(property.type);
  }

  void skip(const Element& element) {
    for (std::size_t n = count_of(element), i = 0; i < n; ++i)
      for (const Property& property : element.properties) skip_property(property);
  }

  void read_vertices(const Element& element) {
    std::vector<int> axes(element.properties.size(), -1);
    int found = 0;
    for (std::size_t k = 0; k < axes.size(); ++k)
      for (int axis = 0; axis < 3; ++axis)
        if (!element.properties[k].count && element.properties[k].name == std::string(1, "xyz"[axis])) {
          axes[k] = axis;
          found |= 1 << axis;
        }
    if (found != 7) fail(position(), "the vertices have no x, y and z");
    mesh_.vertices.resize(count_of(element));
    for (Vec3& p : mesh_.vertices) {
      const char* const at = position();
      for (std::size_t k = 0; k < axes.size(); ++k)
        if (axes[k] < 0)
          skip_property(element.properties[k]);
        else
          p[axes[k]] = next(element.properties[k].type);
      if (!is_finite(p)) fail(at, "a coordinate of a vertex is not finite");
    }
  }

  void read_faces(const Element& element) {
    std::size_t which = element.properties.size();
    for (std::size_t k = 0; k < element.properties.size(); ++k)
      if (const Property& p = element.properties[k];
          p.count && (p.name == "vertex_indices" || p.name == "vertex_index"))
        which = k;
    if (which == element.properties.size()) fail(position(), "the faces have no list vertex_indices");
    std::vector<std::int32_t> corners;
    for (std::size_t n = count_of(element), i = 0; i < n; ++i) {
      const char* const at = position();
      for (std::size_t k = 0; k < element.properties.size(); ++k)
        if (k == which)
          read_corners(element.properties[k], corners);
        else
          skip_property(element.properties[k]);
      if (const std::string wrong = cutter_.add(corners, 0); !wrong.empty()) fail(at, wrong);
    }
  }

  void read_corners(const Property& property, std::vector<std::int32_t>& corners) {
    corners.resize(next_count(property));
    for (std::int32_t& v : corners) {
      const char* const at = position();
      const double value = next(property.type);
      if (!(value >= 0) || value != std::floor(value) || value >= static_cast<double>(mesh_.vertices.size()))
        fail(at,
             "a face names vertex " + format_number(value) + " (from 0) of " + std::to_string(mesh_.vertices.size()));
      v = static_cast<std::int32_t>(value);
    }
  }

  FlatMesh mesh_;
  PolygonCutter cutter_;
  std::vector<Element> elements_;
  std::optional<Form> form_;
  bool swapped_ = false;
};

}  // namespace

FlatMesh read_mesh_ply(std::string_view content, const std::string& name) { return PlyReader(content, name).read(); }

}  // namespace carreau
