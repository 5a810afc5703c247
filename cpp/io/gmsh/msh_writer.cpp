// SPDX-License-Identifier: BSD-3-Clause
// Gmsh's ASCII format, versions 4.1 and 2.2 (reference manual, "MSH file format"). One surface a triangle reference,
// one curve an edge reference, one point a vertex reference that no other vertex has.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <initializer_list>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "io/element_words.h"
#include "io/gmsh/msh_mesh.h"
#include "io/mesh_writers.h"
#include "support/format.h"

namespace carreau {

namespace {

/// The format's type of a kind of elements; nodes have the order of the format already.
int type_of(CellKind kind) noexcept { return by_kind(kind, 2, 9, 3, 16); }

struct Entity {
  int tag = 0, physical = 0;
  std::string name;                  // of the physical group
  std::vector<std::size_t> members;  // elements, kind by kind (for a solid: the elements of its faces), or the vertex
  std::vector<std::size_t> nodes;    // that belong to no entity of a lower dimension
  /// Tags of the points of a curve, negative at its end; of the curves of a face, negative if they run clockwise; of the faces of a solid,
  /// negative if triangles look inwards.
  std::vector<int> bounds;
};

using Entities = std::map<std::int32_t, Entity>;  // by reference

/// Tags are positive in the format: other references get numbers above the largest one, and the least free numbers
/// after the last number.
void give_tags(Entities& entities) {
  int next = entities.empty() ? 0 : std::max(entities.rbegin()->first, 0);
  const auto advance = [&] { next = next == std::numeric_limits<int>::max() ? 1 : next + 1; };
  for (auto& [ref, entity] : entities) {
    if (ref > 0) {
      entity.tag = ref;
      continue;
    }
    do advance();
    while (entities.contains(next));
    entity.tag = next;
  }
}

void number(std::string& text, double x) { append_number(text, x), text += ' '; }
void number(std::string& text, std::size_t n) { text += std::to_string(n) + ' '; }
void number(std::string& text, int n) { text += std::to_string(n) + ' '; }
void end_line(std::string& text) { text.back() = '\n'; }

}  // namespace

MshMesh::MshMesh(const FlatMesh& mesh, bool curve_groups)
    : dimension(mesh.dimension), nodes(mesh.vertices), names(&mesh.names), faces(&mesh.faces), periodic(&mesh.periodic) {
  if (curve_groups) node_refs = &mesh.vertex_refs;
  const auto own = [this](std::initializer_list<std::int32_t> list) { return own_nodes.insert(own_nodes.end(), list), list.size(); };
  own_nodes.reserve(3 * mesh.edges.size());  // spans of it stay valid
  std::size_t t = 0;
  const auto add = [&](int dim, int type, int corners, std::int32_t ref, std::span<const std::int32_t> list) {
    elements.push_back({dim, type, corners, ref, list});
  };
  for (const Cell& cell : mesh.cells) {
    add(2, type_of(cell.kind), corner_count(cell.kind), ref_of(mesh.triangle_refs, t), std::span(cell.nodes).first(static_cast<std::size_t>(node_count(cell.kind))));
    t += corner_count(cell.kind) == 4 ? 2 : 1;
  }
  for (; t < mesh.triangles.size(); ++t) add(2, type_of(CellKind::triangle3), 3, ref_of(mesh.triangle_refs, t), mesh.triangles[t]);
  for (std::size_t e = 0; e < mesh.edges.size() && curve_groups; ++e) {
    const auto [a, b] = mesh.edges[e];
    const std::size_t n = mesh.edge_mids.empty() ? own({a, b}) : own({a, b, mesh.edge_mids[e]});
    add(1, n == 2 ? 1 : 8, 2, ref_of(mesh.edge_refs, e), std::span(own_nodes).last(n));
  }
}

namespace {

class MshText {
 public:
  MshText(const MshMesh& mesh, bool version_2, const MeshAssociation* association) : mesh_(mesh), version_2_(version_2), association_(association) {
    collect_entities();
    classify_nodes();
    bound_curves();
    bound_faces();
  }

  std::string run() {
    text_ = version_2_ ? "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" : "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
    add_names();
    if (version_2_) {
      add_nodes_2();
      add_elements_2();
    } else {
      add_entities();
      add_nodes_4();
      add_elements_4();
    }
    add_periodic();
    return std::move(text_);
  }

 private:
  [[nodiscard]] std::span<const std::int32_t> nodes_of(std::size_t element) const { return mesh_.elements[element].nodes; }

  // Quadrilaterals come before triangles.
  static int key_of(const MshElement& element) { return 1000 * element.corners + static_cast<int>(element.nodes.size()); }

  void collect_entities() {
    std::set<int, std::greater<>> types;
    for (const MshElement& element : mesh_.elements) types.insert(key_of(element));
    for (const int key : types)
      for (std::size_t e = 0; e < mesh_.elements.size(); ++e)
        if (const MshElement& element = mesh_.elements[e]; key_of(element) == key) entities_[element.dim][element.ref].members.push_back(e);
    if (mesh_.node_refs != nullptr) collect_points();
    for (Entities& entities : entities_) give_tags(entities);
    collect_solids();
    for (auto& [ref, face] : entities_[2]) face.name = name_of(ref);
    // Programs expect a group of every element when any has one.
    const auto name = [](Entities& entities, const std::map<int, std::string>& names, const char* prefix) {
      for (auto& [ref, entity] : entities) {
        const auto own = names.find(ref);
        entity.name = own != names.end() && !own->second.empty() ? plain_name(own->second) : prefix + std::to_string(entity.tag);
      }
    };
    name(entities_[0], mesh_.names->points, "point_");
    name(entities_[1], mesh_.names->curves, "curve_");
    name(solids_, mesh_.names->solids, "solid_");
    for (Entities* entities : {&entities_[0], &entities_[1], &entities_[2], &solids_}) {
      // Entities of one name are one group, under the smallest of their tags.
      std::map<std::string, int> group;
      for (auto& [ref, entity] : *entities) entity.physical = group.emplace(entity.name, entity.tag).first->second;
    }
  }

  /// Solids have no elements. The signed tags of the faces around them enable programs to fill them.
  void collect_solids() {
    for (const auto& [ref, sides] : mesh_.names->face_solids) {
      const auto face = entities_[2].find(ref);
      if (face == entities_[2].end() || sides[0] == sides[1]) continue;
      for (const std::size_t side : {0U, 1U}) {
        if (sides[side] <= 0) continue;
        Entity& solid = solids_[sides[side]];
        solid.bounds.push_back(side == 0 ? face->second.tag : -face->second.tag);
        solid.members.insert(solid.members.end(), face->second.members.begin(), face->second.members.end());
      }
    }
    for (auto& [ref, solid] : solids_) solid.tag = ref;
  }

  [[nodiscard]] std::string name_of(std::int32_t ref) const {
    const auto face = std::find_if(mesh_.faces->begin(), mesh_.faces->end(), [&](const FlatFace& f) { return f.ref == ref && !f.name.empty(); });
    return face != mesh_.faces->end() ? plain_name(face->name) : "face_" + std::to_string(ref);
  }

  void collect_points() {
    const std::vector<std::int32_t>& refs = *mesh_.node_refs;
    for (std::size_t v = 0; v < refs.size(); ++v)
      if (refs[v] > 0) entities_[0][refs[v]].members.push_back(v);
    std::erase_if(entities_[0], [](const auto& point) { return point.second.members.size() > 1; });
  }

  void classify_nodes() {
    std::vector<bool> taken(mesh_.nodes.size(), false);
    const auto take = [&](Entity& entity, std::size_t v) {
      if (!taken[v]) entity.nodes.push_back(v), taken[v] = true;
    };
    for (auto& [ref, point] : entities_[0]) take(point, point.members.front());
    for (const int dim : {1, 2})
      for (auto& [ref, entity] : entities_[dim])
        for (const std::size_t e : entity.members)
          for (const std::int32_t v : nodes_of(e)) take(entity, static_cast<std::size_t>(v));
    // Vertices that nothing holds.
    for (std::size_t v = 0; v < taken.size(); ++v)
      if (!taken[v] && !entities_[2].empty()) entities_[2].begin()->second.nodes.push_back(v);
  }

  /// The points at which edges of a curve start and none ends, or the other way round; of a closed curve the first point.
  void bound_curves() {
    std::map<std::int32_t, int> points;  // tags by vertex
    for (const auto& [ref, point] : entities_[0]) points.emplace(static_cast<std::int32_t>(point.members.front()), point.tag);
    for (auto& [ref, curve] : entities_[1]) {
      std::map<std::int32_t, int> ends;  // edges that start less edges that end, at points
      for (const std::size_t e : curve.members)
        for (const std::size_t i : {0U, 1U})
          if (const std::int32_t v = nodes_of(e)[i]; points.contains(v)) ends[v] += i == 0 ? 1 : -1;
      for (const int sign : {1, -1})
        for (const auto& [v, sum] : ends)
          if (sum * sign > 0) curve.bounds.push_back(sign * points.at(v));
      if (curve.bounds.empty() && !ends.empty()) curve.bounds = {points.at(ends.begin()->first), -points.at(ends.begin()->first)};
    }
  }

  /// The curves of each face, once for each side that its elements lie on: seams have both.
  void bound_faces() {
    std::map<std::array<std::int32_t, 2>, std::vector<int>> edges;  // tags, by vertices along the curve
    for (const auto& [ref, curve] : entities_[1])
      for (const std::size_t e : curve.members) edges[{nodes_of(e)[0], nodes_of(e)[1]}].push_back(curve.tag);
    if (edges.empty()) return;
    for (auto& [ref, face] : entities_[2]) {
      std::set<int> bounds;
      for (const std::size_t c : face.members) {
        const auto n = static_cast<std::size_t>(mesh_.elements[c].corners);
        for (std::size_t i = 0; i < n; ++i) {
          const std::int32_t a = nodes_of(c)[i], b = nodes_of(c)[(i + 1) % n];
          if (const auto along = edges.find({a, b}); along != edges.end()) bounds.insert(along->second.begin(), along->second.end());
          if (const auto back = edges.find({b, a}); back != edges.end())
            for (const int tag : back->second) bounds.insert(-tag);
        }
      }
      face.bounds.assign(bounds.begin(), bounds.end());
      std::sort(face.bounds.begin(), face.bounds.end(), [](int a, int b) { return std::pair(std::abs(a), -a) < std::pair(std::abs(b), -b); });
    }
  }

  /// Parameters of a node on an entity; empty: not known, or not to be written.
  [[nodiscard]] std::span<const double> parameters(int dim, std::int32_t ref, std::size_t v) const {
    if (association_ == nullptr) return {};
    return association_->parameters(dim, static_cast<std::int32_t>(v), ref);
  }

  // The names of faces come last: libMesh keeps one name for each number, the last one, whatever its dimension.
  void add_names() {
    std::size_t count = 0;
    std::string lines;
    const auto add = [&](int dim, const Entities& entities) {
      std::map<int, std::string> names;
      for (const auto& [ref, entity] : entities) names.emplace(entity.physical, entity.name);
      for (const auto& [physical, name] : names) lines += std::to_string(dim) + " " + std::to_string(physical) + " \"" + name + "\"\n";
      count += names.size();
    };
    if (!version_2_) add(3, solids_);
    for (const int dim : {0, 1, 2}) add(dim, entities_[dim]);
    text_ += "$PhysicalNames\n" + std::to_string(count) + "\n" + lines + "$EndPhysicalNames\n";
  }

  void add_coordinates(std::size_t v, std::span<const double> parameters = {}) {
    const Vec3 p = mesh_.nodes[v];
    number(text_, p.x()), number(text_, p.y()), number(text_, mesh_.dimension == 3 ? p.z() : 0.0);
    for (const double x : parameters) number(text_, x);
    end_line(text_);
  }

  [[nodiscard]] std::size_t element_count() const { return mesh_.elements.size() + entities_[0].size(); }

  void add_corners(int dim, std::size_t member) {
    if (dim == 0)
      number(text_, member + 1);
    else
      for (const std::int32_t v : nodes_of(member)) number(text_, v + 1);
    end_line(text_);
  }

  [[nodiscard]] int type_of(int dim, std::size_t member) const {
    constexpr int point = 15;
    return dim == 0 ? point : mesh_.elements[member].type;
  }

  /// Members of one type, from `first` on.
  [[nodiscard]] std::size_t end_of_type(int dim, const Entity& entity, std::size_t first) const {
    std::size_t end = first;
    while (end < entity.members.size() &&
           type_of(dim, entity.members[end]) == type_of(dim, entity.members[first]))
      ++end;
    return end;
  }

  /// Every node on a curve or a face has its parameters.
  [[nodiscard]] bool knows_parameters() const {
    for (const int dim : {1, 2})
      for (const auto& [ref, entity] : entities_[dim])
        for (const std::size_t v : entity.nodes)
          if (parameters(dim, ref, v).empty()) return false;
    return association_ != nullptr;
  }

  /// The section of Gmsh's option Mesh.SaveParametric: coordinates, dimension and tag of the entity, parameters.
  void add_parametric_nodes_2() {
    text_ += "$ParametricNodes\n" + std::to_string(mesh_.nodes.size()) + "\n";
    for (const int dim : {0, 1, 2})
      for (const auto& [ref, entity] : entities_[dim])
        for (const std::size_t v : entity.nodes) {
          number(text_, v + 1), add_coordinates(v);
          text_.back() = ' ';
          number(text_, dim), number(text_, entity.tag);
          for (const double x : parameters(dim, ref, v)) number(text_, x);
          end_line(text_);
        }
    text_ += "$EndParametricNodes\n";
  }

  void add_nodes_2() {
    if (knows_parameters()) return add_parametric_nodes_2();
    text_ += "$Nodes\n" + std::to_string(mesh_.nodes.size()) + "\n";
    for (std::size_t v = 0; v < mesh_.nodes.size(); ++v) number(text_, v + 1), add_coordinates(v);
    text_ += "$EndNodes\n";
  }

  void add_elements_2() {
    text_ += "$Elements\n" + std::to_string(element_count()) + "\n";
    std::size_t tag = 0;
    for (const int dim : {0, 1, 2})
      for (const auto& [ref, entity] : entities_[dim])
        for (const std::size_t member : entity.members) {
          number(text_, ++tag), number(text_, type_of(dim, member)), number(text_, 2);
          number(text_, entity.physical), number(text_, entity.tag);
          add_corners(dim, member);
        }
    text_ += "$EndElements\n";
  }

  void add_box(const Entity& entity) {
    Vec3 low, high;
    bool any = false;
    const auto add = [&](std::int32_t v) {
      const Vec3 p = mesh_.nodes[static_cast<std::size_t>(v)];
      if (!any) low = high = p;
      any = true;
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    };
    for (const std::size_t member : entity.members)
      for (const std::int32_t v : nodes_of(member)) add(v);
    for (const double x : {low.x(), low.y(), low.z(), high.x(), high.y(), high.z()}) number(text_, x);
  }

  void add_entities() {
    text_ += "$Entities\n" + std::to_string(entities_[0].size()) + " " + std::to_string(entities_[1].size()) + " " +
             std::to_string(entities_[2].size()) + " " + std::to_string(solids_.size()) + "\n";
    for (const auto& [ref, point] : entities_[0]) {
      const Vec3 p = mesh_.nodes[point.members.front()];
      number(text_, point.tag), number(text_, p.x()), number(text_, p.y()), number(text_, p.z());
      number(text_, 1), number(text_, point.physical);
      end_line(text_);
    }
    for (const int dim : {1, 2})
      for (const auto& [ref, entity] : entities_[dim]) {
        number(text_, entity.tag);
        add_box(entity);
        number(text_, 1), number(text_, entity.physical), number(text_, entity.bounds.size());
        for (const int bound : entity.bounds) number(text_, bound);
        end_line(text_);
      }
    for (const auto& [ref, solid] : solids_) {
      number(text_, solid.tag);
      add_box(solid);
      number(text_, 1), number(text_, solid.physical), number(text_, solid.bounds.size());
      for (const int bound : solid.bounds) number(text_, bound);
      end_line(text_);
    }
    text_ += "$EndEntities\n";
  }

  void add_nodes_4() {
    struct Block {
      int dim, tag;
      std::int32_t ref;
      bool parametric;
      std::vector<std::size_t> nodes;
    };
    std::vector<Block> blocks;
    for (const int dim : {0, 1, 2})
      for (const auto& [ref, entity] : entities_[dim])
        for (const bool parametric : {true, false}) {
          Block block{dim, entity.tag, ref, parametric, {}};
          for (const std::size_t v : entity.nodes)
            if (parameters(dim, ref, v).empty() != parametric) block.nodes.push_back(v);
          if (!block.nodes.empty()) blocks.push_back(std::move(block));
        }
    const std::size_t n = mesh_.nodes.size();
    text_ += "$Nodes\n" + std::to_string(blocks.size()) + " " + std::to_string(n) + " 1 " + std::to_string(n) + "\n";
    for (const Block& block : blocks) {
      number(text_, block.dim), number(text_, block.tag), number(text_, block.parametric ? 1 : 0), number(text_, block.nodes.size());
      end_line(text_);
      for (const std::size_t v : block.nodes) text_ += std::to_string(v + 1) + "\n";
      for (const std::size_t v : block.nodes) add_coordinates(v, parameters(block.dim, block.ref, v));
    }
    text_ += "$EndNodes\n";
  }

  void add_elements_4() {
    std::size_t blocks = 0;
    for_blocks([&](int, const Entity&, std::size_t, std::size_t) { ++blocks; });
    const std::size_t n = element_count();
    text_ += "$Elements\n" + std::to_string(blocks) + " " + std::to_string(n) + " 1 " + std::to_string(n) + "\n";
    std::size_t tag = 0;
    for_blocks([&](int dim, const Entity& entity, std::size_t first, std::size_t end) {
      number(text_, dim), number(text_, entity.tag), number(text_, type_of(dim, entity.members[first]));
      number(text_, end - first);
      end_line(text_);
      for (std::size_t i = first; i < end; ++i) number(text_, ++tag), add_corners(dim, entity.members[i]);
    });
    text_ += "$EndElements\n";
  }

  /// The image of an entity under a map; parts of one face are one entity.
  struct Link {
    int master = 0;
    Isometry map;
    std::vector<std::array<std::int32_t, 2>> nodes;
  };

  void add_periodic() {
    if (mesh_.periodic == nullptr) return;
    std::map<std::array<int, 3>, Link> links;  // by dimension, tag and rank; an entity has one master beside itself in the format
    for (const PeriodicLink& link : *mesh_.periodic) {
      const Entities& entities = entities_[link.dimension];
      const auto slave = entities.find(link.slave), master = entities.find(link.master);
      if (slave == entities.end() || master == entities.end()) continue;
      std::array<int, 3> key{link.dimension, slave->second.tag, 0};
      while (slave == master && (key[2] == 0 || links.contains(key))) ++key[2];  // each map onto itself has a block
      Link& all = links.try_emplace(key, Link{master->second.tag, link.map, {}}).first->second;
      if (all.master == master->second.tag) all.nodes.insert(all.nodes.end(), link.nodes.begin(), link.nodes.end());
    }
    if (links.empty()) return;
    text_ += "$Periodic\n" + std::to_string(links.size()) + "\n";
    for (const auto& [key, link] : links) {
      number(text_, key[0]), number(text_, key[1]), number(text_, link.master), end_line(text_);
      text_ += version_2_ ? "Affine " : "16 ";
      for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) number(text_, link.map.row[static_cast<std::size_t>(i)][k]);
        number(text_, link.map.shift[i]);
      }
      text_ += "0 0 0 1\n" + std::to_string(link.nodes.size()) + "\n";
      for (const auto& [slave, master] : link.nodes) number(text_, slave + 1), number(text_, master + 1), end_line(text_);
    }
    text_ += "$EndPeriodic\n";
  }

  /// use(dimension, entity, first member, end) for each block of elements of one type.
  template <typename Use>
  void for_blocks(const Use& use) const {
    for (const int dim : {0, 1, 2})
      for (const auto& [ref, entity] : entities_[dim])
        for (std::size_t first = 0, end = 0; first < entity.members.size(); first = end) {
          end = end_of_type(dim, entity, first);
          use(dim, entity, first, end);
        }
  }

  const MshMesh& mesh_;
  bool version_2_;
  const MeshAssociation* association_;
  Entities entities_[3];  // by dimension
  Entities solids_;
  std::string text_;
};

}  // namespace

std::string msh_text(const MshMesh& mesh, bool version_2, const MeshAssociation* association) {
  return MshText(mesh, version_2, association).run();
}

std::string msh_text(const FlatMesh& mesh, bool version_2, bool curve_groups, const MeshAssociation* association) {
  return msh_text(MshMesh(mesh, curve_groups), version_2, association);
}

}  // namespace carreau
