// SPDX-License-Identifier: BSD-3-Clause
#include "io/solver/element_sets.h"

#include <algorithm>
#include <map>
#include <set>

#include "io/mesh_writers.h"
#include "io/text.h"
#include "support/error.h"

namespace carreau {

namespace {

std::string numbered(const char* what, std::int32_t ref) {
  const std::string number = std::to_string(std::int64_t{ref});
  return what + (ref < 0 ? "m" + number.substr(1) : number);
}

bool is_letter(char c) noexcept { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_plain(char c) noexcept { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; }

/// Names that every format takes, none twice.
class Names {
 public:
  explicit Names(std::size_t longest) : longest_(longest) {}

  void take(const std::string& name) { taken_.insert(in_capitals(name)); }

  std::string clean(std::string name) {
    std::ranges::replace_if(name, [](char c) { return !is_plain(c); }, '_');
    if (!is_letter(name.front())) name.insert(0, "n_");
    name.resize(std::min(name.size(), longest_));
    std::string result = name;
    for (int i = 2; !taken_.insert(in_capitals(result)).second; ++i) {
      const std::string end = "_" + std::to_string(i);
      result = name.substr(0, std::min(name.size(), longest_ - end.size())) + end;
    }
    return result;
  }

 private:
  std::size_t longest_;
  std::set<std::string> taken_;  ///< in capitals
};

/// Elements with the references of their faces.
std::map<std::int32_t, std::vector<Cell>> cells_by_face(const FlatMesh& mesh) {
  std::map<std::int32_t, std::vector<Cell>> faces;
  std::size_t t = 0;
  for (const Cell& cell : mesh.cells) {
    faces[ref_of(mesh.triangle_refs, t)].push_back(cell);
    t += corner_count(cell.kind) == 4 ? 2 : 1;
  }
  for (; t < mesh.triangles.size(); ++t) {
    Cell cell;
    std::ranges::copy(mesh.triangles[t], cell.nodes.begin());
    faces[ref_of(mesh.triangle_refs, t)].push_back(cell);
  }
  for (auto& [ref, cells] : faces)
    std::ranges::stable_sort(cells, [](const Cell& a, const Cell& b) { return a.kind < b.kind; });
  return faces;
}

std::map<std::int32_t, std::vector<std::vector<std::int32_t>>> edges_by_curve(const FlatMesh& mesh) {
  std::map<std::int32_t, std::vector<std::vector<std::int32_t>>> curves;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    std::vector<std::int32_t>& nodes =
        curves[ref_of(mesh.edge_refs, e)].emplace_back(mesh.edges[e].begin(), mesh.edges[e].end());
    if (!mesh.edge_mids.empty()) nodes.push_back(mesh.edge_mids[e]);
  }
  return curves;
}

/// Things of one name, in the order of the first of each: `list` is their member of Named, `ref_of(i)` a thing's reference.
template <typename Named, typename RefOf>
std::vector<Named> named(std::size_t count, std::vector<std::size_t> Named::*list, const RefOf& reference, const std::map<std::int32_t, std::string>& given,
                         Names& names) {
  std::vector<Named> found;
  std::map<std::string, std::size_t> place;
  for (std::size_t i = 0; i < count && !given.empty(); ++i) {
    const auto name = given.find(reference(i));
    if (name == given.end() || name->second.empty()) continue;
    const auto [at, fresh] = place.emplace(name->second, found.size());
    if (fresh) found.push_back({names.clean(name->second), {}});
    (found[at->second].*list).push_back(i);
  }
  return found;
}

}  // namespace

ElementSets sets_of(const FlatMesh& mesh, std::size_t longest) {
  ElementSets sets;
  Names names(longest);
  std::map<std::int32_t, std::string> given;
  for (const FlatFace& face : mesh.faces) given.emplace(face.ref, face.name);
  for (auto& [ref, cells] : cells_by_face(mesh)) {
    sets.faces.push_back({ref, numbered("face_", ref), sets.elements + 1, std::move(cells)});
    sets.elements += sets.faces.back().cells.size();
    names.take(sets.faces.back().name);
  }
  for (auto& [ref, edges] : edges_by_curve(mesh)) {
    sets.curves.push_back({ref, numbered("curve_", ref), sets.elements + 1, std::move(edges)});
    sets.elements += sets.curves.back().edges.size();
    names.take(sets.curves.back().name);
  }
  for (const char* own : {"all_nodes", "all_faces"}) names.take(own);
  sets.names = named(sets.faces.size(), &NamedSets::sets, [&](std::size_t i) { return sets.faces[i].ref; }, given, names);
  const std::map<std::int32_t, std::string> of_curves(mesh.names.curves.begin(), mesh.names.curves.end());
  sets.curve_names = named(sets.curves.size(), &NamedSets::sets, [&](std::size_t i) { return sets.curves[i].ref; }, of_curves, names);
  const std::map<std::int32_t, std::string> of_points(mesh.names.points.begin(), mesh.names.points.end());
  sets.point_names = named(mesh.vertices.size(), &NamedVertices::vertices, [&](std::size_t v) { return ref_of(mesh.vertex_refs, v); }, of_points, names);
  return sets;
}

std::vector<std::int32_t> around(const Cell& cell) {
  const auto n = static_cast<std::size_t>(corner_count(cell.kind));
  std::vector<std::int32_t> nodes;
  for (std::size_t i = 0; i < n; ++i) {
    nodes.push_back(cell.nodes[i]);
    if (is_quadratic(cell.kind)) nodes.push_back(cell.nodes[n + i]);
  }
  return nodes;
}

void refuse_second_order(const FlatMesh& mesh, const std::string& format) {
  if (mesh.is_quadratic())
    throw InvalidArgument(format + " has no elements of order 2: write p1, q1.0 or q1.1, or another format");
}

}  // namespace carreau
