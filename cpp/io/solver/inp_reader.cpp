// SPDX-License-Identifier: BSD-3-Clause
// Input of Abaqus and CalculiX: nodes, shells and sets. Other keywords are skipped with their lines.
#include <cmath>
#include <map>

#include "io/mesh_files.h"
#include "io/solver/solver_names.h"
#include "io/text.h"
#include "io/words.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

/// A line of a keyword: "*ELEMENT, TYPE=S3, ELSET=skin".
struct Keyword {
  std::string name;  ///< in capitals, without the star
  std::map<std::string, std::string> parameters;  ///< names in capitals, values as they are
  const char* at = nullptr;

  [[nodiscard]] std::string value(const std::string& parameter) const {
    const auto found = parameters.find(parameter);
    return found == parameters.end() ? "" : found->second;
  }
};

class InpReader {
 public:
  InpReader(std::string_view text, const std::string& name) : in_(text, name), nodes_(in_), groups_(in_) {
    refuse_zero_bytes(in_, text);
  }

  FlatMesh read() {
    Keyword keyword;
    while (in_.position() != in_.end()) {
      const char* const at = in_.position();
      const std::string_view line = in_.rest_of_line();
      if (line.empty() || line.starts_with("**")) continue;
      if (line.front() == '*')
        keyword = keyword_of(line);
      else if (keyword.name == "NODE")
        node(line);
      else if (keyword.name == "ELEMENT")
        element(keyword, line);
      else if (keyword.name == "ELSET")
        members(keyword, line);
      else if (keyword.name.empty())
        in_.fail(at, "a keyword such as *NODE was expected, not " + shown(line));
    }
    return finished();
  }

 private:
  static Keyword keyword_of(std::string_view line) {
    Keyword keyword;
    keyword.at = line.data();
    line.remove_prefix(1);
    keyword.name = in_capitals(next_field(line));
    while (!line.empty()) {
      const std::string_view field = next_field(line);
      const std::size_t equals = field.find('=');
      const std::string_view name = trimmed(field.substr(0, equals));
      keyword.parameters[in_capitals(name)] =
          equals == std::string_view::npos ? "" : std::string(trimmed(field.substr(equals + 1)));
    }
    return keyword;
  }

  void node(std::string_view line) {
    const char* const at = line.data();
    const std::int64_t number = integer(next_field(line), at, "the number of a node");
    Vec3 p;
    for (int x = 0; x < 3; ++x) {
      const std::string_view field = next_field(line);
      if (field.empty() && x > 0) continue;  // a plane mesh leaves the last one out
      if (!parse_number(field, p[x]) || !std::isfinite(p[x]))
        in_.fail(at, "a coordinate should be a finite number, not " + shown(field));
    }
    nodes_.add(number, p, at);
  }

  std::int64_t integer(std::string_view field, const char* at, const char* what) const {
    int n = 0;
    if (!parse_number(field, n) || n < 1) in_.fail(at, std::string(what) + " was expected, not " + shown(field));
    return n;
  }

  /// "C3D10M", "DC3D8", "AC3D20R": the number of nodes behind "C3D"; 0: no such solid.
  static std::size_t nodes_of_solid(std::string_view type) {
    const std::size_t at = type.find("C3D");
    if (at == std::string_view::npos || at > 1) return 0;
    std::string_view digits = type.substr(at + 3);
    digits = digits.substr(0, digits.find_first_not_of("0123456789"));
    int n = 0;
    const bool known = parse_number(digits, n) && (n == 27 || n == 18 || solid_of(static_cast<std::size_t>(n)));
    return known ? static_cast<std::size_t>(n) : 0;
  }
  /// The shape by the number of nodes.
  static std::optional<SolidShape> solid_of(std::size_t nodes) {
    if (nodes == 27) return SolidShape::hexahedron;  // nodes of faces and of the centre come last
    if (nodes == 18) return SolidShape::prism;
    for (const SolidShape shape : {SolidShape::tetrahedron, SolidShape::pyramid, SolidShape::prism, SolidShape::hexahedron})
      if (nodes == corner_count(shape) || nodes == quadratic_count(shape)) return shape;
    return std::nullopt;
  }

  /// Nodes of shells, plane elements and solids; 0: beams and others, which are skipped.
  std::size_t nodes_of(const Keyword& keyword) {
    static const std::map<std::string, std::size_t> known{
        {"S3", 3},   {"S3R", 3},   {"STRI3", 3}, {"CPS3", 3}, {"CPE3", 3},   {"CAX3", 3},  {"M3D3", 3},  {"R3D3", 3},
        {"STRI65", 6}, {"S6", 6},  {"CPS6", 6},  {"CPE6", 6}, {"CAX6", 6},   {"M3D6", 6},  {"S4", 4},    {"S4R", 4},
        {"S4R5", 4}, {"CPS4", 4},  {"CPS4R", 4}, {"CPE4", 4}, {"CPE4R", 4},  {"CAX4", 4},  {"M3D4", 4},  {"R3D4", 4},
        {"M3D9", 9}, {"M3D9R", 9}, {"S9R5", 9},
        {"S8", 8},   {"S8R", 8},   {"S8R5", 8},  {"CPS8", 8}, {"CPS8R", 8},  {"CPE8", 8},  {"CPE8R", 8}, {"M3D8", 8}};
    const std::string type = in_capitals(keyword.value("TYPE"));
    if (type.empty()) in_.fail(keyword.at, "*ELEMENT has no TYPE");
    const auto found = known.find(type);
    is_solid_ = false;
    if (found != known.end()) return found->second;
    if (const std::size_t solid = nodes_of_solid(type); solid > 0) return is_solid_ = true, solid;
    static constexpr const char* skipped[] = {"C3D", "B3", "T3D", "T2D", "B2", "MASS", "SPRING", "DASHPOT", "CONN", "D", "GAP", "U"};
    for (const char* prefix : skipped)
      if (type.starts_with(prefix)) return 0;
    in_.fail(keyword.at, "elements of type " + shown(type) + " are not known");
  }

  void element(const Keyword& keyword, std::string_view line) {
    if (keyword.at != element_keyword_) element_keyword_ = keyword.at, expected_ = nodes_of(keyword), open_ = false;
    if (expected_ == 0) return;
    const char* const at = line.data();
    if (!open_) {
      element_ = {integer(next_field(line), at, "the number of an element"), {}, keyword.value("ELSET"), at};
      open_ = true;
    }
    while (!line.empty()) element_.nodes.push_back(integer(next_field(line), at, "the number of a node"));
    if (element_.nodes.size() < expected_) return;
    if (element_.nodes.size() > expected_)
      in_.fail(at, "an element has " + std::to_string(element_.nodes.size()) + " nodes instead of " + std::to_string(expected_));
    open_ = false;
    if (is_solid_) element_.solid = solid_of(expected_);
    if (!is_solid_ && expected_ == 9) element_.nodes.pop_back();  // the centre
    groups_.add(element_);
  }

  /// Elements by number, in steps after GENERATE, or names of sets.
  void members(const Keyword& keyword, std::string_view line) {
    const char* const at = line.data();
    const std::string name = keyword.value("ELSET");
    if (name.empty()) in_.fail(keyword.at, "*ELSET has no name");
    std::vector<std::int64_t> numbers;
    while (!line.empty()) {
      const std::string_view field = next_field(line);
      int n = 0;
      if (parse_number(field, n))
        numbers.push_back(n);
      else if (!field.empty())
        groups_.add_set_to(name, std::string(field));
    }
    if (!keyword.parameters.contains("GENERATE")) {
      for (const std::int64_t n : numbers) groups_.add_range_to(name, n, n, 1);
      return;
    }
    if (numbers.size() < 2 || numbers.size() > 3 || (numbers.size() == 3 && numbers[2] < 1))
      in_.fail(at, "GENERATE requires a first number, a last number and perhaps a step");
    groups_.add_range_to(name, numbers[0], numbers[1], numbers.size() == 3 ? numbers[2] : 1);
  }

  FlatMesh finished() {
    if (open_) in_.fail(in_.end(), "the last element has fewer nodes than its type");
    FlatMesh mesh;
    nodes_.give_to(mesh);
    groups_.give_to(mesh, nodes_);
    return mesh;
  }

  Words in_;
  SolverNodes nodes_;
  SolverGroups groups_;
  const char* element_keyword_ = nullptr;
  std::size_t expected_ = 0;  ///< nodes of an element of the keyword; 0: it is skipped
  bool is_solid_ = false;
  bool open_ = false;         ///< its nodes continue on the next line
  SolverElement element_;
};

}  // namespace

FlatMesh read_mesh_inp(std::string_view text, const std::string& name) {
  return InpReader(without_byte_order_mark(text), name).read();
}

}  // namespace carreau
