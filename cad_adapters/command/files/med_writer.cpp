// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <utility>
#include <vector>

#include "base/failure.h"
#include "files/med_file.h"
#include "files/med_library.h"
#include "files/periodic_pairs.h"
#include "files/session_handle.h"

namespace command {
namespace {

constexpr char mesh_name[] = "carreau";

/// Elements of one kind: nodes from 1, families.
struct Elements {
  std::vector<med_int> nodes, families;
};

std::string numbered(const char* before, std::int32_t ref) {
  std::string name = before;
  if (ref < 0) name += 'm';
  return name += std::to_string(std::abs(static_cast<std::int64_t>(ref)));
}

/// The longest beginning of a text in UTF-8 that a group can have as its name.
std::string group_name(std::string text) {
  std::size_t length = std::min<std::size_t>(text.size(), MED_LNAME_SIZE);
  while (length < text.size() && length > 0 && (static_cast<unsigned char>(text[length]) & 0xc0) == 0x80) --length;
  text.resize(length);
  return text;
}

class MedWriter {
 public:
  MedWriter(carreau_mesh* mesh, const std::string& path) : mesh_(mesh), path_(path), med_(med_library()) {}
  ~MedWriter() {
    if (file_ >= 0) med_.fileClose(file_);
  }
  MedWriter(const MedWriter&) = delete;
  MedWriter& operator=(const MedWriter&) = delete;

  void run();

 private:
  void check(bool good) const {
    if (!good) throw Failure("'" + path_ + "' cannot be written: the MED library reports an error.");
  }
  med_int family(const std::string& group, const std::string& name);
  void begin(const MeshArrays& arrays);
  void gather_surface(const MeshArrays& arrays);
  void gather_edges(const MeshArrays& arrays);
  std::vector<med_int> node_families(std::size_t n);
  void add(med_geometry_type type, med_int family, const std::int32_t* nodes, std::size_t n);
  void write_pairs();

  carreau_mesh* mesh_;
  std::string path_;
  const MedLibrary& med_;
  med_idt file_ = -1;
  med_int families_ = 0;
  std::map<med_geometry_type, Elements> elements_;
};

/// Makes a family of elements, whose number is below 0.
med_int MedWriter::family(const std::string& group, const std::string& name) {
  std::string groups = group;
  groups.resize(MED_LNAME_SIZE, '\0');
  if (!name.empty() && name != group) groups += group_name(name);
  const med_int count = groups.size() > MED_LNAME_SIZE ? 2 : 1;
  groups.resize(static_cast<std::size_t>(count) * MED_LNAME_SIZE + 1, '\0');
  check(med_.familyCr(file_, mesh_name, group.c_str(), --families_, count, groups.c_str()) >= 0);
  return families_;
}

void MedWriter::begin(const MeshArrays& arrays) {
  file_ = med_.fileOpen(path_.c_str(), MED_ACC_CREAT);
  check(file_ >= 0);
  const auto space = static_cast<std::size_t>(arrays.dimension);
  std::string axes, units(space * MED_SNAME_SIZE + 1, '\0');
  for (const char* axis : {"x", "y", "z"})
    axes += axis, axes.resize((axes.size() / MED_SNAME_SIZE + 1) * MED_SNAME_SIZE, ' ');
  axes.resize(space * MED_SNAME_SIZE);
  check(med_.meshCr(file_, mesh_name, arrays.dimension, 2, MED_UNSTRUCTURED_MESH, "", "", MED_SORT_DTIT, MED_CARTESIAN,
                    axes.c_str(), units.c_str()) >= 0);
  std::vector<double> coordinates;
  coordinates.reserve(arrays.vertices.size() * space);
  for (const auto& p : arrays.vertices) coordinates.insert(coordinates.end(), p.begin(), p.begin() + arrays.dimension);
  check(med_.meshNodeCoordinateWr(file_, mesh_name, MED_NO_DT, MED_NO_IT, MED_UNDEF_DT, MED_FULL_INTERLACE,
                                  static_cast<med_int>(arrays.vertices.size()), coordinates.data()) >= 0);
  check(med_.familyCr(file_, mesh_name, "FAMILLE_ZERO", 0, 0, "") >= 0);  // the format requires it
}

void MedWriter::add(med_geometry_type type, med_int family, const std::int32_t* nodes, std::size_t n) {
  Elements& own = elements_[type];
  for (std::size_t k = 0; k < n; ++k) own.nodes.push_back(nodes[k] + 1);
  own.families.push_back(family);
}

void MedWriter::gather_surface(const MeshArrays& arrays) {
  std::map<std::int32_t, std::string> names;
  for (const FaceResult& face : arrays.faces) names[face.ref] = face.name;
  std::map<std::int32_t, med_int> families;
  const auto family_of = [&](std::int32_t ref) {
    const auto [place, is_new] = families.emplace(ref, 0);
    if (is_new) place->second = family(numbered("face_", ref), names[ref]);
    return place->second;
  };
  if (arrays.elements.empty())
    for (std::size_t t = 0; t < arrays.triangles.size(); ++t)
      add(MED_TRIA3, family_of(arrays.triangle_refs[t]), arrays.triangles[t].data(), 3);
  for (const Element& element : arrays.elements) {
    const bool quad = element.corners() == 4;
    const med_geometry_type type = quad                  ? (element.is_curved() ? MED_QUAD8 : MED_QUAD4)
                                   : element.is_curved() ? MED_TRIA6
                                                         : MED_TRIA3;
    add(type, family_of(element.ref), element.nodes.data(),
        static_cast<std::size_t>(element.corners() * (element.is_curved() ? 2 : 1)));
  }
}

void MedWriter::gather_edges(const MeshArrays& arrays) {
  const std::size_t n = arrays.edges.size();
  if (n == 0) return;
  std::vector<std::int32_t> refs(n), mids(n, -1);
  require(mesh_, carreau_mesh_edge_refs(mesh_, static_cast<std::int64_t>(n), refs.data()));
  if (!arrays.elements.empty())
    require(mesh_, carreau_mesh_edge_mids(mesh_, static_cast<std::int64_t>(n), mids.data()));
  std::map<std::int32_t, med_int> families;
  for (std::size_t i = 0; i < n; ++i) {
    const auto [place, is_new] = families.emplace(refs[i], 0);
    if (is_new) place->second = family(numbered("curve_", refs[i]), carreau_mesh_entity_name(mesh_, 1, refs[i]));
    const std::int32_t nodes[] = {arrays.edges[i][0], arrays.edges[i][1], mids[i]};
    add(mids[i] < 0 ? MED_SEG2 : MED_SEG3, place->second, nodes, mids[i] < 0 ? 2 : 3);
  }
}

/// Families of nodes have numbers above 0; empty: no point has a name.
std::vector<med_int> MedWriter::node_families(std::size_t n) {
  std::vector<std::int32_t> refs(n);
  if (carreau_mesh_vertex_refs(mesh_, static_cast<std::int64_t>(n), refs.data()) != CARREAU_OK) return {};
  std::vector<med_int> families(n, 0);
  std::map<std::string, med_int> known;
  for (std::size_t v = 0; v < n; ++v) {
    const std::string name = refs[v] == 0 ? "" : carreau_mesh_entity_name(mesh_, 0, refs[v]);
    if (name.empty()) continue;
    const auto [place, is_new] = known.emplace(name, static_cast<med_int>(known.size() + 1));
    families[v] = place->second;
    if (!is_new) continue;
    std::string group = group_name(name);
    group.resize(MED_LNAME_SIZE + 1, '\0');
    check(med_.familyCr(file_, mesh_name, numbered("points_", static_cast<std::int32_t>(place->second)).c_str(), place->second, 1, group.c_str()) >= 0);
  }
  return known.empty() ? std::vector<med_int>{} : families;
}

/// One equivalence of nodes, slave and master, for each pair of faces, curves or points; its description is the map.
void MedWriter::write_pairs() {
  constexpr std::array<const char*, 3> entities{"points", "curves", "faces"};
  const PeriodicPairs pairs = pairs_of(mesh_);
  const std::int32_t* node = pairs.node.data();
  for (std::size_t i = 0; i < pairs.dimension.size(); ++i) {
    const std::string name = std::string("periodic_") + entities[static_cast<std::size_t>(pairs.dimension[i])] + "_" + std::to_string(pairs.ref[2 * i]) + "_" +
                             std::to_string(pairs.ref[2 * i + 1]);
    std::string map;
    for (std::size_t k = 0; k < 12; ++k) {
      char number[32];
      std::snprintf(number, sizeof number, k > 0 ? " %.8g" : "%.8g", pairs.map[12 * i + k]);
      map += number;
    }
    std::vector<med_int> nodes;
    for (std::int64_t k = 0; k < 2 * pairs.count[i]; ++k) nodes.push_back(*node++ + 1);
    check(med_.equivalenceCr(file_, mesh_name, name.c_str(), map.c_str()) >= 0);
    check(med_.equivalenceCorrespondenceWr(file_, mesh_name, name.c_str(), MED_NO_DT, MED_NO_IT, MED_NODE, MED_NONE,
                                           static_cast<med_int>(pairs.count[i]), nodes.data()) >= 0);
  }
}

void MedWriter::run() {
  const MeshArrays arrays = arrays_of(mesh_);
  begin(arrays);
  gather_surface(arrays);
  gather_edges(arrays);
  if (const std::vector<med_int> families = node_families(arrays.vertices.size()); !families.empty())
    check(med_.meshEntityFamilyNumberWr(file_, mesh_name, MED_NO_DT, MED_NO_IT, MED_NODE, MED_NONE,
                                        static_cast<med_int>(families.size()), families.data()) >= 0);
  for (const auto& [type, each] : elements_) {
    const auto n = static_cast<med_int>(each.families.size());
    check(med_.meshElementConnectivityWr(file_, mesh_name, MED_NO_DT, MED_NO_IT, MED_UNDEF_DT, MED_CELL, type,
                                         MED_NODAL, MED_FULL_INTERLACE, n, each.nodes.data()) >= 0);
    check(med_.meshEntityFamilyNumberWr(file_, mesh_name, MED_NO_DT, MED_NO_IT, MED_CELL, type, n,
                                        each.families.data()) >= 0);
  }
  write_pairs();
  check(med_.fileClose(std::exchange(file_, -1)) >= 0);
}

}  // namespace

void write_med(carreau_mesh* mesh, const std::string& path) { MedWriter(mesh, path).run(); }

}  // namespace command
