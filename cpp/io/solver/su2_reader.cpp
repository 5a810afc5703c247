// SPDX-License-Identifier: BSD-3-Clause
// SU2's native format: elements of the plane with markers as curves, or the markers of a volume as the faces of its surface.
#include <algorithm>
#include <array>
#include <set>

#include "io/element_lists.h"
#include "io/mesh_files.h"
#include "io/solid_skin.h"
#include "io/solver/solver_names.h"
#include "io/text.h"
#include "io/words.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

constexpr int line_type = 3, triangle_type = 5, quad_type = 9, tetrahedron_type = 10;

class Su2Reader {
 public:
  Su2Reader(std::string_view text, const std::string& name) : in_(text, name, '%') {
    refuse_zero_bytes(in_, text);
  }

  FlatMesh read() {
    for (std::string_view word = in_.word(); !word.empty(); word = in_.word()) {
      const std::string key = key_of(word);
      if (key == "NDIME")
        dimension(word.data());
      else if (key == "NELEM")
        elements(in_.count("the number of elements", 2), false);
      else if (key == "NPOIN")
        points();
      else if (key == "MARKER_TAG")
        tag_ = std::string(in_.rest_of_line()), tag_ = without_controls(trimmed(std::string_view(tag_).substr(0, tag_.find('%'))));
      else if (key == "MARKER_ELEMS")
        elements(in_.count("the number of elements of a marker", 2), true);
      else
        in_.rest_of_line();  // additions of other programs
    }
    return finished();
  }

 private:
  /// "NDIME=", "NDIME" before "=", or "NDIME=2" as one word: the number follows.
  std::string key_of(std::string_view word) {
    const std::size_t equals = word.find('=');
    if (equals != std::string_view::npos) {
      in_.go_back(word.data() + equals + 1);
      return in_capitals(word.substr(0, equals));
    }
    const char* const at = in_.position();
    const std::string_view next = in_.word();
    in_.go_back(next.starts_with('=') ? next.data() + 1 : at);
    return next.starts_with('=') ? in_capitals(word) : "";
  }

  void dimension(const char* at) {
    // Points that were read with another dimension would keep a coordinate that the mesh does not have.
    if (dimension_ != 0) in_.fail(at, "NDIME comes twice");
    dimension_ = in_.integer("the dimension");
    if (dimension_ != 2 && dimension_ != 3) in_.fail(at, "the dimension is " + std::to_string(dimension_) + " instead of 2 or 3");
  }

  void points() {
    if (dimension_ == 0) in_.fail(in_.position(), "NPOIN comes before NDIME");
    if (!mesh_.vertices.empty()) in_.fail(in_.position(), "NPOIN comes twice");
    const std::size_t n = in_.count("the number of points", static_cast<std::size_t>(dimension_));
    in_.rest_of_line();  // a second number counts the elements without halos
    for (std::size_t i = 0; i < n; ++i) {
      Vec3 p;
      for (int x = 0; x < dimension_; ++x) p[x] = in_.real("a coordinate of a point");
      in_.rest_of_line();  // its number
      mesh_.vertices.push_back(p);
    }
  }

  /// Vertices of a type of VTK; 0: there is no such type.
  static std::size_t vertices_of(std::int32_t type) noexcept {
    static constexpr std::array<std::array<int, 2>, 8> known{
        {{1, 1}, {line_type, 2}, {triangle_type, 3}, {quad_type, 4}, {10, 4}, {12, 8}, {13, 6}, {14, 5}}};
    for (const auto& [each, n] : known)
      if (each == type) return static_cast<std::size_t>(n);
    return 0;
  }

  static std::optional<SolidShape> solid_of(std::int32_t type) noexcept {
    if (type < tetrahedron_type) return std::nullopt;
    return shape_of_corners(vertices_of(type));
  }

  void elements(std::size_t n, bool of_marker) {
    in_.rest_of_line();
    const std::int32_t ref = of_marker ? marker() : -1;
    for (std::size_t i = 0; i < n; ++i) {
      const std::int32_t type = in_.integer("the type of an element");
      const char* const at = in_.position();
      const std::size_t count = vertices_of(type);
      if (count == 0) in_.fail(at, "an element has type " + std::to_string(type) + ", which is not known");
      std::array<std::int32_t, 8> nodes{};
      for (std::size_t k = 0; k < count; ++k) nodes[k] = in_.integer("a vertex of an element");
      in_.rest_of_line();
      add(type, nodes, ref, at);
    }
  }

  void add(std::int32_t type, const std::array<std::int32_t, 8>& n, std::int32_t ref, const char* at) {
    const std::size_t count = type == 1 ? 0 : vertices_of(type);
    for (std::size_t k = 0; k < count; ++k)
      if (n[k] < 0) in_.fail(at, "vertex " + std::to_string(n[k]) + " is named");
      else if (n[k] > largest_) largest_ = n[k], largest_at_ = at;
    if (type == line_type) lists_.edges.nodes.push_back({n[0], n[1]}), lists_.edges.refs.push_back(ref);
    if (type == triangle_type) lists_.triangles.nodes.push_back({n[0], n[1], n[2]}), lists_.triangles.refs.push_back(ref);
    if (const auto solid = solid_of(type)) {
      skin_.add(*solid, std::span(n).first(count), std::max(ref, 0));
      if (type == tetrahedron_type) mesh_.tetrahedra.push_back({n[0], n[1], n[2], n[3]});
    }
    if (type == quad_type) lists_.quads.nodes.push_back({n[0], n[1], n[2], n[3]}), lists_.quads.refs.push_back(ref);
  }

  /// The reference of elements until the end: the number of their marker, from 0; -1: no marker.
  std::int32_t marker() {
    const auto found = std::ranges::find(tags_, tag_);
    if (found == tags_.end()) return tags_.push_back(tag_), static_cast<std::int32_t>(tags_.size()) - 1;
    return static_cast<std::int32_t>(found - tags_.begin());
  }

  /// References of markers: from their names, otherwise the least unused numbers.
  std::vector<std::int32_t> references() {
    const char* const before = dimension_ == 2 ? "curve_" : "face_";
    std::vector<std::int32_t> refs(tags_.size(), 0);
    std::vector<bool> own(tags_.size());
    std::set<std::int32_t> taken;
    for (std::size_t i = 0; i < refs.size(); ++i)
      if (own[i] = reference_in(tags_[i], before, refs[i]); own[i]) taken.insert(refs[i]);
    std::int32_t next = 0;
    for (std::size_t i = 0; i < refs.size(); ++i) {
      if (own[i]) continue;
      do ++next;
      while (taken.contains(next));
      refs[i] = next;
      if (dimension_ == 3) mesh_.faces.push_back({.ref = next, .status = FaceStatus::meshed, .name = tags_[i]});
    }
    return refs;
  }

  FlatMesh finished() {
    if (mesh_.vertices.empty()) in_.fail(in_.end(), "the file has no points");
    if (largest_ >= static_cast<std::int64_t>(mesh_.vertices.size()))
      in_.fail(largest_at_, "vertex " + std::to_string(largest_) + " (from 0) is named, but there are " +
                                std::to_string(mesh_.vertices.size()));
    const std::vector<std::int32_t> refs = references();
    for (std::vector<std::int32_t>* list : {&lists_.edges.refs, &lists_.triangles.refs, &lists_.quads.refs})
      for (std::int32_t& ref : *list) ref = ref < 0 ? 0 : refs[static_cast<std::size_t>(ref)];
    skin_.give_to(lists_, mesh_.vertices);
    mesh_.dimension = dimension_;
    mesh_.vertex_refs.assign(mesh_.vertices.size(), 0);
    set_elements(lists_, mesh_);
    std::erase_if(mesh_.faces, [&](const FlatFace& face) {
      return std::ranges::find(mesh_.triangle_refs, face.ref) == mesh_.triangle_refs.end();
    });
    return std::move(mesh_);
  }

  Words in_;
  FlatMesh mesh_;
  ElementLists lists_;
  SolidSkin skin_;
  std::int32_t dimension_ = 0;
  std::string tag_;
  std::vector<std::string> tags_;
  std::int64_t largest_ = -1;
  const char* largest_at_ = nullptr;
};

}  // namespace

FlatMesh read_mesh_su2(std::string_view text, const std::string& name) {
  return Su2Reader(without_byte_order_mark(text), name).read();
}

}  // namespace carreau
