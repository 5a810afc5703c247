// SPDX-License-Identifier: BSD-3-Clause
#include "volume/engine_files.h"

#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>
#include <unordered_map>

#include "base/failure.h"

namespace command {
namespace {

/// Words of a text file of numbers; '#' begins a comment.
class NumberFile {
 public:
  explicit NumberFile(const std::string& path) : name_(path.substr(path.rfind('/') + 1)) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw Failure("The engine wrote no file " + name_ + ".");
    std::ostringstream all;
    all << file.rdbuf();
    text_ = all.str();
    at_ = text_.c_str();
  }
  std::string word() {
    skip();
    const char* const start = at_;
    while (*at_ != 0 && !is_blank(*at_)) ++at_;
    return {start, at_};
  }
  double real() {
    skip();
    double x = 0;
    const auto [end, error] = std::from_chars(at_, text_.c_str() + text_.size(), x);
    if (error != std::errc() || !std::isfinite(x)) fail();
    at_ = end;
    return x;
  }
  std::int64_t integer(std::int64_t low, std::int64_t high) {
    const double x = real();  // TetGen's attributes are reals
    if (x != std::floor(x) || x < static_cast<double>(low) || x > static_cast<double>(high)) fail();
    return static_cast<std::int64_t>(x);
  }
  /// Goes behind a line that has this word alone; false at the end of the file.
  bool seek(const char* section) {
    while (*at_ != 0) {
      const std::string found = word();
      if (found == section) return true;
      end_line();
    }
    return false;
  }
  void require(const char* section) {
    if (!seek(section)) throw Failure("The engine's file " + name_ + " has no section " + section + ".");
  }
  void end_line() {
    while (*at_ != 0 && *at_ != '\n') ++at_;
  }
  [[noreturn]] void fail() const { throw Failure("The engine's file " + name_ + " is not as expected at byte " + std::to_string(at_ - text_.c_str()) + "."); }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }
  void skip() {
    while (is_blank(*at_) || *at_ == '#')
      if (*at_ == '#') end_line(); else ++at_;
  }
  std::string name_, text_;
  const char* at_ = nullptr;
};

constexpr std::int64_t most = 2147483647;
constexpr double same_place = 1e-9;  // of the diagonal: engines print 16 digits, and edges are longer

/// Vertices of the surface by cells of a lattice.
class Places {
 public:
  explicit Places(const SolidSurface& surface) : surface_(surface), cell_(4 * same_place * surface.diagonal) {
    for (std::size_t v = 0; v < surface.vertices.size(); ++v)
      cells_[key_of(surface.vertices[v], {0, 0, 0})].push_back(static_cast<std::int32_t>(v));
  }
  /// The nearest vertex at a place; -1: no vertex.
  [[nodiscard]] std::int32_t vertex_at(const Point& p) const {
    std::int32_t best = -1;
    double least = same_place * surface_.diagonal;
    for (int i = 0; i < 27; ++i) {
      const auto found = cells_.find(key_of(p, {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1}));
      if (found == cells_.end()) continue;
      for (const std::int32_t v : found->second) {
        const Point& q = surface_.vertices[static_cast<std::size_t>(v)];
        const double distance = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
        if (distance <= least) least = distance, best = v;
      }
    }
    return best;
  }

 private:
  [[nodiscard]] std::size_t key_of(const Point& p, const std::array<int, 3>& shift) const {
    std::size_t key = 0;
    for (std::size_t k = 0; k < 3; ++k) key = key * 1000003U + std::hash<double>{}(std::floor(p[k] / cell_) + shift[k]);
    return key;
  }
  const SolidSurface& surface_;
  double cell_;
  std::unordered_map<std::size_t, std::vector<std::int32_t>> cells_;
};

Point point_of(NumberFile& in) {
  Point p{};
  for (double& x : p) x = in.real();
  return p;
}

}  // namespace

void write_engine_file(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw Failure("'" + path + "' cannot be written: " + std::strerror(errno) + ".");
}

void read_tetgen(const std::string& base, VolumeMesh& volume) {
  NumberFile nodes(base + ".node"), elements(base + ".ele");
  const std::int64_t n = nodes.integer(0, most);
  (void)nodes.integer(3, 3);
  nodes.end_line();
  for (std::int64_t i = 0; i < n; ++i) {
    (void)nodes.integer(i + 1, i + 1);
    volume.vertices.push_back(point_of(nodes));
    nodes.end_line();
  }
  const std::int64_t m = elements.integer(0, most);
  (void)elements.integer(4, 4);
  const std::int64_t attributes = elements.integer(0, 1);
  for (std::int64_t i = 0; i < m; ++i) {
    (void)elements.integer(0, most);
    auto& tetrahedron = volume.tetrahedra.emplace_back();
    for (std::int32_t& v : tetrahedron) v = static_cast<std::int32_t>(elements.integer(1, n) - 1);
    volume.solids.push_back(attributes == 1 ? static_cast<std::int32_t>(elements.integer(-most, most)) : 1);
  }
}

void read_gmsh(const std::string& path, VolumeMesh& volume) {
  NumberFile in(path);
  in.require("$Nodes");
  const std::int64_t n = in.integer(0, most);
  // Gmsh numbers nodes anew. Vertices of the surface are found by their places, and others follow in the order of the file.
  const std::size_t given = volume.surface.vertices.size();
  volume.vertices.resize(given);
  std::vector<bool> known(given, false);
  const Places places(volume.surface);
  std::unordered_map<std::int64_t, std::int32_t> index;
  for (std::int64_t i = 0; i < n; ++i) {
    const std::int64_t number = in.integer(1, most);
    const Point p = point_of(in);
    if (const std::int32_t v = places.vertex_at(p); v >= 0 && !known[static_cast<std::size_t>(v)]) {
      volume.vertices[static_cast<std::size_t>(v)] = p, known[static_cast<std::size_t>(v)] = true;
      index[number] = v;
    } else {
      index[number] = static_cast<std::int32_t>(volume.vertices.size());
      volume.vertices.push_back(p);
    }
  }
  for (std::size_t v = 0; v < given; ++v)
    if (!known[v]) throw Failure("The engine gmsh moved or left out vertex " + std::to_string(v + 1) + " of the surface.");
  in.require("$Elements");
  const std::int64_t m = in.integer(0, most);
  constexpr std::int64_t tetrahedron_type = 4;
  for (std::int64_t i = 0; i < m; ++i) {
    (void)in.integer(0, most);
    const std::int64_t type = in.integer(0, most), tags = in.integer(0, 100);
    std::int64_t entity = 0;
    for (std::int64_t k = 0; k < tags; ++k) {
      const std::int64_t tag = in.integer(-most, most);
      if (k == 1) entity = tag;
    }
    if (type == tetrahedron_type) {
      auto& tetrahedron = volume.tetrahedra.emplace_back();
      for (std::int32_t& v : tetrahedron) {
        const auto found = index.find(in.integer(1, most));
        if (found == index.end()) in.fail();
        v = found->second;
      }
      volume.solids.push_back(static_cast<std::int32_t>(entity));
    }
    in.end_line();
  }
}

void read_netgen(const std::string& path, const std::vector<std::int32_t>& numbers, VolumeMesh& volume) {
  NumberFile in(path);
  in.require("volumeelements");
  const std::int64_t m = in.integer(0, most);
  for (std::int64_t i = 0; i < m; ++i) {
    volume.solids.push_back(numbers[static_cast<std::size_t>(in.integer(1, static_cast<std::int64_t>(numbers.size())) - 1)]);
    (void)in.integer(4, 4);
    auto& tetrahedron = volume.tetrahedra.emplace_back();
    for (std::int32_t& v : tetrahedron) v = static_cast<std::int32_t>(in.integer(1, most) - 1);
  }
  in.require("points");
  const std::int64_t n = in.integer(0, most);
  for (std::int64_t i = 0; i < n; ++i) volume.vertices.push_back(point_of(in));
  for (const auto& tetrahedron : volume.tetrahedra)
    for (const std::int32_t v : tetrahedron)
      if (v >= n) in.fail();
}

}  // namespace command
