// SPDX-License-Identifier: BSD-3-Clause
#include "volume/volume_files.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <functional>
#include <map>
#include <set>
#include <unordered_map>

#include "base/failure.h"
#include "base/text_file.h"

namespace command {
namespace {

void add(std::string& text, double x) {
  char number[40];
  text.append(number, static_cast<std::size_t>(std::snprintf(number, sizeof number, "%.17g", x)));
}

/// The shortest text that reads back as x if it has 20 characters, the most that CalculiX takes; else the nearest number of 20 characters.
std::string narrow(double x) {
  char number[40];
  for (int digits = 17;; --digits)
    if (std::snprintf(number, sizeof number, "%.*g", digits, x) <= 20) return number;
}

/// Members of a group: numbers of solids, or references of faces.
struct Group {
  std::string name;
  int number = 0;  ///< its smallest member, from 1
  std::vector<std::int32_t> members;
};

/// Letters, digits and '_' for solvers, whose names begin with a letter and differ in more than capitals.
std::string word_of(const std::string& name, std::set<std::string>& taken) {
  std::string word;
  for (const char c : name) word += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  if (word.empty() || std::isalpha(static_cast<unsigned char>(word.front())) == 0) word = "n_" + word;
  word = word.substr(0, 70);
  const auto in_capitals = [](std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](char c) { return static_cast<char>(std::toupper(static_cast<unsigned char>(c))); });
    return text;
  };
  std::string distinct = word;
  for (int k = 2; !taken.insert(in_capitals(distinct)).second; ++k) distinct = word + "_" + std::to_string(k);
  return distinct;
}

std::vector<Group> groups_of(const std::set<std::int32_t>& members, const std::map<std::int32_t, std::string>& names, const char* prefix) {
  std::map<std::string, Group> by_name;
  int last = 0;
  for (const std::int32_t member : members) last = std::max(last, member);
  for (const std::int32_t member : members) {
    const auto own = names.find(member);
    std::string name = own != names.end() ? own->second : "";
    std::replace_if(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '"'; }, '_');
    if (name.empty()) name = prefix + (member < 0 ? "m" + std::to_string(-static_cast<std::int64_t>(member)) : std::to_string(member));
    Group& group = by_name[name];
    group.name = name;
    if (group.members.empty()) group.number = member > 0 ? member : ++last;
    group.members.push_back(member);
  }
  std::vector<Group> groups;
  for (auto& [name, group] : by_name) groups.push_back(std::move(group));
  std::sort(groups.begin(), groups.end(), [](const Group& p, const Group& q) { return p.number < q.number; });
  return groups;
}

class VolumeText {
 public:
  explicit VolumeText(const VolumeMesh& volume) : volume_(volume) {
    std::set<std::int32_t> faces(volume.surface.refs.begin(), volume.surface.refs.end()), solids(volume.solids.begin(), volume.solids.end());
    faces_ = groups_of(faces, volume.surface.faces, "face_");
    solids_ = groups_of(solids, volume.surface.solids, "solid_");
    int last = faces.empty() ? 0 : std::max(*faces.rbegin(), 0);
    for (const std::int32_t ref : faces) tags_[ref] = ref > 0 ? ref : ++last;
    for (const Group& group : faces_)
      for (const std::int32_t member : group.members) face_group_[member] = group.number;
    for (const Group& group : solids_)
      for (const std::int32_t member : group.members) solid_group_[member] = group.number;
  }

  std::string msh() {
    text_ = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
    add_names();
    text_ += "$Entities\n0 0 " + std::to_string(tags_.size()) + ' ' + std::to_string(solid_group_.size()) + '\n';
    std::map<std::int32_t, std::map<int, int>> bounds;  // of solids: faces with their signs
    for (std::size_t t = 0; t < volume_.surface.triangles.size(); ++t)
      for (const std::size_t side : {0U, 1U})
        if (const std::int32_t solid = volume_.surface.sides[t][side]; solid > 0 && volume_.surface.sides[t][0] != volume_.surface.sides[t][1])
          bounds[solid][tags_.at(volume_.surface.refs[t])] = side == 0 ? 1 : -1;
    for (const auto& [ref, tag] : tags_) {
      text_ += std::to_string(tag) + ' ';
      add_box([&, r = ref](const std::function<void(std::int32_t)>& use) {
        for (std::size_t t = 0; t < volume_.surface.triangles.size(); ++t)
          if (volume_.surface.refs[t] == r)
            for (const std::int32_t v : volume_.surface.triangles[t]) use(v);
      });
      text_ += "1 " + std::to_string(face_group_.at(ref)) + " 0\n";
    }
    for (const auto& [solid, number] : solid_group_) {
      text_ += std::to_string(solid) + ' ';
      add_box([&, s = solid](const std::function<void(std::int32_t)>& use) {
        for (std::size_t i = 0; i < volume_.tetrahedra.size(); ++i)
          if (volume_.solids[i] == s)
            for (const std::int32_t v : volume_.tetrahedra[i]) use(v);
      });
      text_ += "1 " + std::to_string(number) + ' ' + std::to_string(bounds[solid].size());
      for (const auto& [face, sign] : bounds[solid]) text_ += ' ' + std::to_string(sign * face);
      text_ += '\n';
    }
    text_ += "$EndEntities\n";
    add_nodes_4();
    const auto triangles = by_key(volume_.surface.refs);
    const auto tetrahedra = by_key(volume_.solids);
    const std::size_t n = volume_.surface.triangles.size() + volume_.tetrahedra.size();
    text_ += "$Elements\n" + std::to_string(triangles.size() + tetrahedra.size()) + ' ' + std::to_string(n) + " 1 " + std::to_string(n) + '\n';
    std::size_t number = 0;
    for (const auto& [ref, members] : triangles) {
      text_ += "2 " + std::to_string(tags_.at(ref)) + ' ' + (volume_.is_quadratic() ? "9 " : "2 ") + std::to_string(members.size()) + '\n';
      for (const std::size_t t : members) text_ += std::to_string(++number), add_triangle(t, 1), text_ += '\n';
    }
    for (const auto& [solid, members] : tetrahedra) {
      text_ += "3 " + std::to_string(solid) + ' ' + (volume_.is_quadratic() ? "11 " : "4 ") + std::to_string(members.size()) + '\n';
      for (const std::size_t t : members) text_ += std::to_string(++number), add_tetrahedron(t, 1, true), text_ += '\n';
    }
    return std::move(text_) + "$EndElements\n";
  }

  std::string msh2() {
    text_ = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    add_names();
    text_ += "$Nodes\n" + std::to_string(volume_.vertices.size()) + '\n';
    for (std::size_t v = 0; v < volume_.vertices.size(); ++v) text_ += std::to_string(v + 1), add_point(v, " "), text_ += '\n';
    text_ += "$EndNodes\n$Elements\n" + std::to_string(volume_.surface.triangles.size() + volume_.tetrahedra.size()) + '\n';
    std::size_t number = 0;
    for (std::size_t t = 0; t < volume_.surface.triangles.size(); ++t) {
      const std::int32_t ref = volume_.surface.refs[t];
      text_ += std::to_string(++number) + (volume_.is_quadratic() ? " 9 2 " : " 2 2 ") + std::to_string(face_group_.at(ref)) + ' ' + std::to_string(tags_.at(ref));
      add_triangle(t, 1), text_ += '\n';
    }
    for (std::size_t t = 0; t < volume_.tetrahedra.size(); ++t) {
      text_ += std::to_string(++number) + (volume_.is_quadratic() ? " 11 2 " : " 4 2 ") + std::to_string(solid_group_.at(volume_.solids[t])) + ' ' + std::to_string(volume_.solids[t]);
      add_tetrahedron(t, 1, true), text_ += '\n';
    }
    return std::move(text_) + "$EndElements\n";
  }

  std::string inp() {
    text_ = "*HEADING\nmesh by Carreau\n*NODE, NSET=all_nodes\n";
    for (std::size_t v = 0; v < volume_.vertices.size(); ++v) {
      text_ += std::to_string(v + 1);
      for (const double x : volume_.vertices[v]) text_ += ", " + narrow(x);
      text_ += '\n';
    }
    std::set<std::string> taken;
    const auto tetrahedra = by_key(volume_.solids);
    std::string sets = "*ELSET, ELSET=all_solids\n";
    (void)word_of("all_nodes", taken), (void)word_of("all_solids", taken);
    for (const Group& group : solids_) {
      const std::string name = word_of(group.name, taken);
      text_ += std::string("*ELEMENT, TYPE=") + (volume_.is_quadratic() ? "C3D10" : "C3D4") + ", ELSET=" + name + '\n';
      sets += name + '\n';
      for (const std::int32_t solid : group.members)
        for (const std::size_t t : tetrahedra.at(solid)) text_ += std::to_string(t + 1), add_tetrahedron(t, 1, false, ", "), text_ += '\n';
    }
    text_ += sets;
    const auto triangles = by_key(volume_.surface.refs);
    const auto sides = sides_of_elements();
    // Each face is a set, beside the set of its group.
    std::vector<Group> groups = groups_of(keys_of(triangles), {}, "face_");
    for (const Group& group : faces_)
      if (group.members.size() > 1 || group.name != groups_of({group.members.front()}, {}, "face_").front().name) groups.push_back(group);
    for (const Group& group : groups) {
      const std::string name = word_of(group.name, taken);
      std::set<std::int32_t> nodes;
      std::string surface = "*SURFACE, NAME=" + name + ", TYPE=ELEMENT\n";
      for (const std::int32_t ref : group.members)
        for (const std::size_t t : triangles.at(ref)) {
          nodes.insert(volume_.surface.triangles[t].begin(), volume_.surface.triangles[t].end());
          if (volume_.is_quadratic()) nodes.insert(volume_.triangle_mids[t].begin(), volume_.triangle_mids[t].end());
          surface += std::to_string(sides[t].first + 1) + ", S" + std::to_string(sides[t].second + 1) + '\n';
        }
      text_ += "*NSET, NSET=" + name + '\n';
      for (const std::int32_t v : nodes) text_ += std::to_string(v + 1) + '\n';
      text_ += surface;
    }
    return std::move(text_);
  }

  std::string su2() {
    text_ = "NDIME= 3\nNELEM= " + std::to_string(volume_.tetrahedra.size()) + '\n';
    for (std::size_t t = 0; t < volume_.tetrahedra.size(); ++t) text_ += "10", add_tetrahedron(t, 0, false), text_ += ' ' + std::to_string(t) + '\n';
    text_ += "NPOIN= " + std::to_string(volume_.vertices.size()) + '\n';
    for (std::size_t v = 0; v < volume_.vertices.size(); ++v) add_point(v, " "), text_ += ' ' + std::to_string(v) + '\n';
    const auto triangles = by_key(volume_.surface.refs);
    std::set<std::string> taken;
    text_ += "NMARK= " + std::to_string(faces_.size()) + '\n';
    for (const Group& group : faces_) {
      std::size_t count = 0;
      for (const std::int32_t ref : group.members) count += triangles.at(ref).size();
      text_ += "MARKER_TAG= " + word_of(group.name, taken) + "\nMARKER_ELEMS= " + std::to_string(count) + '\n';
      for (const std::int32_t ref : group.members)
        for (const std::size_t t : triangles.at(ref)) text_ += '5', add_triangle(t, 0), text_ += '\n';
    }
    return std::move(text_);
  }

  std::string mesh() {
    text_ = "MeshVersionFormatted 2\n\nDimension\n3\n\nVertices\n" + std::to_string(volume_.vertices.size()) + '\n';
    for (std::size_t v = 0; v < volume_.vertices.size(); ++v) add_point(v, " "), text_ += " 0\n";
    const char* const order = volume_.is_quadratic() ? "P2" : "";
    text_ += std::string("\nTriangles") + order + '\n' + std::to_string(volume_.surface.triangles.size()) + '\n';
    for (std::size_t t = 0; t < volume_.surface.triangles.size(); ++t) add_triangle(t, 1), text_ += ' ' + std::to_string(volume_.surface.refs[t]) + '\n';
    text_ += std::string("\nTetrahedra") + order + '\n' + std::to_string(volume_.tetrahedra.size()) + '\n';
    for (std::size_t t = 0; t < volume_.tetrahedra.size(); ++t) add_tetrahedron(t, 1, false), text_ += ' ' + std::to_string(volume_.solids[t]) + '\n';
    return std::move(text_) + "\nEnd\n";
  }

  std::string vtu() {
    const std::size_t m = volume_.surface.triangles.size(), n = volume_.tetrahedra.size();
    text_ = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
            std::to_string(volume_.vertices.size()) + "\" NumberOfCells=\"" + std::to_string(m + n) + "\">\n<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n";
    for (std::size_t v = 0; v < volume_.vertices.size(); ++v) add_point(v, " "), text_ += '\n';
    text_ += "</DataArray>\n</Points>\n<Cells>\n<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">\n";
    for (std::size_t t = 0; t < n; ++t) add_tetrahedron(t, 0, false), text_ += '\n';
    for (std::size_t t = 0; t < m; ++t) add_triangle(t, 0), text_ += '\n';
    const std::size_t nodes = volume_.is_quadratic() ? 10 : 4, corners = volume_.is_quadratic() ? 6 : 3;
    begin_array("Int64", "offsets");
    for (std::size_t t = 0; t < n + m; ++t) text_ += std::to_string(t < n ? (t + 1) * nodes : n * nodes + (t + 1 - n) * corners) + '\n';
    begin_array("UInt8", "types");
    for (std::size_t t = 0; t < n + m; ++t) text_ += t < n ? (volume_.is_quadratic() ? "24\n" : "10\n") : (volume_.is_quadratic() ? "22\n" : "5\n");
    text_ += "</DataArray>\n</Cells>\n<CellData>\n<DataArray type=\"Int32\" Name=\"solid\" format=\"ascii\">\n";
    for (std::size_t t = 0; t < n + m; ++t) text_ += std::to_string(t < n ? volume_.solids[t] : 0) + '\n';
    begin_array("Int32", "ref");
    for (std::size_t t = 0; t < n + m; ++t) text_ += std::to_string(t < n ? volume_.solids[t] : volume_.surface.refs[t - n]) + '\n';
    return std::move(text_) + "</DataArray>\n</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  }

 private:
  using Members = std::map<std::int32_t, std::vector<std::size_t>>;
  static std::set<std::int32_t> keys_of(const Members& members) {
    std::set<std::int32_t> keys;
    for (const auto& [key, each] : members) keys.insert(key);
    return keys;
  }
  static Members by_key(const std::vector<std::int32_t>& keys) {
    Members members;
    for (std::size_t i = 0; i < keys.size(); ++i) members[keys[i]].push_back(i);
    return members;
  }
  void begin_array(const char* type, const char* name) {
    text_ += std::string("</DataArray>\n<DataArray type=\"") + type + "\" Name=\"" + name + "\" format=\"ascii\">\n";
  }
  void add_names() {
    text_ += "$PhysicalNames\n" + std::to_string(faces_.size() + solids_.size()) + '\n';
    for (const Group& group : faces_) text_ += "2 " + std::to_string(group.number) + " \"" + group.name + "\"\n";
    for (const Group& group : solids_) text_ += "3 " + std::to_string(group.number) + " \"" + group.name + "\"\n";
    text_ += "$EndPhysicalNames\n";
  }
  void add_point(std::size_t v, const char* between) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (k > 0 || between[0] == ',' || text_.back() != '\n') text_ += between;
      add(text_, volume_.vertices[v][k]);
    }
  }
  template <typename Each>
  void add_box(const Each& each) {
    Point low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
    each([&](std::int32_t v) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = volume_.vertices[static_cast<std::size_t>(v)][k];
        low[k] = std::min(low[k], x), high[k] = std::max(high[k], x);
      }
    });
    for (const Point& p : {low, high})
      for (const double x : p) add(text_, x), text_ += ' ';
  }
  void add_triangle(std::size_t t, int base) {
    for (const std::int32_t v : volume_.surface.triangles[t]) text_ += ' ' + std::to_string(v + base);
    if (volume_.is_quadratic())
      for (const std::int32_t v : volume_.triangle_mids[t]) text_ += ' ' + std::to_string(v + base);
  }
  /// Gmsh has the nodes of the edges 23 and 13 in this order.
  void add_tetrahedron(std::size_t t, int base, bool gmsh, const char* between = " ") {
    for (const std::int32_t v : volume_.tetrahedra[t]) text_ += between + std::to_string(v + base);
    if (!volume_.is_quadratic()) return;
    auto mids = volume_.tetrahedron_mids[t];
    if (gmsh) std::swap(mids[4], mids[5]);
    for (const std::int32_t v : mids) text_ += between + std::to_string(v + base);
  }
  void add_nodes_4() {
    std::vector<std::pair<int, std::int32_t>> owner(volume_.vertices.size(), {0, 0});  // dimension and tag: the first entity that has a node
    const auto take = [&](int dimension, std::int32_t tag, std::int32_t v) {
      if (owner[static_cast<std::size_t>(v)].first == 0) owner[static_cast<std::size_t>(v)] = {dimension, tag};
    };
    for (std::size_t t = 0; t < volume_.surface.triangles.size(); ++t) {
      const int tag = tags_.at(volume_.surface.refs[t]);
      for (const std::int32_t v : volume_.surface.triangles[t]) take(2, tag, v);
      if (volume_.is_quadratic())
        for (const std::int32_t v : volume_.triangle_mids[t]) take(2, tag, v);
    }
    for (std::size_t t = 0; t < volume_.tetrahedra.size(); ++t) {
      for (const std::int32_t v : volume_.tetrahedra[t]) take(3, volume_.solids[t], v);
      if (volume_.is_quadratic())
        for (const std::int32_t v : volume_.tetrahedron_mids[t]) take(3, volume_.solids[t], v);
    }
    std::map<std::pair<int, std::int32_t>, std::vector<std::size_t>> blocks;
    for (std::size_t v = 0; v < owner.size(); ++v)
      if (owner[v].first != 0) blocks[owner[v]].push_back(v);
    std::size_t n = 0;
    for (const auto& [key, nodes] : blocks) n += nodes.size();
    text_ += "$Nodes\n" + std::to_string(blocks.size()) + ' ' + std::to_string(n) + " 1 " + std::to_string(volume_.vertices.size()) + '\n';
    for (const auto& [key, nodes] : blocks) {
      text_ += std::to_string(key.first) + ' ' + std::to_string(key.second) + " 0 " + std::to_string(nodes.size()) + '\n';
      for (const std::size_t v : nodes) text_ += std::to_string(v + 1) + '\n';
      for (const std::size_t v : nodes) add_point(v, " "), text_ += '\n';
    }
    text_ += "$EndNodes\n";
  }
  /// The element behind each triangle, and its side as CalculiX counts it: 123, 142, 243, 341.
  std::vector<std::pair<std::size_t, std::size_t>> sides_of_elements() const {
    std::map<std::array<std::int32_t, 3>, std::size_t> triangles;
    const auto key = [](std::int32_t a, std::int32_t b, std::int32_t c) {
      std::array<std::int32_t, 3> v{a, b, c};
      std::sort(v.begin(), v.end());
      return v;
    };
    for (std::size_t t = 0; t < volume_.surface.triangles.size(); ++t) {
      const auto& v = volume_.surface.triangles[t];
      triangles[key(v[0], v[1], v[2])] = t;
    }
    std::vector<std::pair<std::size_t, std::size_t>> sides(volume_.surface.triangles.size());
    constexpr std::array<std::array<std::size_t, 3>, 4> faces{{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};
    for (std::size_t i = 0; i < volume_.tetrahedra.size(); ++i)
      for (std::size_t f = 0; f < 4; ++f) {
        const auto& v = volume_.tetrahedra[i];
        const auto found = triangles.find(key(v[faces[f][0]], v[faces[f][1]], v[faces[f][2]]));
        // A triangle between two solids belongs to the solid that it looks out of.
        if (found != triangles.end() && (volume_.solids[i] == volume_.surface.sides[found->second][0] || volume_.surface.sides[found->second][0] == 0))
          sides[found->second] = {i, f};
      }
    return sides;
  }

  const VolumeMesh& volume_;
  std::vector<Group> faces_, solids_;
  std::map<std::int32_t, int> tags_, face_group_, solid_group_;  // by reference of a face, by solid
  std::string text_;
};

}  // namespace

void refuse_order(const std::vector<std::string>& paths, bool quadratic) {
  for (const std::string& path : paths)
    if (quadratic && suffix_of(path) == ".su2") throw Failure("'" + path + "' cannot hold elements p2: .su2 holds elements of order 1 only.");
}

std::string volume_text(const VolumeMesh& volume, const std::string& suffix) {
  VolumeText text(volume);
  if (suffix == ".msh") return text.msh();
  if (suffix == ".msh2") return text.msh2();
  if (suffix == ".inp") return text.inp();
  if (suffix == ".su2") return text.su2();
  if (suffix == ".vtu") return text.vtu();
  return text.mesh();
}

}  // namespace command
