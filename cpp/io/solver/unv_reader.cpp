// SPDX-License-Identifier: BSD-3-Clause
// Universal files of I-DEAS: nodes (datasets 2411, 781), elements (2412), groups (2467 and its sisters). Other datasets are
// skipped. Sources: as unv_writer.cpp.
#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "io/mesh_files.h"
#include "io/solver/solver_names.h"
#include "io/text.h"
#include "io/words.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

constexpr std::string_view delimiter = "-1";

enum class Family { line, surface, solid, skipped, unknown };

std::optional<SolidShape> solid_of(std::int32_t descriptor) noexcept {
  if (descriptor == 111 || descriptor == 118) return SolidShape::tetrahedron;
  if (descriptor == 112 || descriptor == 113) return SolidShape::prism;
  if (descriptor == 115 || descriptor == 116) return SolidShape::hexahedron;
  return std::nullopt;
}

/// The descriptor of an element gives its family (tens) and its shape (units).
Family family_of(std::int32_t descriptor) noexcept {
  switch (descriptor / 10) {
    case 1:  // rods
    case 2:  // beams
      return Family::line;
    case 4:  // plane stress
    case 5:  // plane strain
    case 6:  // plates
    case 7:  // membranes
    case 8:  // solids of revolution
    case 9:  // thin shells
      return Family::surface;
    default:
      break;
  }
  if (solid_of(descriptor)) return Family::solid;
  // Thick shells, other solids, rigid bodies, springs, dampers, gaps, masses.
  return descriptor >= 101 && descriptor <= 184 ? Family::skipped : Family::unknown;
}

struct Element {
  Family family = Family::skipped;
  std::int64_t number = 0;
  std::int32_t property = 0;
  std::optional<SolidShape> solid = {};
  std::vector<std::int64_t> nodes;  ///< around it
  std::size_t group = 0;            ///< the first that has it, from 1; 0: none
  const char* at = nullptr;
};

struct Group {
  std::string name;
  std::vector<std::int64_t> elements;
};

class UnvReader {
 public:
  UnvReader(std::string_view text, const std::string& name) : in_(text, name), nodes_(in_), groups_(in_) {
    refuse_zero_bytes(in_, text);
  }

  FlatMesh read() {
    while (begins_dataset()) {
      const char* const at = in_.position();
      const std::string_view line = in_.rest_of_line();
      const std::string_view number = line.substr(0, line.find(' '));
      if (number == "2411" || number == "781")
        while (!ends_dataset()) node();
      else if (number == "2412")
        while (!ends_dataset()) element();
      else if (number == "2467" || number == "2477" || number == "2452" || number == "2435")
        while (!ends_dataset()) group();
      else
        skip_dataset(at, number);
    }
    join();
    FlatMesh mesh;
    nodes_.give_to(mesh);
    give_faces(mesh);
    give_edges(mesh);
    return mesh;
  }

 private:
  /// At the next line that is not empty; false at the end of the file.
  bool begins_dataset() {
    while (in_.position() != in_.end()) {
      const char* const at = in_.position();
      const std::string_view line = in_.rest_of_line();
      if (line == delimiter) return true;
      if (!line.empty()) in_.fail(at, "-1, which begins a dataset, was expected, not " + shown(line));
    }
    return false;
  }

  /// Takes the line that ends a dataset, and empty ones before it.
  bool ends_dataset() {
    while (in_.position() != in_.end()) {
      const char* const at = in_.position();
      const std::string_view line = in_.rest_of_line();
      if (line == delimiter) return true;
      if (line.empty()) continue;
      in_.go_back(at);
      return false;
    }
    in_.fail(in_.end(), "the file ends inside a dataset");
  }

  void skip_dataset(const char* at, std::string_view number) {
    while (in_.position() != in_.end())
      if (in_.rest_of_line() == delimiter) return;
    in_.fail(at, "dataset " + shown(number) + " has no end");
  }

  std::int64_t number_of(const char* what) {
    const std::int32_t n = in_.integer(what);
    if (n < 0) in_.fail(in_.position(), std::string(what) + " is " + std::to_string(n));
    return n;
  }

  void node() {
    const char* const at = in_.position();
    const std::int64_t number = number_of("the number of a node");
    in_.rest_of_line();  // systems of coordinates, colour
    Vec3 p;
    for (int x = 0; x < 3; ++x) p[x] = in_.real("a coordinate of a node");
    in_.rest_of_line();
    nodes_.add(number, p, at);
  }

  void element() {
    Element element;
    element.at = in_.position();
    element.number = number_of("the number of an element");
    const std::int32_t descriptor = in_.integer("the descriptor of an element");
    element.property = in_.integer("the physical property of an element");
    in_.integer("the material of an element");
    in_.integer("the colour of an element");
    const std::size_t count = in_.count("nodes of an element", 1);
    in_.rest_of_line();
    element.family = family_of(descriptor);
    if (element.family == Family::unknown)
      in_.fail(element.at, "elements of descriptor " + std::to_string(descriptor) + " are not known");
    if (element.family == Family::line) in_.rest_of_line();  // orientation and cross sections
    for (std::size_t k = 0; k < count; ++k) element.nodes.push_back(number_of("a node of an element"));
    in_.rest_of_line();
    element.solid = solid_of(descriptor);
    if (element.solid && count != corner_count(*element.solid) && count != quadratic_count(*element.solid))
      in_.fail(element.at, "a solid of descriptor " + std::to_string(descriptor) + " has " + std::to_string(count) + " nodes");
    const bool skipped = element.family == Family::skipped || element.family == Family::solid;
    const bool fits = element.family == Family::line ? count == 2 || count == 3 : count == 3 || count == 4 || count == 6 || count == 8;
    if (!skipped && !fits)
      in_.fail(element.at, "an element of descriptor " + std::to_string(descriptor) + " has " + std::to_string(count) + " nodes");
    if (!element_of_.emplace(element.number, elements_.size()).second)
      in_.fail(element.at, "element " + std::to_string(element.number) + " comes twice");
    elements_.push_back(std::move(element));
  }

  void group() {
    for (int k = 0; k < 7; ++k) in_.integer("a number of a group");
    const std::size_t count = in_.count("members of a group", 4);
    in_.rest_of_line();
    Group group{without_controls(in_.rest_of_line()), {}};
    constexpr std::int32_t of_elements = 8;
    for (std::size_t k = 0; k < count; ++k) {
      const std::int32_t code = in_.integer("the code of a member of a group");
      const std::int64_t number = in_.integer("a member of a group");
      in_.integer("a leaf of a member"), in_.integer("a component of a member");
      if (code == of_elements) group.elements.push_back(number);
    }
    in_.rest_of_line();
    named_.push_back(std::move(group));
  }

  /// Elements belong to the first group that has them. A later group made of whole groups is the name of these.
  void join() {
    std::vector<std::size_t> sizes(named_.size() + 1, 0);  // by group, from 1
    for (std::size_t g = 1; g <= named_.size(); ++g) {
      std::map<std::size_t, std::size_t> taken;  // numbers of elements that earlier groups have
      for (const std::int64_t number : named_[g - 1].elements) {
        const auto found = element_of_.find(number);
        if (found == element_of_.end()) continue;
        std::size_t& own = elements_[found->second].group;
        if (own == 0) own = g, ++sizes[g];
        else if (own != g) ++taken[own];
      }
      const bool whole = sizes[g] == 0 && std::ranges::all_of(taken, [&](const auto& each) { return each.second == sizes[each.first]; });
      if (!whole || named_[g - 1].name.empty()) continue;
      for (const auto& [other, count] : taken) groups_.add_set_to(named_[g - 1].name, name_of(other));
    }
  }

  /// The name of a group, from 1; groups without a name are distinguished by their rank.
  std::string name_of(std::size_t group) const {
    const std::string& name = named_[group - 1].name;
    return name.empty() ? "group_" + std::to_string(group) : name;
  }

  bool has_groups(Family family) const {
    return std::ranges::any_of(elements_, [&](const Element& each) { return each.family == family && each.group > 0; });
  }

  /// Groups are faces; if there is no group of faces, properties are their references.
  void give_faces(FlatMesh& mesh) {
    const bool surface = std::ranges::any_of(elements_, [](const Element& each) { return each.family == Family::surface; });
    const Family family = surface ? Family::surface : Family::solid;  // whose outer faces are the surface then
    const bool grouped = has_groups(family);
    for (const Element& element : elements_) {
      if (element.family != family) continue;
      SolverElement own{element.number, element.nodes, "", element.at};
      own.solid = element.solid;
      if (own.solid)
        around_first(*own.solid, own.nodes);
      else if (own.nodes.size() > 4)
        corners_first(own.nodes);
      if (element.group > 0) own.set = name_of(element.group);
      if (!grouped) own.set = "P" + std::to_string(element.property), groups_.set_ref(own.set, element.property);
      groups_.add(own);
    }
    groups_.give_to(mesh, nodes_);
  }

  /// For a solid of order 2 the file lists the nodes around the bottom, upright edges, the nodes around the top.
  static void around_first(SolidShape shape, std::vector<std::int64_t>& nodes) {
    if (nodes.size() != quadratic_count(shape)) return;
    if (shape == SolidShape::tetrahedron) {  // 0 01 1 12 2 20, 03 13 23, 3
      nodes = {nodes[0], nodes[2], nodes[4], nodes[9], nodes[1], nodes[3], nodes[5], nodes[6], nodes[7], nodes[8]};
      return;
    }
    const std::size_t side = corner_count(shape) / 2, top = 3 * side;
    std::vector<std::int64_t> own;
    for (const std::size_t first : {std::size_t{0}, top, std::size_t{1}, top + 1})
      for (std::size_t k = 0; k < side; ++k) own.push_back(nodes[first + 2 * k]);
    own.insert(own.end(), nodes.begin() + static_cast<std::ptrdiff_t>(2 * side), nodes.begin() + static_cast<std::ptrdiff_t>(top));
    nodes = std::move(own);
  }

  static void corners_first(std::vector<std::int64_t>& nodes) {
    std::vector<std::int64_t> own;
    for (const std::size_t first : {0u, 1u})
      for (std::size_t k = first; k < nodes.size(); k += 2) own.push_back(nodes[k]);
    nodes = std::move(own);
  }

  /// References of groups of edges: "curve_5" has 5, others the least numbers that are left.
  std::map<std::size_t, std::int32_t> references_of_curves() const {
    std::map<std::size_t, std::int32_t> refs;
    std::set<std::int32_t> taken;
    std::vector<std::size_t> others;
    for (const Element& element : elements_) {
      std::int32_t ref = 0;
      if (element.family != Family::line || element.group == 0 || !refs.emplace(element.group, 0).second) continue;
      if (reference_in(named_[element.group - 1].name, "curve_", ref))
        refs[element.group] = ref, taken.insert(ref);
      else
        others.push_back(element.group);
    }
    std::int32_t next = 0;
    for (const std::size_t group : others) {
      do ++next;
      while (taken.contains(next));
      refs[group] = next;
    }
    return refs;
  }

  /// As set_elements() of curved edges beside straight ones: only the ends are kept then.
  void give_edges(FlatMesh& mesh) const {
    const std::map<std::size_t, std::int32_t> refs = references_of_curves();
    const bool with_mids = std::ranges::none_of(elements_, [](const Element& each) { return each.family == Family::line && each.nodes.size() == 2; });
    for (const Element& element : elements_) {
      if (element.family != Family::line) continue;
      const auto vertex = [&](std::size_t k) { return nodes_.vertex(element.nodes[k], element.at); };
      mesh.edges.push_back({vertex(0), vertex(element.nodes.size() - 1)});
      if (element.nodes.size() == 3 && with_mids) mesh.edge_mids.push_back(vertex(1));
      mesh.edge_refs.push_back(element.group > 0 ? refs.at(element.group) : refs.empty() ? element.property : 0);
    }
  }

  Words in_;
  SolverNodes nodes_;
  SolverGroups groups_;
  std::vector<Element> elements_;
  std::map<std::int64_t, std::size_t> element_of_;  ///< ranks by numbers
  std::vector<Group> named_;
};

}  // namespace

FlatMesh read_mesh_unv(std::string_view text, const std::string& name) {
  return UnvReader(without_byte_order_mark(text), name).read();
}

}  // namespace carreau
