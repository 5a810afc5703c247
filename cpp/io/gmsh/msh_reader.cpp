// SPDX-License-Identifier: BSD-3-Clause
// Gmsh's format, versions 4.1 and 2.2, ASCII and binary (reference manual, "MSH file format").
#include <algorithm>
#include <map>
#include <set>
#include <span>

#include "io/curved_rows.h"
#include "io/element_lists.h"
#include "io/gmsh/msh_numbers.h"
#include "io/mesh_files.h"
#include "io/solid_skin.h"
#include "io/text.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

constexpr std::int32_t line_type = 1, triangle_type = 2, quad_type = 3, line_of_order_2_type = 8,
                       triangle_of_order_2_type = 9, quad_of_eight_nodes_type = 16, point_type = 15, tetrahedron_type = 4,
                       quad_of_nine_nodes_type = 10;

/// Number of vertices of the elements that are read (points, lines, triangles and quadrilaterals of first and second
/// order, solids). Returns 0 for other types, without which a surface would have holes.
std::size_t vertices_of_type(std::int32_t type) {
  static constexpr std::pair<std::int32_t, std::size_t> known[] = {
      {point_type, 1}, {line_type, 2}, {triangle_type, 3}, {quad_type, 4}, {line_of_order_2_type, 3},
      {triangle_of_order_2_type, 6}, {quad_of_eight_nodes_type, 8}, {quad_of_nine_nodes_type, 9},
      {tetrahedron_type, 4}, {5, 8},   {6, 6},   {7, 5},   {11, 10}, {12, 27},
      {13, 18},        {14, 14},       {17, 20},           {18, 15}, {19, 13}, {29, 20}, {30, 35}, {31, 56}};
  for (const auto& [each, vertices] : known)
    if (each == type) return vertices;
  return 0;
}

/// Elements of order 3 and 4.
struct CurvedType {
  std::int32_t type;
  int order, corners;
  std::size_t nodes;
};
const CurvedType* curved_of(std::int32_t type) noexcept {
  static constexpr CurvedType known[] = {{26, 3, 2, 4}, {27, 4, 2, 5}, {21, 3, 3, 10}, {23, 4, 3, 15}, {36, 3, 4, 16}, {37, 4, 4, 25}};
  const auto* const found = std::find_if(std::begin(known), std::end(known), [&](const CurvedType& each) { return each.type == type; });
  return found != std::end(known) ? found : nullptr;
}

bool is_surface(std::int32_t type) noexcept {
  if (const CurvedType* const curved = curved_of(type)) return curved->corners > 2;
  return type == triangle_type || type == quad_type || type == triangle_of_order_2_type ||
         type == quad_of_eight_nodes_type || type == quad_of_nine_nodes_type;
}

/// A solid: its shape, and the positions of SolidSkin's nodes in Gmsh's order, or its corners alone.
struct GmshSolid {
  SolidShape shape;
  std::vector<std::size_t> nodes;
};
const GmshSolid* solid_of(std::int32_t type) {
  static const std::vector<std::size_t> corners{0, 1, 2, 3, 4, 5, 6, 7};
  static const auto straight = [](SolidShape shape) {
    return GmshSolid{shape, {corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(corner_count(shape))}};
  };
  static const GmshSolid tetrahedron10{SolidShape::tetrahedron, {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}},
      pyramid13{SolidShape::pyramid, {0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12}},
      prism15{SolidShape::prism, {0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11}},
      hexahedron20{SolidShape::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15}};
  static const std::map<std::int32_t, GmshSolid> known{
      {4, straight(SolidShape::tetrahedron)},   {5, straight(SolidShape::hexahedron)}, {6, straight(SolidShape::prism)},
      {7, straight(SolidShape::pyramid)},       {11, tetrahedron10},                   {12, hexahedron20},
      {13, prism15},                            {14, pyramid13},                       {17, hexahedron20},
      {18, prism15},                            {19, pyramid13},                       {29, straight(SolidShape::tetrahedron)},
      {30, straight(SolidShape::tetrahedron)},  {31, straight(SolidShape::tetrahedron)}};
  const auto found = known.find(type);
  return found == known.end() ? nullptr : &found->second;
}

using Key = std::pair<std::int32_t, std::int32_t>;  // dimension and tag, of an entity or a physical group

class MshReader {
 public:
  /// `curved`: takes elements of order 3 and 4; nullptr: they are errors.
  MshReader(std::string_view content, const std::string& name, HighOrderMesh* curved) : in_(content, name), curved_(curved) {}

  FlatMesh read();

 private:
  void format();
  void section(std::string_view name, const char* at);
  void physical_names();
  void entities();
  void physical_groups(Key entity);
  void nodes_4();
  void nodes_2();
  void index_nodes(const char* at);
  void elements_4();
  void elements_2();
  void periodic();
  std::size_t check_type(std::int32_t type, const char* at) const;
  void element(std::int32_t type, std::int32_t ref, std::size_t vertices);
  std::int32_t vertex_of(std::int64_t tag, const char* at) const;
  std::int32_t find_vertex(std::int64_t tag) const;
  std::int64_t number_2(const char* what) { return in_.is_binary() ? in_.integer(what) : in_.size(what); }
  Vec3 point();
  void name_faces();

  [[nodiscard]] bool has_curved() const { return curved_ != nullptr && !(curved_->triangle_refs.empty() && curved_->quad_refs.empty()); }

  MshNumbers in_;
  HighOrderMesh* curved_;
  FlatMesh mesh_;
  ElementLists lists_;
  ElementList<9> quads9_;
  SolidSkin skin_;
  bool version_2_ = false, has_format_ = false, has_nodes_ = false, has_elements_ = false;
  std::map<Key, std::string> names_;             // of physical groups
  std::map<Key, std::int32_t> group_of_entity_;  // the first one
  std::vector<std::pair<std::int64_t, Vec3>> nodes_;
  std::vector<std::int64_t> tags_;  // of the vertices, ascending
};

void MshReader::format() {
  const char* at = in_.here();
  const double version = in_.real("the version");
  version_2_ = version >= 2 && version < 2.25;
  if (!version_2_ && version != 4.1)
    in_.fail(at, "version " + format_number(version) + " of the format is neither 4.1 nor 2.2");
  const std::int32_t type = in_.integer("the type of the file"), size = in_.integer("the size of its numbers");
  if (type != 0 && type != 1)
    in_.fail(at, "the type of the file is " + std::to_string(type) + " instead of 0 (ASCII) or 1 (binary)");
  if (size != 8) in_.fail(at, "numbers of " + std::to_string(size) + " bytes are not supported; 8 bytes are");
  if (type == 0) return;
  in_.rest_of_line();
  in_.set_binary(false);
  const char* one = in_.here();
  const std::int32_t found = in_.integer("the number 1");
  constexpr std::int32_t swapped_one = 0x01000000;
  if (found == swapped_one)
    in_.set_binary(true);
  else if (found != 1)
    in_.fail(one, "the number 1, which gives the order of bytes, was expected");
}

void MshReader::physical_names() {
  const std::string_view count = in_.word();  // text in both forms
  int n = 0;
  if (!parse_number(count, n) || n < 0) in_.fail(in_.here(), "the number of names should be a number");
  for (int i = 0; i < n; ++i) {
    const char* at = in_.here();
    int dimension = 0, tag = 0;
    if (!parse_number(in_.word(), dimension) || !parse_number(in_.word(), tag))
      in_.fail(at, "the dimension and the number of a physical group were expected");
    const std::string_view quoted = in_.rest_of_line();
    if (quoted.size() < 2 || quoted.front() != '"' || quoted.back() != '"')
      in_.fail(at, "the name of a physical group should stand between quotation marks, not " + shown(quoted));
    names_[{dimension, tag}] = without_controls(quoted.substr(1, quoted.size() - 2));
  }
}

void MshReader::physical_groups(Key entity) {
  const std::int64_t n = in_.size("the number of physical groups");
  for (std::int64_t i = 0; i < n; ++i) {
    const std::int32_t group = in_.integer("a physical group");
    group_of_entity_.emplace(entity, group);
  }
}

void MshReader::entities() {
  std::int64_t counts[4];
  for (std::int64_t& n : counts) n = in_.size("a number of entities");
  for (std::int32_t dimension = 0; dimension < 4; ++dimension)
    for (std::int64_t i = 0; i < counts[dimension]; ++i) {
      const std::int32_t tag = in_.integer("the number of an entity");
      for (int k = dimension == 0 ? 3 : 6; k > 0; --k) in_.real("a coordinate of a box");
      physical_groups({dimension, tag});
      if (dimension == 0) continue;
      const std::int64_t bounds = in_.size("the number of boundaries");
      for (std::int64_t k = 0; k < bounds; ++k) in_.integer("a boundary");
    }
}

Vec3 MshReader::point() {
  Vec3 p;
  p.x() = in_.real("a coordinate of a node");
  p.y() = in_.real("a coordinate of a node");
  p.z() = in_.real("a coordinate of a node");
  return p;
}

void MshReader::nodes_4() {
  const char* at = in_.here();
  const std::int64_t blocks = in_.size("the number of blocks");
  for (const char* what : {"the number of nodes", "the smallest number", "the largest number"}) in_.size(what);
  for (std::int64_t b = 0; b < blocks; ++b) {
    const std::int32_t dimension = in_.integer("the dimension of an entity");
    in_.integer("the number of an entity");
    const bool parametric = in_.integer("0 or 1") != 0;
    const char* count = in_.here();
    const std::int64_t announced = in_.size("the number of nodes");
    const std::size_t n = in_.checked_count(announced, count, "nodes", 4, 32), first = nodes_.size();
    for (std::size_t i = 0; i < n; ++i) nodes_.emplace_back(in_.size("the number of a node"), Vec3{});
    for (std::size_t i = 0; i < n; ++i) {
      nodes_[first + i].second = point();
      for (std::int32_t k = 0; parametric && k < dimension; ++k) in_.real("a parameter of a node");
    }
  }
  index_nodes(at);
}

void MshReader::nodes_2() {
  const char* at = in_.here();
  const std::int32_t announced = in_.Words::integer("the number of nodes");  // text in both forms
  if (in_.is_binary()) in_.rest_of_line();
  const std::size_t n = in_.checked_count(announced, at, "nodes", 4, 28);
  for (std::size_t i = 0; i < n; ++i) {
    const std::int64_t tag = number_2("the number of a node");
    nodes_.emplace_back(tag, point());
  }
  index_nodes(at);
}

/// Vertices in ascending order of their numbers.
void MshReader::index_nodes(const char* at) {
  std::stable_sort(nodes_.begin(), nodes_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [tag, p] : nodes_) {
    if (!tags_.empty() && tags_.back() == tag) in_.fail(at, "node " + std::to_string(tag) + " is given twice");
    tags_.push_back(tag);
    mesh_.vertices.push_back(p);
  }
  mesh_.vertex_refs.assign(mesh_.vertices.size(), 0);
  nodes_ = {};
}

/// Returns -1 if no node has the number.
std::int32_t MshReader::find_vertex(std::int64_t tag) const {
  // Mostly the numbers are 1, 2, ...
  const std::uint64_t guess = static_cast<std::uint64_t>(tag) - 1;
  if (guess < tags_.size() && tags_[guess] == tag) return static_cast<std::int32_t>(guess);
  const auto found = std::lower_bound(tags_.begin(), tags_.end(), tag);
  return found == tags_.end() || *found != tag ? -1 : static_cast<std::int32_t>(found - tags_.begin());
}

std::int32_t MshReader::vertex_of(std::int64_t tag, const char* at) const {
  const std::int32_t v = find_vertex(tag);
  if (v < 0) in_.fail(at, "an element names node " + std::to_string(tag) + ", which does not exist");
  return v;
}

/// Pairs without a map, and pairs of nodes that the file has not, are left out.
void MshReader::periodic() {
  const std::int64_t links = in_.size("the number of periodic entities");
  for (std::int64_t i = 0; i < links; ++i) {
    PeriodicLink link;
    link.dimension = in_.integer("the dimension of an entity");
    link.slave = in_.integer("the number of an entity"), link.master = in_.integer("the number of an entity");
    const char* at = in_.here();
    bool has_map = false;
    if (version_2_) {
      has_map = in_.word() == "Affine";
      if (!has_map) in_.go_back(at);
    } else {
      const std::int64_t entries = in_.size("the number of entries of a map");
      if (entries != 0 && entries != 16) in_.fail(at, "a periodic map has " + std::to_string(entries) + " entries instead of 16");
      has_map = entries == 16;
    }
    for (int k = 0; k < 16 && has_map; ++k) {
      const double entry = in_.real("an entry of a map");
      if (k < 12 && k % 4 == 3) link.map.shift[k / 4] = entry;
      if (k < 12 && k % 4 != 3) link.map.row[static_cast<std::size_t>(k / 4)][k % 4] = entry;
    }
    const char* count = in_.here();
    const std::size_t n = in_.checked_count(in_.size("the number of pairs of nodes"), count, "pairs of nodes", 2, 16);
    for (std::size_t k = 0; k < n; ++k) {
      const std::int32_t slave = find_vertex(in_.size("the number of a node")), master = find_vertex(in_.size("the number of a node"));
      if (slave >= 0 && master >= 0) link.nodes.push_back({slave, master});
    }
    if (has_map && !link.nodes.empty()) mesh_.periodic.push_back(std::move(link));
  }
}

std::size_t MshReader::check_type(std::int32_t type, const char* at) const {
  if (const CurvedType* const curved = curved_of(type); curved != nullptr && curved_ != nullptr) return curved->nodes;
  const std::size_t vertices = vertices_of_type(type);
  if (vertices == 0)
    in_.fail(at, "an element has type " + std::to_string(type) +
                     "; surfaces of triangles and quadrilaterals of order 1 and 2 (types 2, 3, 9, 10, 16) and solids are read only");
  return vertices;
}

/// The vertices of an element, behind all its other numbers.
void MshReader::element(std::int32_t type, std::int32_t ref, std::size_t vertices) {
  constexpr std::size_t max_nodes = 56;  // of vertices_of_type()
  std::array<std::int32_t, max_nodes> nodes{};
  for (std::size_t k = 0; k < vertices; ++k) {
    const char* at = in_.here();
    const std::int64_t tag = version_2_ ? number_2("the number of a node") : in_.size("the number of a node");
    nodes[k] = vertex_of(tag, at);
  }
  const auto add = [&](auto& list) {
    auto& own = list.nodes.emplace_back();
    std::copy_n(nodes.begin(), own.size(), own.begin());
    list.refs.push_back(ref);
  };
  if (const CurvedType* const curved = curved_of(type))
    if (!add_curved(*curved_, curved->order, curved->corners, std::span(nodes).first(vertices), ref)) in_.fail(in_.here(), "elements of orders 3 and 4 are mixed");
  if (type == point_type) mesh_.vertex_refs[static_cast<std::size_t>(nodes[0])] = ref;
  if (type == tetrahedron_type) mesh_.tetrahedra.push_back({nodes[0], nodes[1], nodes[2], nodes[3]});
  if (type == line_type) add(lists_.edges);
  if (type == line_of_order_2_type) add(lists_.edges3);
  if (type == triangle_type) add(lists_.triangles);
  if (type == triangle_of_order_2_type) add(lists_.triangles6);
  if (type == quad_type) add(lists_.quads);
  if (type == quad_of_eight_nodes_type) add(lists_.quads8);
  if (type == quad_of_nine_nodes_type) add(quads9_);
  if (const GmshSolid* const solid = solid_of(type)) {
    std::vector<std::int32_t> own;
    for (const std::size_t k : solid->nodes) own.push_back(nodes[k]);
    skin_.add(solid->shape, own, ref);
  }
}

void MshReader::elements_4() {
  const std::int64_t blocks = in_.size("the number of blocks");
  for (const char* what : {"the number of elements", "the smallest number", "the largest number"}) in_.size(what);
  for (std::int64_t b = 0; b < blocks; ++b) {
    in_.integer("the dimension of an entity");
    const std::int32_t ref = in_.integer("the number of an entity");
    const char* at = in_.here();
    const std::int32_t type = in_.integer("the type of elements");
    const std::size_t vertices = check_type(type, at);
    const char* count = in_.here();
    const std::int64_t announced = in_.size("the number of elements");
    const std::size_t n = in_.checked_count(announced, count, "elements", vertices + 1, 8 * (vertices + 1));
    for (std::size_t i = 0; i < n; ++i) {
      in_.size("the number of an element");
      element(type, ref, vertices);
    }
  }
}

/// The first tag of an element is its physical group, the second one its entity. Binary elements are stored in blocks
/// of one type.
void MshReader::elements_2() {
  const std::int32_t count = in_.Words::integer("the number of elements");  // text in both forms
  if (in_.is_binary()) in_.rest_of_line();
  for (std::int64_t left = count; left > 0;) {
    const bool binary = in_.is_binary();
    if (!binary) in_.size("the number of an element");
    const char* at = in_.here();
    const std::int32_t type = in_.integer("the type of an element");
    const std::size_t vertices = check_type(type, at);
    const std::int32_t together = binary ? in_.integer("the number of elements") : 1;
    const std::int32_t tags = in_.integer("the number of tags");
    if (together < 1 || together > left || tags < 0) in_.fail(at, "the numbers of elements or tags cannot be");
    for (std::int32_t i = 0; i < together; ++i, --left) {
      if (binary) in_.integer("the number of an element");
      std::int32_t group = 0, ref = 0;
      for (std::int32_t k = 0; k < tags; ++k) {
        const std::int32_t tag = in_.integer("a tag");
        if (k == 0) group = ref = tag;
        if (k == 1) ref = tag;
      }
      if (is_surface(type) && group != 0) group_of_entity_.emplace(Key{2, ref}, group);
      element(type, ref, vertices);
    }
  }
}

void MshReader::section(std::string_view name, const char* at) {
  if (name.size() < 2 || name.front() != '$') in_.fail(at, "the name of a section was expected, not " + shown(name));
  name.remove_prefix(1);
  if (!has_format_ && name != "MeshFormat" && name != "Comments")
    in_.fail(at, "a Gmsh file starts with $MeshFormat, not with " + shown(name));
  const auto once = [&](bool& has) {
    if (has) in_.fail(at, "$" + std::string(name) + " comes twice");
    has = true;
  };
  bool skip = false;
  if (in_.is_binary()) in_.rest_of_line();
  if (name == "MeshFormat") {
    once(has_format_);
    format();
  } else if (name == "PhysicalNames") {
    physical_names();
  } else if (name == "Entities" && !version_2_) {
    entities();
  } else if (name == "Nodes") {
    once(has_nodes_);
    version_2_ ? nodes_2() : nodes_4();
  } else if (name == "Elements") {
    if (!has_nodes_) in_.fail(at, "$Elements comes before $Nodes");
    once(has_elements_);
    version_2_ ? elements_2() : elements_4();
  } else if (name == "Periodic" && has_nodes_ && !(version_2_ && in_.is_binary())) {
    periodic();
  } else {
    skip = true;
  }
  in_.end_section(name, skip);
}

/// Names that were made of references, because a face had none, are not taken for names.
void MshReader::name_faces() {
  std::set<std::int32_t> meshed(mesh_.triangle_refs.begin(), mesh_.triangle_refs.end());
  if (has_curved()) {
    meshed.insert(curved_->triangle_refs.begin(), curved_->triangle_refs.end());
    meshed.insert(curved_->quad_refs.begin(), curved_->quad_refs.end());
  }
  for (const auto& [entity, group] : group_of_entity_) {
    const auto name = names_.find({2, group});
    if (entity.first != 2 || name == names_.end() || !meshed.contains(entity.second)) continue;
    if (name->second == "face_" + std::to_string(group)) continue;
    mesh_.faces.push_back({.ref = entity.second, .status = FaceStatus::meshed, .name = name->second});
  }
}

FlatMesh MshReader::read() {
  for (std::string_view name = in_.word(); !name.empty(); name = in_.word()) section(name, name.data());
  if (!has_format_) in_.fail(in_.end(), "the file is empty");
  if (!has_nodes_) in_.fail(in_.end(), "the file has no $Nodes");
  if (!has_elements_) in_.fail(in_.end(), "the file has no $Elements");
  if (has_curved()) {
    if (!lists_.triangles.nodes.empty() || !lists_.triangles6.nodes.empty() || !lists_.quads.nodes.empty() || !lists_.quads8.nodes.empty() ||
        !quads9_.nodes.empty())
      in_.fail(in_.end(), "elements of order " + std::to_string(curved_->order) + " and of a lower order are mixed");
    name_faces();
    return std::move(mesh_);
  }
  if (quads9_.nodes.empty()) skin_.give_to(lists_, mesh_.vertices);
  take_quads9(quads9_.nodes, quads9_.refs, lists_, mesh_);
  try {
    set_elements(lists_, mesh_);
  } catch (const InvalidArgument& error) {
    in_.fail(in_.end(), error.what());
  }
  name_faces();
  return std::move(mesh_);
}

}  // namespace

FlatMesh read_mesh_msh(std::string_view content, const std::string& name) {
  return MshReader(without_byte_order_mark(content), name, nullptr).read();
}
FlatMesh read_mesh_msh(std::string_view content, const std::string& name, HighOrderMesh& curved) {
  return MshReader(without_byte_order_mark(content), name, &curved).read();
}

}  // namespace carreau
