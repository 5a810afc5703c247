#include <cmath>
#include <cstring>
#include <limits>

#include "io/gmf.h"
#include "io/mesh_files.h"
#include "support/error.h"

namespace carreau {

namespace {

constexpr std::int32_t swapped_one = 0x01000000;

class GmfReader {
 public:
  GmfReader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  FlatMesh read();

 private:
  [[noreturn]] void fail(std::size_t at, const std::string& sentence) const {
    throw FileError({.file = name_}, "byte " + std::to_string(at) + ": " + sentence);
  }

  template <typename T>
  T raw();
  std::int64_t integer(std::size_t size) { return size == 8 ? raw<std::int64_t>() : raw<std::int32_t>(); }
  std::int32_t reference();
  double coordinate();

  void header();
  bool section();
  std::size_t count(const char* what, std::size_t record);
  void dimension();
  void vertices();
  template <std::size_t N>
  void entities(const char* what, std::vector<std::array<std::int32_t, N>>& list, std::vector<std::int32_t>& refs,
                std::size_t& start);
  template <std::size_t N>
  void check_indices(const char* what, const std::vector<std::array<std::int32_t, N>>& list, std::size_t start) const;

  std::string_view bytes_;
  const std::string& name_;
  std::size_t pos_ = 0, section_end_ = 0;
  bool swap_ = false;
  int version_ = 0;
  GmfSizes sizes_{};
  FlatMesh mesh_;
  bool has_dimension_ = false, has_vertices_ = false;
  std::size_t edges_start_ = 0, triangles_start_ = 0;  ///< of the first record; 0: no section yet
};

/// The next number, whole within the file.
template <typename T>
T GmfReader::raw() {
  if (bytes_.size() - pos_ < sizeof(T)) fail(bytes_.size(), "the file ends inside a number");
  char copy[sizeof(T)];
  std::memcpy(copy, bytes_.data() + pos_, sizeof(T));
  if (swap_)
    for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(copy[i], copy[sizeof(T) - 1 - i]);
  T value;
  std::memcpy(&value, copy, sizeof(T));
  pos_ += sizeof(T);
  return value;
}

std::int32_t GmfReader::reference() {
  const std::size_t at = pos_;
  const std::int64_t value = integer(sizes_.index);
  if (value < std::numeric_limits<std::int32_t>::min() || value > std::numeric_limits<std::int32_t>::max())
    fail(at, "the number " + std::to_string(value) + " does not fit in 32 bits");
  return static_cast<std::int32_t>(value);
}

double GmfReader::coordinate() {
  const std::size_t at = pos_;
  const double value = sizes_.real == 4 ? static_cast<double>(raw<float>()) : raw<double>();
  if (!std::isfinite(value)) fail(at, "a coordinate is not finite");
  return value;
}

void GmfReader::header() {
  if (bytes_.size() < 8) fail(bytes_.size(), "the file ends inside the header");
  const auto cookie = raw<std::int32_t>();
  swap_ = cookie == swapped_one;
  if (cookie != 1 && !swap_) fail(0, "the file does not start with the mark of a binary mesh");
  version_ = raw<std::int32_t>();
  if (version_ < 1 || version_ > 4) fail(4, "version " + std::to_string(version_) + " is not one of 1, 2, 3, 4");
  sizes_ = gmf_sizes(version_);
}

/// Count of records, after the check that the section holds them all.
std::size_t GmfReader::count(const char* what, std::size_t record) {
  const std::size_t at = pos_;
  const std::int64_t n = integer(sizes_.count);
  const std::size_t room = pos_ <= section_end_ ? (section_end_ - pos_) / record : 0;
  if (pos_ > section_end_ || n < 0 || static_cast<std::uint64_t>(n) > room ||
      n > std::numeric_limits<std::int32_t>::max())
    fail(at, std::to_string(n) + " " + what + " are announced, but there is room for " + std::to_string(room));
  return static_cast<std::size_t>(n);
}

void GmfReader::dimension() {
  const std::size_t at = pos_;
  if (has_dimension_) fail(at, "the dimension is given twice");
  mesh_.dimension = raw<std::int32_t>();
  if (mesh_.dimension != 2 && mesh_.dimension != 3)
    fail(at, "the dimension is " + std::to_string(mesh_.dimension) + " instead of 2 or 3");
  has_dimension_ = true;
}

void GmfReader::vertices() {
  if (!has_dimension_) fail(pos_, "vertices come before the dimension");
  if (has_vertices_) fail(pos_, "vertices are given twice");
  has_vertices_ = true;
  const std::size_t n = count("vertices", static_cast<std::size_t>(mesh_.dimension) * sizes_.real + sizes_.index);
  mesh_.vertices.resize(n);
  mesh_.vertex_refs.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    Vec3& p = mesh_.vertices[i];
    p.x = coordinate();
    p.y = coordinate();
    if (mesh_.dimension == 3) p.z = coordinate();
    mesh_.vertex_refs[i] = reference();
  }
}

template <std::size_t N>
void GmfReader::entities(const char* what, std::vector<std::array<std::int32_t, N>>& list,
                         std::vector<std::int32_t>& refs, std::size_t& start) {
  if (start != 0) fail(pos_, std::string(what) + " are given twice");
  const std::size_t n = count(what, (N + 1) * sizes_.index);
  start = pos_;
  list.resize(n);
  refs.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::int32_t& vertex : list[i]) {
      const std::int32_t from_one = reference();
      // The smallest integer has no predecessor; any value below 0 is refused when all vertices are known.
      vertex = from_one > 0 ? from_one - 1 : -1;
    }
    refs[i] = reference();
  }
}

template <std::size_t N>
void GmfReader::check_indices(const char* what, const std::vector<std::array<std::int32_t, N>>& list,
                              std::size_t start) const {
  for (std::size_t i = 0; i < list.size(); ++i)
    for (const std::int32_t vertex : list[i])
      if (vertex < 0 || static_cast<std::size_t>(vertex) >= mesh_.vertices.size())
        fail(start + i * (N + 1) * sizes_.index, std::string(what) + " " + std::to_string(i + 1) +
                                                     " names a vertex that does not exist (there are " +
                                                     std::to_string(mesh_.vertices.size()) + ")");
}

/// False at the section `End`.
bool GmfReader::section() {
  const std::size_t start = pos_;
  if (bytes_.size() - pos_ < 4 + sizes_.position) fail(bytes_.size(), "the file ends before the section End");
  const auto code = raw<std::int32_t>();
  const std::int64_t next = integer(sizes_.position);
  if (code == static_cast<std::int32_t>(GmfCode::end)) return false;
  // Sections in ascending order: what every writer does, and what makes a loop impossible.
  if (next < static_cast<std::int64_t>(pos_) || static_cast<std::uint64_t>(next) > bytes_.size())
    fail(start,
         "section " + std::to_string(code) + " ends at " + std::to_string(next) + ", which is outside of the file");
  section_end_ = static_cast<std::size_t>(next);
  if (code == static_cast<std::int32_t>(GmfCode::dimension)) dimension();
  if (code == static_cast<std::int32_t>(GmfCode::vertices)) vertices();
  if (code == static_cast<std::int32_t>(GmfCode::edges)) entities("edges", mesh_.edges, mesh_.edge_refs, edges_start_);
  if (code == static_cast<std::int32_t>(GmfCode::triangles))
    entities("triangles", mesh_.triangles, mesh_.triangle_refs, triangles_start_);
  if (pos_ > section_end_) fail(start, "section " + std::to_string(code) + " is longer than it says");
  pos_ = section_end_;  // other sections are skipped whole
  return true;
}

FlatMesh GmfReader::read() {
  header();
  while (section()) {
  }
  if (!has_vertices_) fail(pos_, "the file has no vertices");
  check_indices("edge", mesh_.edges, edges_start_);
  check_indices("triangle", mesh_.triangles, triangles_start_);
  return std::move(mesh_);
}

}  // namespace

FlatMesh read_mesh_binary(std::string_view bytes, const std::string& name) { return GmfReader(bytes, name).read(); }

}  // namespace carreau
