#include "io/medit_words.h"

#include <charconv>
#include <cmath>

#include "io/text.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

constexpr bool is_blank(char c) noexcept { return c == ' ' || (c >= '\t' && c <= '\r'); }
constexpr bool ends_word(char c) noexcept { return is_blank(c) || c == '#'; }
constexpr bool is_letter(char c) noexcept { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Beginnings of the names.
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

}  // namespace

bool is_known_section(std::string_view name) noexcept {
  for (const std::string_view start : skipped_sections)
    if (name.starts_with(start)) return true;
  return false;
}

void MeditWords::fail(const char* at, const std::string& sentence) const {
  throw FileError({.file = name_, .line = line_at(text_, static_cast<std::size_t>(at - text_.data()))}, sentence);
}

void MeditWords::skip_blanks() noexcept {
  while (p_ != end_) {
    if (*p_ == '#')
      while (p_ != end_ && *p_ != '\n') ++p_;
    else if (is_blank(*p_))
      ++p_;
    else
      return;
  }
}

std::string_view MeditWords::word() {
  skip_blanks();
  const char* begin = p_;
  while (p_ != end_ && !ends_word(*p_)) ++p_;
  return {begin, static_cast<std::size_t>(p_ - begin)};
}

std::string_view MeditWords::number_word(const char* what) {
  const std::string_view found = word();
  if (found.empty()) fail(end_, std::string("the file ends where ") + what + " was expected");
  return found;
}

double MeditWords::real(const char* what) {
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

std::int32_t MeditWords::integer(const char* what) {
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

void MeditWords::header(const char* kind) {
  const std::string_view first = word();
  if (first.empty()) fail(end_, "the file is empty");
  if (first != "MeshVersionFormatted")
    fail(first.data(), std::string(kind) + " starts with MeshVersionFormatted, not with " + shown(first));
  const int version = integer("the version");
  if (version < 0 || version > 4) fail(p_, "version " + std::to_string(version) + " is not one of 0, 1, 2, 3, 4");
}

std::size_t MeditWords::count(const std::string& what, std::size_t words_each) {
  const std::int32_t n = integer(("the number of " + what).c_str());
  if (n < 0) fail(p_, "the number of " + what + " is negative: " + std::to_string(n));
  // A number takes two characters, its separator included.
  const std::size_t room = static_cast<std::size_t>(end_ - p_) / (2 * words_each);
  if (static_cast<std::size_t>(n) > room)
    fail(p_, std::to_string(n) + " " + what + " are announced, but the rest of the file has room for at most " +
                 std::to_string(room));
  return static_cast<std::size_t>(n);
}

void MeditWords::skip_section() {
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

std::int32_t MeditWords::dimension() {
  const std::int32_t found = integer("the dimension");
  if (found != 2 && found != 3) fail(p_, "the dimension is " + std::to_string(found) + " instead of 2 or 3");
  return found;
}

}  // namespace carreau
