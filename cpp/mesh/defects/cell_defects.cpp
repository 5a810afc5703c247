// SPDX-License-Identifier: BSD-3-Clause
// Defects of elements other than straight triangles.
#include <algorithm>
#include <map>

#include "mesh/defects/cell_defects.h"
#include "mesh/elements/cell_quality.h"
#include "mesh/elements/jacobian.h"
#include "predicates/predicates.h"

namespace carreau {

namespace {

using Key = std::array<std::int32_t, 2>;
Key ordered(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

class CellDefects {
 public:
  explicit CellDefects(const SurfaceMesh& mesh) : mesh_(mesh) {}

  std::vector<std::string> run() {
    for (const FaceMesh& face : mesh_.faces) check_lists(face);
    check_curves();
    if (!defects_.empty()) return std::move(defects_);  // the checks below need sound indices
    used_.assign(mesh_.mid_vertices.size(), 0);
    for (const FaceMesh& face : mesh_.faces) check_face(face);
    for (const CurveMesh& curve : mesh_.curves)
      for (std::size_t k = 0; curve.loose && k < curve.mid.size(); ++k)
        used_[static_cast<std::size_t>(curve.mid[k])] = 1;
    for (std::size_t v = 0; v < used_.size(); ++v)
      if (used_[v] == 0) add("node " + std::to_string(v) + " of the edges: belongs to no element");
    return std::move(defects_);
  }

 private:
  void add(const std::string& sentence) { defects_.push_back(sentence); }
  static std::string name(const FaceMesh& face) { return "face " + std::to_string(face.shown_ref()) + ": "; }

  void check_lists(const FaceMesh& face) {
    if (face.quads < 0 || 2 * static_cast<std::size_t>(face.quads) > face.triangles.size()) {
      add(name(face) + std::to_string(face.quads) + " quadrilaterals are more than the triangles can be halves of");
      return;
    }
    for (std::size_t k = 0; k < static_cast<std::size_t>(face.quads); ++k)
      if (face.triangles[2 * k][0] != face.triangles[2 * k + 1][0] ||
          face.triangles[2 * k][2] != face.triangles[2 * k + 1][1])
        add(name(face) + "triangles " + std::to_string(2 * k) + " and " + std::to_string(2 * k + 1) +
            " are not the halves of one quadrilateral");
    if (face.mid.empty()) {
      if (!mesh_.mid_vertices.empty() && !face.triangles.empty()) add(name(face) + "no nodes on the edges");
      return;
    }
    if (face.mid.size() != face.triangles.size() || face.mid_uv.size() != face.mid_vertex.size())
      return add(name(face) + "lists of nodes on edges differ in length");
    for (std::size_t t = 0; t < face.mid.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) check_index(face, t, i);
    for (const std::int32_t v : face.mid_vertex)
      if (v < 0 || static_cast<std::size_t>(v) >= mesh_.mid_vertices.size())
        add(name(face) + "a node on an edge has no place in space");
  }

  void check_index(const FaceMesh& face, std::size_t t, std::size_t i) {
    const bool diagonal = t < 2 * static_cast<std::size_t>(face.quads) && i == (t % 2 == 0 ? 2U : 0U);
    const std::int32_t m = face.mid[t][i];
    if (diagonal ? m != -1 : m < 0 || static_cast<std::size_t>(m) >= face.mid_uv.size())
      add(name(face) + "triangle " + std::to_string(t) + " has a node on side " + std::to_string(i) +
          " that cannot be");
  }

  void check_curves() {
    for (const CurveMesh& curve : mesh_.curves) {
      if (curve.mid.empty()) continue;
      const std::string of = "curve of reference " + std::to_string(curve.ref) + ": ";
      if (curve.mid.size() + 1 != curve.vertices.size()) {
        add(of + "nodes and edges differ in number");
        continue;
      }
      for (std::size_t k = 0; k < curve.mid.size(); ++k) {
        const std::int32_t v = curve.mid[k];
        if (v < 0 || static_cast<std::size_t>(v) >= mesh_.mid_vertices.size())
          add(of + "a node that does not exist");
        else
          of_edge_.emplace(ordered(curve.vertices[k], curve.vertices[k + 1]), v);
      }
    }
  }

  void check_face(const FaceMesh& face) {
    const std::vector<Cell> cells = local_cells(face);
    const auto quads = static_cast<std::size_t>(face.quads);
    for (std::size_t c = 0; c < cells.size(); ++c) {
      check_jacobian(face, cells[c], c, !face.is_spread(c < quads ? 2 * c : c + quads));
      if (is_quadratic(cells[c].kind)) check_sides(face, cells[c]);
    }
  }

  // An edge has one node, whatever the number of faces that hold it.
  void check_sides(const FaceMesh& face, const Cell& cell) {
    const int n = corner_count(cell.kind);
    const auto corners = static_cast<std::int32_t>(face.uv.size());
    for (int i = 0; i < n; ++i) {
      const std::int32_t mid = face.mid_vertex[cell.nodes[n + i] - corners];
      used_[mid] = 1;
      const Key key = ordered(face.vertex[cell.nodes[i]], face.vertex[cell.nodes[(i + 1) % n]]);
      if (of_edge_.emplace(key, mid).first->second != mid)
        add(name(face) + "edge " + std::to_string(key[0]) + " - " + std::to_string(key[1]) + " has two nodes");
    }
  }

  // Ignores (u, v) of faces that are partly turned over (FaceMesh::triangles) or of several charts.
  void check_jacobian(const FaceMesh& face, const Cell& cell, std::size_t c, bool in_plane) {
    if (cell.kind == CellKind::triangle3) return;
    const auto n = static_cast<std::size_t>(node_count(cell.kind));
    const auto corners = static_cast<std::int32_t>(face.uv.size());
    std::array<Vec3, 8> plane, space;
    for (std::size_t i = 0; i < n; ++i) {
      const std::int32_t node = cell.nodes[i];
      const Vec2& p = node < corners ? face.uv[node] : face.mid_uv[node - corners];
      plane[i] = {p.x(), p.y(), 0};
      space[i] = node < corners ? mesh_.vertices[face.vertex[node]]
                                : mesh_.mid_vertices[face.mid_vertex[node - corners]];
    }
    const std::string what = name(face) + "element " + std::to_string(c) + " has a Jacobian that is not positive in ";
    const auto in = [&](const std::array<Vec3, 8>& nodes) { return jacobian(cell.kind, {nodes.data(), n}); };
    if (in_plane && !(in(plane).min_along({0, 0, 1}) > 0)) add(what + "(u, v)");
    if (!(in(space).least() > 0)) add(what + "space");
  }

  const SurfaceMesh& mesh_;
  std::map<Key, std::int32_t> of_edge_;  // node of each edge met so far
  std::vector<char> used_;
  std::vector<std::string> defects_;
};

}  // namespace

std::vector<std::string> find_cell_defects(const SurfaceMesh& mesh) { return CellDefects(mesh).run(); }

std::vector<std::string> find_cell_defects(const FlatMesh& mesh) {
  std::vector<std::string> defects;
  if (mesh.cells.empty()) return defects;
  std::size_t triangles = 0;
  for (const Cell& cell : mesh.cells) triangles += corner_count(cell.kind) == 4 ? 2 : 1;
  if (triangles != mesh.triangles.size()) defects.emplace_back("elements and triangles are not the same surface");
  const auto missing = [&](std::int32_t v) { return v < 0 || static_cast<std::size_t>(v) >= mesh.vertices.size(); };
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (std::any_of(mesh.cells[c].nodes.begin(), mesh.cells[c].nodes.begin() + node_count(mesh.cells[c].kind), missing))
      defects.push_back("element " + std::to_string(c) + ": it names a vertex that does not exist");
  if (!mesh.edge_mids.empty() && mesh.edge_mids.size() != mesh.edges.size())
    defects.emplace_back("edges and nodes on them differ in number");
  if (!defects.empty()) return defects;
  for_cells(mesh, [&](std::size_t c, const Cell& cell, std::span<const Vec3> nodes, std::size_t) {
    if (!(jacobian(cell.kind, nodes).least() > 0))
      defects.push_back("element " + std::to_string(c) + ": its Jacobian is not positive everywhere");
  });
  return defects;
}

}  // namespace carreau
