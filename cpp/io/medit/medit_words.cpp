// SPDX-License-Identifier: BSD-3-Clause
#include "io/medit/medit_words.h"

#include <algorithm>

#include "io/text.h"
#include "support/format.h"

namespace carreau {

namespace {

constexpr bool is_blank(char c) noexcept { return c == ' ' || (c >= '\t' && c <= '\r'); }
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

/// True for the name of a section that the format knows.
bool is_known_section(std::string_view name) noexcept {
  if (name == "Vertices" || name == "Edges" || name == "Triangles") return true;
  return std::any_of(std::begin(skipped_sections), std::end(skipped_sections),
                     [&](std::string_view start) { return name.starts_with(start); });
}

}  // namespace

void MeditWords::header(const char* kind) {
  const std::string_view first = word();
  if (first.empty()) fail(end(), "the file is empty");
  if (first != "MeshVersionFormatted")
    fail(first.data(), std::string(kind) + " starts with MeshVersionFormatted, not with " + shown(first));
  const int version = integer("the version");
  if (version < 0 || version > 4)
    fail(position(), "version " + std::to_string(version) + " is not one of 0, 1, 2, 3, 4");
}

void MeditWords::fail_without_end() const {
  fail(end(), "the file ends without the word End: it may be truncated");
}

void MeditWords::skip_section() {
  for (;;) {
    skip_blanks();
    const char* const begin = position();
    if (begin == end()) return;
    if (*begin == '"') {
      const char* closing = begin;
      do ++closing;
      while (closing != end() && *closing != '"' && *closing != '\n');
      if (closing == end() || *closing == '\n') fail(begin, "a quote is not closed on its line");
      go_back(closing + 1);
      continue;
    }
    const std::string_view found = word();
    double value = 0;
    if (parse_number(found, value)) continue;
    if (!is_letter(*begin)) fail(begin, "a number or the name of a section was expected, not " + shown(found));
    go_back(begin);
    return;
  }
}

/// A name that nothing follows may be the beginning of the word End.
void MeditWords::skip_unknown() {
  const char* const before = position();
  skip_section();
  if (position() == end() && trimmed({before, static_cast<std::size_t>(end() - before)}).empty()) fail_without_end();
}

void MeditWords::read_dimension(const char* at) {
  if (dimension_) fail(at, "Dimension comes twice");
  const std::int32_t found = integer("the dimension");
  if (found != 2 && found != 3) fail(position(), "the dimension is " + std::to_string(found) + " instead of 2 or 3");
  dimension_ = found;
}

std::string_view MeditWords::next_section(std::initializer_list<std::string_view> wanted) {
  for (;;) {
    const std::string_view name = word();
    if (name.empty()) {
      // Programs that leave End out end the last line: any other end lies inside a word.
      if (!is_blank(end()[-1])) fail_without_end();
      ended_ = true;
    }
    if (name.empty() || name == "End") return {};
    if (std::find(wanted.begin(), wanted.end(), name) != wanted.end()) return name;
    if (name == "Dimension")
      read_dimension(name.data());
    else if (is_known_section(name))
      skip_section();
    else if (takes_any_ && is_letter(name.front()))
      skip_unknown();
    else
      fail(name.data(), "the name of a section or End was expected, not " + shown(name));
  }
}

}  // namespace carreau
