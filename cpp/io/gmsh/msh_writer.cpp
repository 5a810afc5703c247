// SPDX-License-Identifier: BSD-3-Clause
// Gmsh's ASCII format, versions 4.1 and 2.2 (reference manual, "MSH file format"). One surface a triangle reference,
// one curve an edge reference, one point a vertex reference that no other vertex has.
#include <algorithm>
#include <limits>
#include <map>
#include <span>

#include "io/mesh_writers.h"
#include "support/format.h"

namespace carreau {

namespace {

constexpr int written_line = 1, written_line_of_order_2 = 8, written_point = 15;

/// The format's type of a kind of elements; nodes have the order of the format already.
int type_of(CellKind kind) noexcept {
  switch (kind) {
    case CellKind::triangle3:
      return 2;
    case CellKind::triangle6:
      return 9;
    case CellKind::quad4:
      return 3;
    case CellKind::quad8:
      return 16;
  }
  return 0;
}

struct Entity {
  int tag = 0, physical = 0;
  std::string name;                  // of the physical group
  std::vector<std::size_t> members;  // elements, kind by kind (for a solid: the elements of its faces), edges or the vertex
  std::vector<std::size_t> nodes;    // that belong to no entity of a lower dimension
  std::vector<int> bounds;           // tags of the faces of a solid, negative if triangles look inwards
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

class MshText {
 public:
  MshText(const FlatMesh& mesh, bool version_2, bool curve_groups)
      : mesh_(mesh), version_2_(version_2), curve_groups_(curve_groups) {
    list_cells();
    collect_entities();
    classify_nodes();
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
  void list_cells() {
    std::size_t t = 0;
    for (const Cell& cell : mesh_.cells) {
      cells_.push_back(cell), cell_refs_.push_back(ref_of(mesh_.triangle_refs, t));
      t += corner_count(cell.kind) == 4 ? 2 : 1;
    }
    for (; t < mesh_.triangles.size(); ++t) {
      Cell& cell = cells_.emplace_back();
      std::ranges::copy(mesh_.triangles[t], cell.nodes.begin());
      cell_refs_.push_back(ref_of(mesh_.triangle_refs, t));
    }
  }
  [[nodiscard]] std::span<const std::int32_t> nodes_of(std::size_t cell) const {
    return std::span(cells_[cell].nodes).first(static_cast<std::size_t>(node_count(cells_[cell].kind)));
  }

  void collect_entities() {
    for (const CellKind kind : {CellKind::quad8, CellKind::triangle6, CellKind::quad4, CellKind::triangle3})
      for (std::size_t c = 0; c < cells_.size(); ++c)
        if (cells_[c].kind == kind) entities_[2][cell_refs_[c]].members.push_back(c);
    if (curve_groups_) collect_curves();
    for (Entities& entities : entities_) give_tags(entities);
    collect_solids();
    for (auto& [ref, face] : entities_[2]) face.name = name_of_face(mesh_, ref, "face_");
    // Programs expect a group of every element when any has one.
    const auto name = [](Entities& entities, const std::map<int, std::string>& names, const char* prefix) {
      for (auto& [ref, entity] : entities) {
        const auto own = names.find(ref);
        entity.name = own != names.end() && !own->second.empty() ? plain_name(own->second) : prefix + std::to_string(entity.tag);
      }
    };
    name(entities_[0], mesh_.names.points, "point_");
    name(entities_[1], mesh_.names.curves, "curve_");
    name(solids_, mesh_.names.solids, "solid_");
    for (Entities* entities : {&entities_[0], &entities_[1], &entities_[2], &solids_}) {
      // Entities of one name are one group, under the smallest of their tags.
      std::map<std::string, int> group;
      for (auto& [ref, entity] : *entities) entity.physical = group.emplace(entity.name, entity.tag).first->second;
    }
  }

  /// Solids have no elements. The signed tags of the faces around them enable programs to fill them.
  void collect_solids() {
    for (const auto& [ref, sides] : mesh_.names.face_solids) {
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

  void collect_curves() {
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e) entities_[1][ref_of(mesh_.edge_refs, e)].members.push_back(e);
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v)
      if (ref_of(mesh_.vertex_refs, v) > 0) entities_[0][ref_of(mesh_.vertex_refs, v)].members.push_back(v);
    std::erase_if(entities_[0], [](const auto& point) { return point.second.members.size() > 1; });
  }

  void classify_nodes() {
    std::vector<bool> taken(mesh_.vertices.size(), false);
    const auto take = [&](Entity& entity, std::size_t v) {
      if (!taken[v]) entity.nodes.push_back(v), taken[v] = true;
    };
    for (auto& [ref, point] : entities_[0]) take(point, point.members.front());
    for (auto& [ref, curve] : entities_[1])
      for (const std::size_t e : curve.members) {
        for (const std::int32_t v : mesh_.edges[e]) take(curve, static_cast<std::size_t>(v));
        if (!mesh_.edge_mids.empty()) take(curve, static_cast<std::size_t>(mesh_.edge_mids[e]));
      }
    for (auto& [ref, face] : entities_[2])
      for (const std::size_t c : face.members)
        for (const std::int32_t v : nodes_of(c)) take(face, static_cast<std::size_t>(v));
    // Vertices that nothing holds.
    for (std::size_t v = 0; v < taken.size(); ++v)
      if (!taken[v] && !entities_[2].empty()) entities_[2].begin()->second.nodes.push_back(v);
  }

  void add_names() {
    std::map<std::pair<int, int>, std::string> names;
    for (const int dim : {0, 1, 2})
      for (const auto& [ref, entity] : entities_[dim]) names.emplace(std::pair{dim, entity.physical}, entity.name);
    if (!version_2_)
      for (const auto& [ref, solid] : solids_) names.emplace(std::pair{3, solid.physical}, solid.name);
    text_ += "$PhysicalNames\n" + std::to_string(names.size()) + "\n";
    for (const auto& [key, name] : names)
      text_ += std::to_string(key.first) + " " + std::to_string(key.second) + " \"" + name + "\"\n";
    text_ += "$EndPhysicalNames\n";
  }

  void add_coordinates(std::size_t v) {
    const Vec3 p = mesh_.vertices[v];
    number(text_, p.x()), number(text_, p.y()), number(text_, mesh_.dimension == 3 ? p.z() : 0.0);
    end_line(text_);
  }

  [[nodiscard]] std::size_t element_count() const {
    return cells_.size() + (curve_groups_ ? mesh_.edges.size() : 0) + entities_[0].size();
  }

  void add_corners(int dim, std::size_t member) {
    if (dim == 0) number(text_, member + 1);
    if (dim == 1) {
      for (const std::int32_t v : mesh_.edges[member]) number(text_, v + 1);
      if (!mesh_.edge_mids.empty()) number(text_, mesh_.edge_mids[member] + 1);
    }
    if (dim == 2)
      for (const std::int32_t v : nodes_of(member)) number(text_, v + 1);
    end_line(text_);
  }

  [[nodiscard]] int type_of(int dim, std::size_t member) const {
    if (dim == 0) return written_point;
    if (dim == 1) return mesh_.edge_mids.empty() ? written_line : written_line_of_order_2;
    return carreau::type_of(cells_[member].kind);
  }

  /// Members of one type, from `first` on.
  [[nodiscard]] std::size_t end_of_type(int dim, const Entity& entity, std::size_t first) const {
    std::size_t end = first;
    while (end < entity.members.size() &&
           type_of(dim, entity.members[end]) == type_of(dim, entity.members[first]))
      ++end;
    return end;
  }

  void add_nodes_2() {
    text_ += "$Nodes\n" + std::to_string(mesh_.vertices.size()) + "\n";
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) number(text_, v + 1), add_coordinates(v);
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

  void add_box(const Entity& entity, int dim) {
    Vec3 low, high;
    bool any = false;
    const auto add = [&](std::int32_t v) {
      const Vec3 p = mesh_.vertices[static_cast<std::size_t>(v)];
      if (!any) low = high = p;
      any = true;
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    };
    for (const std::size_t member : entity.members) {
      if (dim == 1)
        for (const std::int32_t v : mesh_.edges[member]) add(v);
      else
        for (const std::int32_t v : nodes_of(member)) add(v);
    }
    for (const double x : {low.x(), low.y(), low.z(), high.x(), high.y(), high.z()}) number(text_, x);
  }

  void add_entities() {
    text_ += "$Entities\n" + std::to_string(entities_[0].size()) + " " + std::to_string(entities_[1].size()) + " " +
             std::to_string(entities_[2].size()) + " " + std::to_string(solids_.size()) + "\n";
    for (const auto& [ref, point] : entities_[0]) {
      const Vec3 p = mesh_.vertices[point.members.front()];
      number(text_, point.tag), number(text_, p.x()), number(text_, p.y()), number(text_, p.z());
      number(text_, 1), number(text_, point.physical);
      end_line(text_);
    }
    for (const int dim : {1, 2})
      for (const auto& [ref, entity] : entities_[dim]) {
        number(text_, entity.tag);
        add_box(entity, dim);
        number(text_, 1), number(text_, entity.physical), number(text_, 0);
        end_line(text_);
      }
    for (const auto& [ref, solid] : solids_) {
      number(text_, solid.tag);
      add_box(solid, 2);
      number(text_, 1), number(text_, solid.physical), number(text_, solid.bounds.size());
      for (const int bound : solid.bounds) number(text_, bound);
      end_line(text_);
    }
    text_ += "$EndEntities\n";
  }

  void add_nodes_4() {
    std::size_t blocks = 0;
    for (const Entities& entities : entities_)
      for (const auto& [ref, entity] : entities) blocks += entity.nodes.empty() ? 0 : 1;
    const std::size_t n = mesh_.vertices.size();
    text_ += "$Nodes\n" + std::to_string(blocks) + " " + std::to_string(n) + " 1 " + std::to_string(n) + "\n";
    for (const int dim : {0, 1, 2})
      for (const auto& [ref, entity] : entities_[dim]) {
        if (entity.nodes.empty()) continue;
        number(text_, dim), number(text_, entity.tag), number(text_, 0), number(text_, entity.nodes.size());
        end_line(text_);
        for (const std::size_t v : entity.nodes) text_ += std::to_string(v + 1) + "\n";
        for (const std::size_t v : entity.nodes) add_coordinates(v);
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
    std::map<std::pair<int, int>, Link> links;  // by dimension and tag; an entity has one master in the format
    for (const PeriodicLink& link : mesh_.periodic) {
      const Entities& entities = entities_[link.dimension];
      const auto slave = entities.find(link.slave), master = entities.find(link.master);
      if (slave == entities.end() || master == entities.end()) continue;
      Link& all = links.try_emplace({link.dimension, slave->second.tag}, Link{master->second.tag, link.map, {}}).first->second;
      if (all.master == master->second.tag) all.nodes.insert(all.nodes.end(), link.nodes.begin(), link.nodes.end());
    }
    if (links.empty()) return;
    text_ += "$Periodic\n" + std::to_string(links.size()) + "\n";
    for (const auto& [key, link] : links) {
      number(text_, key.first), number(text_, key.second), number(text_, link.master), end_line(text_);
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

  const FlatMesh& mesh_;
  bool version_2_, curve_groups_;
  std::vector<Cell> cells_;  // every element, straight triangles too
  std::vector<std::int32_t> cell_refs_;
  Entities entities_[3];  // by dimension
  Entities solids_;
  std::string text_;
};

}  // namespace

std::string msh_text(const FlatMesh& mesh, bool version_2, bool curve_groups) {
  return MshText(mesh, version_2, curve_groups).run();
}

}  // namespace carreau
