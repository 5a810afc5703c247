// SPDX-License-Identifier: BSD-3-Clause
// Bulk data of Nastran: GRID, shells, and lines as edges; small, large and free fields. Other cards are skipped. The property
// of an element is the reference of its face.
#include <algorithm>
#include <array>
#include <cmath>

#include "io/mesh_files.h"
#include "io/solver/local_systems.h"
#include "io/solver/solver_names.h"
#include "io/text.h"
#include "io/words.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

/// A card with its continuations: name in capitals, then its fields.
struct Card {
  std::string name;
  std::vector<std::string_view> fields;
  const char* at = nullptr;
};

/// "1.5-7" and "1.5D+3" are numbers too.
bool parse_real(std::string_view field, double& value) {
  std::string word(field);
  for (std::size_t i = 1; i < word.size(); ++i) {
    const bool sign = word[i] == '+' || word[i] == '-';
    const bool digit = (word[i - 1] >= '0' && word[i - 1] <= '9') || word[i - 1] == '.';
    if (sign && digit) word.insert(i++, "e");
  }
  return parse_number(word, value) && std::isfinite(value);
}

class BdfReader {
 public:
  BdfReader(std::string_view text, const std::string& name) : in_(text, name), nodes_(in_), groups_(in_) {
    refuse_zero_bytes(in_, text);
  }

  FlatMesh read() {
    skip_to_bulk();
    while (in_.position() != in_.end() && !ended_) add_line();
    use();
    FlatMesh mesh;
    for (const auto& [number, point] : points_) nodes_.add(number, systems_.in_basic(number), point.at);
    nodes_.give_to(mesh);
    groups_.give_to(mesh, nodes_);
    for (const Line& line : lines_) {
      mesh.edges.push_back({nodes_.vertex(line.ends[0], line.at), nodes_.vertex(line.ends[1], line.at)});
      mesh.edge_refs.push_back(line.ref);
    }
    return mesh;
  }

 private:
  struct Line {
    std::array<std::int64_t, 2> ends;
    std::int32_t ref;
    const char* at;
  };

  /// The sections before the bulk data, which may be missing.
  void skip_to_bulk() {
    const char* const start = in_.position();
    while (in_.position() != in_.end()) {
      const std::string line = in_capitals(in_.rest_of_line());
      if (line.starts_with("BEGIN") && line.find("BULK") != std::string::npos) return;
    }
    in_.go_back(start);
  }

  /// A line as it stands: columns count.
  std::string_view next_line() {
    const char* const from = in_.position();
    in_.rest_of_line();
    std::string_view line(from, static_cast<std::size_t>(in_.position() - from));
    while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.remove_suffix(1);
    return line.substr(0, line.find('$'));
  }

  void add_line() {
    const std::string_view line = next_line();
    if (trimmed(line).empty()) return;
    std::vector<std::string_view> fields = split(line);
    const std::string name = in_capitals(fields.front());
    const bool continues = name.empty() || name.front() == '+' || name.front() == '*';
    fields.erase(fields.begin());
    if (continues) {
      card_.fields.resize(full_);  // fields that end a line may be left out
      card_.fields.insert(card_.fields.end(), fields.begin(), fields.end());
      full_ += fields_of_line(line);
      return;
    }
    use();
    const bool large = name.back() == '*';
    card_ = {large ? name.substr(0, name.size() - 1) : name, std::move(fields), line.data()};
    full_ = fields_of_line(line);
    ended_ = card_.name == "ENDDATA";
  }

  static bool is_large(std::string_view line) {
    return line.substr(0, std::min(line.find(','), std::size_t(8))).find('*') != std::string_view::npos;
  }
  static std::size_t fields_of_line(std::string_view line) { return is_large(line) ? 4 : 8; }

  /// Name and fields: between commas, or columns of 8, or of 16 if the name ends in a star.
  static std::vector<std::string_view> split(std::string_view line) {
    std::vector<std::string_view> fields;
    if (line.find(',') != std::string_view::npos) {
      for (std::string_view rest = line; !rest.empty() || fields.empty();) fields.push_back(next_field(rest));
      return fields;
    }
    constexpr std::size_t small = 8, large = 16, last_column = 72;
    line = line.substr(0, last_column);  // then a mark of the continuation
    fields.push_back(trimmed(line.substr(0, small)));
    const std::size_t width = is_large(line) ? large : small;
    for (std::size_t at = small; at < line.size(); at += width) fields.push_back(trimmed(line.substr(at, width)));
    return fields;
  }

  std::string_view field(std::size_t i) const { return i < card_.fields.size() ? card_.fields[i] : std::string_view(); }

  std::int64_t integer(std::size_t i, const char* what) const {
    int n = 0;
    if (!parse_number(field(i), n) || n < 1)
      in_.fail(card_.at, "card " + shown(card_.name) + ": " + what + " was expected, not " + shown(field(i)));
    return n;
  }

  void use() {
    if (card_.name == "GRID") grid();
    if (card_.name == "CTRIA3" || card_.name == "CTRIAR") shell(3, 3);
    if (card_.name == "CTRIA6") shell(3, 6);
    if (card_.name == "CQUAD4" || card_.name == "CQUADR") shell(4, 4);
    if (card_.name == "CQUAD8" || card_.name == "CQUAD") shell(4, 8);  // a ninth node is the centre
    if (card_.name == "CTETRA") solid(SolidShape::tetrahedron);
    if (card_.name == "CPYRAM" || card_.name == "CPYRA") solid(SolidShape::pyramid);
    if (card_.name == "CPENTA") solid(SolidShape::prism);
    if (card_.name == "CHEXA") solid(SolidShape::hexahedron);
    if (card_.name == "GRDSET" && !field(1).empty()) default_system_ = number(1, "a system of coordinates");
    if (card_.name.starts_with("CORD")) system();
    if (card_.name == "PLOTEL") lines_.push_back({{integer(1, "a node"), integer(2, "a node")}, 0, card_.at});
    if (card_.name == "CBAR" || card_.name == "CROD" || card_.name == "CBEAM")
      lines_.push_back({{integer(2, "a node"), integer(3, "a node")}, static_cast<std::int32_t>(integer(1, "a property")), card_.at});
    card_ = {};
  }

  /// Three coordinates; absent ones are 0.
  Vec3 point(std::size_t first) const {
    Vec3 p;
    for (int x = 0; x < 3; ++x) {
      const std::string_view word = field(first + static_cast<std::size_t>(x));
      if (!word.empty() && !parse_real(word, p[x]))
        in_.fail(card_.at, "a coordinate should be a finite number, not " + shown(word));
    }
    return p;
  }

  void grid() {
    const std::int64_t node = integer(0, "the number of a node");
    const bool basic = field(1).empty();
    if (!points_.emplace(node, LocalPoint{point(2), basic ? -1 : number(1, "a system of coordinates"), card_.at}).second)
      in_.fail(card_.at, "node " + std::to_string(node) + " comes twice");
  }

  /// CORD1R, CORD1C, CORD1S: by three nodes, two systems a card; CORD2R, CORD2C, CORD2S: by three points.
  void system() {
    if (card_.name.size() != 6) return;
    const char by = card_.name[4], kind = card_.name[5];
    if ((by != '1' && by != '2') || (kind != 'R' && kind != 'C' && kind != 'S')) return;
    LocalSystem system{.kind = kind, .at = card_.at};
    if (by == '2') {
      system.reference = field(1).empty() ? 0 : number(1, "a system of coordinates");
      for (std::size_t k = 0; k < 3; ++k) system.points[k] = point(2 + 3 * k);
      systems_.add(integer(0, "the number of a system of coordinates"), system);
      return;
    }
    system.by_nodes = true;
    for (std::size_t first = 0; first == 0 || (first == 4 && !field(4).empty()); first += 4) {
      for (std::size_t k = 0; k < 3; ++k) system.nodes[k] = integer(first + 1 + k, "a node");
      systems_.add(integer(first, "the number of a system of coordinates"), system);
    }
  }

  /// Nodes on edges may be left out: then corners count alone. Nastran lists edges of the bottom, upright edges, edges
  /// of the top; SolidSkin has upright ones last.
  void solid(SolidShape shape) {
    const std::int64_t property = field(1).empty() ? 0 : number(1, "a property");
    SolverElement element{integer(0, "the number of an element"), {}, "P" + std::to_string(property), card_.at, shape};
    for (std::size_t k = 0; k < corner_count(shape); ++k) element.nodes.push_back(integer(2 + k, "a node"));
    std::vector<std::int64_t> between;
    for (std::size_t k = corner_count(shape); k < quadratic_count(shape); ++k)
      if (!field(2 + k).empty() && field(2 + k) != "0") between.push_back(integer(2 + k, "a node"));
    if (corner_count(shape) + between.size() == quadratic_count(shape)) {
      const auto third = static_cast<std::ptrdiff_t>(between.size() / 3);
      if (shape == SolidShape::prism || shape == SolidShape::hexahedron)
        std::rotate(between.begin() + third, between.begin() + 2 * third, between.end());
      element.nodes.insert(element.nodes.end(), between.begin(), between.end());
    }
    groups_.set_ref(element.set, static_cast<std::int32_t>(property));
    groups_.add(element);
  }

  std::int64_t number(std::size_t i, const char* what) const { return field(i) == "0" ? 0 : integer(i, what); }

  /// Without a node on a side the corners count alone.
  void shell(std::size_t corners, std::size_t count) {
    for (std::size_t k = corners; k < count; ++k)
      if (field(2 + k).empty() || field(2 + k) == "0") count = corners;
    const std::int64_t property = field(1).empty() ? integer(0, "the number of an element") : integer(1, "a property");
    SolverElement element{integer(0, "the number of an element"), {}, "P" + std::to_string(property), card_.at};
    for (std::size_t k = 0; k < count; ++k) element.nodes.push_back(integer(2 + k, "a node"));
    groups_.set_ref(element.set, static_cast<std::int32_t>(property));
    groups_.add(element);
  }

  Words in_;
  SolverNodes nodes_;
  SolverGroups groups_;
  std::vector<Line> lines_;
  std::map<std::int64_t, LocalPoint> points_;
  std::int64_t default_system_ = 0;  ///< of GRDSET
  LocalSystems systems_{in_, points_, default_system_};
  Card card_;
  std::size_t full_ = 0;  ///< fields that the lines of the card have room for
  bool ended_ = false;
};

}  // namespace

FlatMesh read_mesh_bdf(std::string_view text, const std::string& name) {
  return BdfReader(without_byte_order_mark(text), name).read();
}

}  // namespace carreau
