#include <charconv>
#include <cmath>
#include <limits>

#include "io/mesh_files.h"
#include "io/text.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

constexpr bool is_blank(char c) noexcept { return c == ' ' || (c >= '\t' && c <= '\r'); }
constexpr bool ends_word(char c) noexcept { return is_blank(c) || c == '#'; }
constexpr bool is_letter(char c) noexcept { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Beginnings of the names of sections that the format knows and a surface mesh can do without. A name that is none of
/// these is an error: a misspelt "Triangels" must not pass for a mesh without triangles.
constexpr std::string_view skipped_sections[] = {"AngleOfCornerBound",
                                                 "BezierBasis",
                                                 "BoundaryLayers",
                                                 "BoundaryPolygon",
                                                 "BoundingBox",
                                                 "CoarseHexahedra",
                                                 "Corners",
                                                 "CrackedEdges",
                                                 "DRefGroups",
                                                 "DSolAt",
                                                 "Domains",
                                                 "EdgeOn",
                                                 "EdgesGID",
                                                 "EdgesOn",
                                                 "EdgesP",
                                                 "EdgesReference",
                                                 "ExtraVertices",
                                                 "Fault_",
                                                 "FloatingPoint",
                                                 "Geometry",
                                                 "HOSolAt",
                                                 "Hexahedr",
                                                 "IRefGroups",
                                                 "ISolAt",
                                                 "Identifier",
                                                 "InnerPolygon",
                                                 "Iterations",
                                                 "MaximalAngle",
                                                 "NormalAt",
                                                 "Normals",
                                                 "Periodic",
                                                 "Polygons",
                                                 "Polyhedra",
                                                 "Prism",
                                                 "Pyramid",
                                                 "Quadrilateral",
                                                 "Required",
                                                 "Ridges",
                                                 "SolAt",
                                                 "SubDomain",
                                                 "Tangent",
                                                 "Tetrahedr",
                                                 "Time",
                                                 "TriangleReference",
                                                 "TrianglesGID",
                                                 "TrianglesOn",
                                                 "TrianglesP",
                                                 "VertexOn",
                                                 "VerticesGID",
                                                 "VerticesOn"};

bool is_skipped(std::string_view name) {
  for (const std::string_view start : skipped_sections)
    if (name.starts_with(start)) return true;
  return false;
}

class MeditReader {
 public:
  MeditReader(std::string_view text, const std::string& name)
      : text_(text), name_(name), p_(text.data()), end_(text.data() + text.size()) {}

  FlatMesh read();

 private:
  [[noreturn]] void fail(const char* at, const std::string& sentence) const {
    throw FileError({.file = name_, .line = line_at(text_, static_cast<std::size_t>(at - text_.data()))}, sentence);
  }

  void skip_blanks() {
    while (p_ != end_) {
      if (*p_ == '#')
        while (p_ != end_ && *p_ != '\n') ++p_;
      else if (is_blank(*p_))
        ++p_;
      else
        return;
    }
  }
  std::string_view word();
  std::string_view number_word(const char* what);
  double real(const char* what);
  std::int32_t integer(const char* what);

  void header();
  bool section();
  std::size_t count(const std::string& what, std::size_t words_each);
  void vertices();
  template <std::size_t N>
  void entities(const std::string& what, std::vector<std::array<std::int32_t, N>>& list,
                std::vector<std::int32_t>& refs, const char*& start);
  template <std::size_t N>
  void check_indices(const char* what, const std::vector<std::array<std::int32_t, N>>& list, const char* start);
  void skip_section();

  std::string_view text_;
  const std::string& name_;
  const char* p_;
  const char* end_;
  FlatMesh mesh_;
  bool has_dimension_ = false, has_vertices_ = false;
  const char* edges_start_ = nullptr;  ///< of the first record; null: no section yet
  const char* triangles_start_ = nullptr;
};

/// Empty at the end of the text.
std::string_view MeditReader::word() {
  skip_blanks();
  const char* begin = p_;
  while (p_ != end_ && !ends_word(*p_)) ++p_;
  return {begin, static_cast<std::size_t>(p_ - begin)};
}

std::string_view MeditReader::number_word(const char* what) {
  const std::string_view found = word();
  if (found.empty()) fail(end_, std::string("the file ends where ") + what + " was expected");
  return found;
}

double MeditReader::real(const char* what) {
  skip_blanks();
  double value = 0;
  const auto result = std::from_chars(p_, end_, value);
  if (result.ec == std::errc{} && (result.ptr == end_ || ends_word(*result.ptr)) && std::isfinite(value)) {
    p_ = result.ptr;
    return value;
  }
  // The slow path knows Fortran's exponents and the plus sign, and finds out what is wrong.
  const std::string_view found = number_word(what);
  if (!parse_number(found, value)) fail(found.data(), std::string(what) + " should be a number, not " + shown(found));
  if (!std::isfinite(value)) fail(found.data(), std::string(what) + " is not finite: " + shown(found));
  return value;
}

std::int32_t MeditReader::integer(const char* what) {
  skip_blanks();
  std::int32_t value = 0;
  const auto result = std::from_chars(p_, end_, value);
  if (result.ec == std::errc{} && (result.ptr == end_ || ends_word(*result.ptr))) {
    p_ = result.ptr;
    return value;
  }
  const std::string_view found = number_word(what);
  int parsed = 0;
  if (!parse_number(found, parsed))
    fail(found.data(), std::string(what) + " should be an integer of 32 bits, not " + shown(found));
  return parsed;
}

void MeditReader::header() {
  const std::string_view first = word();
  if (first.empty()) fail(end_, "the file is empty");
  if (first != "MeshVersionFormatted")
    fail(first.data(), "a mesh file starts with MeshVersionFormatted, not with " + shown(first));
  const int version = integer("the version");
  if (version < 0 || version > 4) fail(p_, "version " + std::to_string(version) + " is not one of 0, 1, 2, 3, 4");
}

std::size_t MeditReader::count(const std::string& what, std::size_t words_each) {
  const std::int32_t n = integer(("the number of " + what).c_str());
  if (n < 0) fail(p_, "the number of " + what + " is negative: " + std::to_string(n));
  // A number takes two characters, its separator included.
  const std::size_t room = static_cast<std::size_t>(end_ - p_) / (2 * words_each);
  if (static_cast<std::size_t>(n) > room)
    fail(p_, std::to_string(n) + " " + what + " are announced, but the rest of the file has room for at most " +
                 std::to_string(room));
  return static_cast<std::size_t>(n);
}

void MeditReader::vertices() {
  if (!has_dimension_) fail(p_, "Vertices comes before Dimension");
  if (has_vertices_) fail(p_, "Vertices comes twice");
  has_vertices_ = true;
  const std::size_t n = count("vertices", static_cast<std::size_t>(mesh_.dimension) + 1);
  mesh_.vertices.resize(n);
  mesh_.vertex_refs.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    Vec3& p = mesh_.vertices[i];
    p.x = real("a coordinate of a vertex");
    p.y = real("a coordinate of a vertex");
    if (mesh_.dimension == 3) p.z = real("a coordinate of a vertex");
    mesh_.vertex_refs[i] = integer("the reference of a vertex");
  }
}

template <std::size_t N>
void MeditReader::entities(const std::string& what, std::vector<std::array<std::int32_t, N>>& list,
                           std::vector<std::int32_t>& refs, const char*& start) {
  if (start != nullptr) fail(p_, what + " come twice");
  const std::size_t n = count(what, N + 1);
  start = p_;
  list.resize(n);
  refs.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::int32_t& vertex : list[i]) {
      const std::int32_t from_one = integer("the number of a vertex");
      vertex = from_one > 0 ? from_one - 1 : -1;  // refused by check_indices, when all vertices are known
    }
    refs[i] = integer("a reference");
  }
}

template <std::size_t N>
void MeditReader::check_indices(const char* what, const std::vector<std::array<std::int32_t, N>>& list,
                                const char* start) {
  for (std::size_t i = 0; i < list.size(); ++i)
    for (std::size_t k = 0; k < N; ++k) {
      if (list[i][k] >= 0 && static_cast<std::size_t>(list[i][k]) < mesh_.vertices.size()) continue;
      // Lines are not kept: the words are counted again to find this one.
      p_ = start;
      for (std::size_t skipped = 0; skipped < i * (N + 1) + k; ++skipped) word();
      const std::string_view found = word();
      fail(found.data(), std::string(what) + " " + std::to_string(i + 1) + " names vertex " + std::string(found) +
                             ", but there are " + std::to_string(mesh_.vertices.size()));
    }
}

/// Numbers and quoted names up to the next word that starts with a letter.
void MeditReader::skip_section() {
  for (;;) {
    skip_blanks();
    if (p_ == end_) return;
    if (*p_ == '"') {
      const char* quote = p_;
      do ++p_;
      while (p_ != end_ && *p_ != '"' && *p_ != '\n');
      if (p_ == end_ || *p_ == '\n') fail(quote, "a quote is not closed on its line");
      ++p_;
      continue;
    }
    const char* begin = p_;
    const std::string_view found = word();
    double value = 0;
    if (parse_number(found, value)) continue;
    if (!is_letter(*begin)) fail(begin, "a number or the name of a section was expected, not " + shown(found));
    p_ = begin;
    return;
  }
}

/// False at the word End.
bool MeditReader::section() {
  const std::string_view name = word();
  if (name.empty()) fail(end_, "the file ends without the word End: it may be truncated");
  if (name == "End") return false;
  if (name == "Dimension") {
    if (has_dimension_) fail(name.data(), "Dimension comes twice");
    has_dimension_ = true;
    mesh_.dimension = integer("the dimension");
    if (mesh_.dimension != 2 && mesh_.dimension != 3)
      fail(p_, "the dimension is " + std::to_string(mesh_.dimension) + " instead of 2 or 3");
  } else if (name == "Vertices") {
    vertices();
  } else if (name == "Edges") {
    entities("edges", mesh_.edges, mesh_.edge_refs, edges_start_);
  } else if (name == "Triangles") {
    entities("triangles", mesh_.triangles, mesh_.triangle_refs, triangles_start_);
  } else if (is_skipped(name)) {
    skip_section();
  } else {
    fail(name.data(), "the name of a section or End was expected, not " + shown(name));
  }
  return true;
}

FlatMesh MeditReader::read() {
  header();
  while (section()) {
  }
  if (!has_vertices_) fail(p_, "the file has no Vertices");
  check_indices("edge", mesh_.edges, edges_start_);
  check_indices("triangle", mesh_.triangles, triangles_start_);
  return std::move(mesh_);
}

}  // namespace

FlatMesh read_mesh_text(std::string_view text, const std::string& name) {
  return MeditReader(without_byte_order_mark(text), name).read();
}

}  // namespace carreau
