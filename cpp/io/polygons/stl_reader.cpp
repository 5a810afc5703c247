// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "io/mesh_files.h"
#include "io/raw_numbers.h"
#include "io/text.h"
#include "io/words.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

constexpr std::size_t header_size = 80, facet_size = 50;

/// Points become one vertex when their coordinates are equal: a table of numbers of vertices with open addresses.
class JoinedPoints {
 public:
  std::int32_t add(std::vector<Vec3>& vertices, const Vec3& p) {
    if (2 * (vertices.size() + 1) > slots_.size()) grow(vertices);
    std::int32_t& slot = find(vertices, p);
    if (slot == free_slot) {
      if (vertices.size() >= std::numeric_limits<std::int32_t>::max())
        throw LimitError("an STL file has more than 2147483647 different vertices");
      slot = static_cast<std::int32_t>(vertices.size());
      vertices.push_back(p);
    }
    return slot;
  }

 private:
  static constexpr std::int32_t free_slot = -1;

  static std::size_t hash(const Vec3& p) noexcept {
    std::uint64_t hash = 0;
    for (const double x : {p.x(), p.y(), p.z()}) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(x + 0.0)) * 0x9e3779b97f4a7c15u;  // -0 and 0 are equal
      hash ^= hash >> 32;
    }
    return hash;
  }
  std::int32_t& find(const std::vector<Vec3>& vertices, const Vec3& p) {
    std::size_t k = hash(p) & (slots_.size() - 1);
    while (slots_[k] != free_slot && vertices[static_cast<std::size_t>(slots_[k])] != p)
      k = (k + 1) & (slots_.size() - 1);
    return slots_[k];
  }
  void grow(const std::vector<Vec3>& vertices) {
    slots_.assign(std::max<std::size_t>(1024, 4 * slots_.size()), free_slot);
    for (std::size_t v = 0; v < vertices.size(); ++v) find(vertices, vertices[v]) = static_cast<std::int32_t>(v);
  }

  std::vector<std::int32_t> slots_;  // a power of two
};

bool same_word(std::string_view found, std::string_view lower) noexcept {
  return std::equal(found.begin(), found.end(), lower.begin(), lower.end(),
                    [](char a, char b) { return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b; });
}

class TextReader {
 public:
  TextReader(std::string_view text, const std::string& name) : in_(text, name) {}

  FlatMesh read() {
    for (std::string_view word = in_.word(); !word.empty(); word = in_.word()) {
      if (!same_word(word, "solid")) in_.fail(word.data(), "solid was expected, not " + shown(word));
      solid();
    }
    if (solids_.empty()) in_.fail(in_.end(), "the file is empty");
    give_references();
    mesh_.vertex_refs.assign(mesh_.vertices.size(), 0);
    return std::move(mesh_);
  }

 private:
  struct Solid {
    std::string name;
    std::size_t end = 0;  // of its triangles
  };

  /// "endfacet", "end facet" or "end".
  void expect_end(std::string_view what) {
    const std::string_view word = in_.word();
    if (word.empty()) in_.fail(in_.end(), "the file ends where end" + std::string(what) + " was expected");
    if (same_word(word, "end"))
      in_.rest_of_line();
    else if (!same_word(word.substr(0, 3), "end") || !same_word(word.substr(3), what))
      in_.fail(word.data(), "end" + std::string(what) + " was expected, not " + shown(word));
  }

  void expect(std::string_view wanted) {
    const std::string_view word = in_.word();
    if (word.empty()) in_.fail(in_.end(), "the file ends where " + std::string(wanted) + " was expected");
    if (!same_word(word, wanted)) in_.fail(word.data(), std::string(wanted) + " was expected, not " + shown(word));
  }

  void solid() {
    solids_.push_back({.name = without_controls(in_.rest_of_line())});
    for (;;) {
      const std::string_view word = in_.word();
      if (word.empty()) in_.fail(in_.end(), "the file ends inside a solid: it may be truncated");
      const bool cut_off = word.data() + word.size() == in_.end();  // perhaps inside endsolid
      if (same_word(word, "endsolid") || (same_word(word, "end") && !cut_off)) break;
      if (!same_word(word, "facet")) in_.fail(word.data(), "facet or endsolid was expected, not " + shown(word));
      facet();
    }
    in_.rest_of_line();
    solids_.back().end = mesh_.triangles.size();
  }

  void facet() {
    // Normals are of no use, often not numbers, and may be missing.
    const char* const at = in_.position();
    std::string_view word = in_.word();
    if (same_word(word, "normal"))
      for (int k = 0; k < 4 && !same_word(word = in_.word(), "outer");) ++k;
    else if (!same_word(word, "outer"))
      in_.go_back(at), expect("normal");
    if (!same_word(word, "outer")) in_.go_back(word.empty() ? in_.end() : word.data()), expect("outer");
    expect("loop");
    std::array<std::int32_t, 3> corners{};
    for (std::int32_t& corner : corners) {
      expect("vertex");
      Vec3 p;
      p.x() = in_.real("a coordinate of a vertex");
      p.y() = in_.real("a coordinate of a vertex");
      p.z() = in_.real("a coordinate of a vertex");
      corner = points_.add(mesh_.vertices, p);
    }
    expect_end("loop");
    expect_end("facet");
    mesh_.triangles.push_back(corners);
  }

  /// Solids are faces. "surface_7" has reference 7, as the writer calls faces without a name; others get the smallest
  /// positive ones that are left, in order.
  void give_references() {
    constexpr std::string_view prefix = "surface_";
    std::vector<std::int32_t> refs(solids_.size(), 0);
    std::vector<bool> known(solids_.size(), false);
    std::set<std::int32_t> taken;
    for (std::size_t i = 0; i < solids_.size(); ++i) {
      const std::string_view name = solids_[i].name;
      if (!name.starts_with(prefix) || !parse_number(name.substr(prefix.size()), refs[i])) continue;
      known[i] = std::string(prefix) + std::to_string(refs[i]) == name && taken.insert(refs[i]).second;
    }
    std::int32_t next = 1;
    mesh_.triangle_refs.reserve(mesh_.triangles.size());
    for (std::size_t i = 0; i < solids_.size(); ++i) {
      if (!known[i]) {
        while (taken.contains(next)) ++next;
        refs[i] = next++;
      }
      const std::string& name = solids_[i].name;
      const bool any = solids_[i].end > mesh_.triangle_refs.size();
      if (!known[i] && !name.empty() && any)
        mesh_.faces.push_back({.ref = refs[i], .status = FaceStatus::meshed, .name = name});
      mesh_.triangle_refs.resize(solids_[i].end, refs[i]);
    }
  }

  Words in_;
  FlatMesh mesh_;
  JoinedPoints points_;
  std::vector<Solid> solids_;
};

/// Number of triangles at the place of the count in the binary form.
std::size_t announced(std::string_view bytes) noexcept {
  std::size_t n = 0;  // little-endian whatever the machine
  for (std::size_t k = 0; k < 4; ++k)
    n |= static_cast<std::size_t>(static_cast<unsigned char>(bytes[header_size + k])) << (8 * k);
  return n;
}

FlatMesh read_binary(std::string_view bytes, const std::string& name) {
  FlatMesh mesh;
  JoinedPoints points;
  const std::size_t n = announced(bytes);
  mesh.triangles.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t corners = header_size + 4 + i * facet_size + 12;  // behind the normal
    auto& triangle = mesh.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      double x[3];
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t at = corners + 12 * k + 4 * c;
        x[c] = static_cast<double>(raw_number<float>(bytes.data() + at, std::endian::native != std::endian::little));
        if (!std::isfinite(x[c]))
          throw FileError({.file = name}, "byte " + std::to_string(at) + ": a coordinate is not finite");
      }
      triangle[k] = points.add(mesh.vertices, {x[0], x[1], x[2]});
    }
  }
  mesh.vertex_refs.assign(mesh.vertices.size(), 0);
  mesh.triangle_refs.assign(mesh.triangles.size(), 0);
  return mesh;
}

}  // namespace

FlatMesh read_mesh_stl(std::string_view content, const std::string& name) {
  // Some binary files start with "solid" too; their length distinguishes them.
  const bool has_count = content.size() >= header_size + 4;
  if (has_count && content.size() - header_size - 4 == facet_size * announced(content))
    return read_binary(content, name);
  const std::string_view text = without_byte_order_mark(content);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || same_word(text.substr(first, 5), "solid"))
    return TextReader(text, name).read();
  if (!has_count)
    throw FileError({.file = name}, "the file is neither STL text, which starts with solid, nor binary STL");
  throw FileError({.file = name}, "the file does not start with solid, as STL text does, and binary STL of " +
                                      std::to_string(announced(content)) + " triangles has " +
                                      std::to_string(header_size + 4 + facet_size * announced(content)) +
                                      " bytes instead of " + std::to_string(content.size()));
}

}  // namespace carreau
