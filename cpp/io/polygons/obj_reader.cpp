// SPDX-License-Identifier: BSD-3-Clause
#include <limits>
#include <map>

#include "io/mesh_files.h"
#include "io/polygons/polygon_cutter.h"
#include "io/text.h"
#include "io/words.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

std::string_view next_word(std::string_view& line) {
  const auto blank = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
  while (!line.empty() && blank(line.front())) line.remove_prefix(1);
  std::size_t n = 0;
  while (n < line.size() && !blank(line[n])) ++n;
  const std::string_view word = line.substr(0, n);
  line.remove_prefix(n);
  return word;
}

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::string& name) : in_(text, name), cutter_(mesh_) {}

  FlatMesh read() {
    while (in_.position() != in_.end()) {
      std::string_view line = in_.rest_of_line();
      line = line.substr(0, line.find('#'));
      const std::string_view key = next_word(line);
      if (key == "v")
        vertex(line);
      else if (key == "f")
        face(line);
      else if (key == "l")
        polyline(line);
      else if (key == "g" || key == "o")
        group(next_word(line));
    }
    if (mesh_.vertices.empty()) in_.fail(in_.end(), "the file has no vertices");
    mesh_.vertex_refs.assign(mesh_.vertices.size(), 0);
    mesh_.edge_refs.assign(mesh_.edges.size(), 0);
    for (const auto& [name, ref] : refs_)
      if (used_[static_cast<std::size_t>(ref)])
        mesh_.faces.push_back({.ref = ref, .status = FaceStatus::meshed, .name = name});
    return std::move(mesh_);
  }

 private:
  void vertex(std::string_view line) {
    const char* const at = line.data();
    if (mesh_.vertices.size() == std::numeric_limits<std::int32_t>::max()) in_.fail(at, "there are too many vertices");
    Vec3 p;
    for (int k = 0; k < 3; ++k) {
      const std::string_view word = next_word(line);
      if (word.empty()) in_.fail(at, "a vertex has fewer than three coordinates");
      if (!parse_number(word, p[k])) in_.fail(word.data(), "a coordinate should be a number, not " + shown(word));
    }
    if (!is_finite(p)) in_.fail(at, "a coordinate of a vertex is not finite");
    mesh_.vertices.push_back(p);
  }

  /// Vertices from 1, or from the last one back: -1. Numbers behind a slash refer to textures and normals.
  bool corners(std::string_view line) {
    corners_.clear();
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
      const std::string_view number = word.substr(0, word.find('/'));
      int v = 0;
      if (!parse_number(number, v)) in_.fail(word.data(), "the number of a vertex was expected, not " + shown(word));
      const auto known = static_cast<std::int64_t>(mesh_.vertices.size());
      const std::int64_t index = v < 0 ? known + v : std::int64_t{v} - 1;
      if (index < 0 || index >= known)
        in_.fail(word.data(), "vertex " + std::to_string(v) + " is named, but there are " + std::to_string(known));
      corners_.push_back(static_cast<std::int32_t>(index));
    }
    return !corners_.empty();
  }

  void face(std::string_view line) {
    const char* const at = line.data();
    corners(line);
    if (const std::string wrong = cutter_.add(corners_, ref_); !wrong.empty()) in_.fail(at, wrong);
    used_[static_cast<std::size_t>(ref_)] = true;
  }

  void polyline(std::string_view line) {
    corners(line);
    for (std::size_t i = 1; i < corners_.size(); ++i) mesh_.edges.push_back({corners_[i - 1], corners_[i]});
  }

  /// Groups and objects are faces, numbered as their names come first.
  void group(std::string_view name) {
    if (name.empty()) name = "default";
    ref_ = refs_.try_emplace(without_controls(name), static_cast<std::int32_t>(refs_.size()) + 1).first->second;
    used_.resize(refs_.size() + 1, false);
  }

  Words in_;
  FlatMesh mesh_;
  PolygonCutter cutter_;
  std::vector<std::int32_t> corners_;
  std::map<std::string, std::int32_t> refs_;
  std::vector<bool> used_ = {false};  ///< by reference
  std::int32_t ref_ = 0;
};

}  // namespace

FlatMesh read_mesh_obj(std::string_view content, const std::string& name) {
  return ObjReader(without_byte_order_mark(content), name).read();
}

}  // namespace carreau
