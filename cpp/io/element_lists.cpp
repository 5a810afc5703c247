// SPDX-License-Identifier: BSD-3-Clause
#include "io/element_lists.h"

#include <algorithm>
#include <map>
#include <utility>

#include "mesh/quality.h"
#include "support/error.h"

namespace carreau {

namespace {

template <std::size_t N>
void add(const std::array<std::int32_t, 8>& nodes, std::int32_t ref, ElementList<N>& list) {
  std::array<std::int32_t, N> own;
  std::copy_n(nodes.begin(), N, own.begin());
  list.nodes.push_back(own);
  list.refs.push_back(ref);
}

template <std::size_t N>
void add_all(const ElementList<N>& list, CellKind kind, FlatMesh& mesh) {
  for (std::size_t i = 0; i < list.nodes.size(); ++i) {
    Cell cell;
    cell.kind = kind;
    std::ranges::copy(list.nodes[i], cell.nodes.begin());
    add_cell(mesh, cell, list.refs[i]);
  }
}

double worse_half(const FlatMesh& mesh, const std::array<std::int32_t, 8>& n) {
  const auto at = [&](std::size_t i) -> const Vec3& { return mesh.vertices[n[i]]; };
  return std::min(quality_q2(at(0), at(1), at(2)), quality_q2(at(0), at(2), at(3)));
}

std::array<std::int32_t, 8> turned_once(std::array<std::int32_t, 8> n) {
  std::rotate(n.begin(), n.begin() + 1, n.begin() + 4);
  std::rotate(n.begin() + 4, n.begin() + 5, n.end());
  return n;
}

std::array<std::int32_t, 3> half_of(const std::array<std::int32_t, 8>& n, std::size_t i, std::size_t j, std::size_t k) {
  std::array<std::int32_t, 3> corners{n[i], n[j], n[k]};
  std::ranges::sort(corners);
  return corners;
}

bool has_four_corners(const Cell& cell) {
  const std::array<std::int32_t, 8>& n = cell.nodes;
  return corner_count(cell.kind) == 4 && n[0] != n[1] && n[1] != n[2] && n[2] != n[3] && n[3] != n[0] && n[0] != n[2] &&
         n[1] != n[3];
}

/// Turns quadrilaterals whose halves are triangles of other elements. The result does not depend on the corner that a
/// quadrilateral begins with: a mesh that is written and read again does not change.
class EqualHalves {
 public:
  explicit EqualHalves(FlatMesh& mesh) : mesh_(mesh) {}

  void part() {
    find_candidates();
    if (candidates_.empty()) return;
    for (const std::size_t c : candidates_) set_canonical(mesh_.cells[c].nodes);
    for (const Cell& cell : mesh_.cells) count(cell, 1);
    // The first of several elements keeps its diagonal.
    for (auto c = candidates_.rbegin(); c != candidates_.rend(); ++c) turn_if_better(mesh_.cells[*c]);
    for (std::size_t c = 0, t = 0, k = 0; c < mesh_.cells.size() && k < candidates_.size(); ++c) {
      const std::array<std::int32_t, 8>& n = mesh_.cells[c].nodes;
      if (c == candidates_[k])
        mesh_.triangles[t] = {n[0], n[1], n[2]}, mesh_.triangles[t + 1] = {n[0], n[2], n[3]}, ++k;
      t += corner_count(mesh_.cells[c].kind) == 4 ? 2 : 1;
    }
  }

 private:
  using Half = std::array<std::int32_t, 3>;

  // Quadrilaterals that share three corners with another element, whatever their diagonals.
  void find_candidates() {
    std::vector<std::pair<Half, std::int32_t>> halves;
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      const std::array<std::int32_t, 8>& n = mesh_.cells[c].nodes;
      const auto add_half = [&](std::size_t i, std::size_t j, std::size_t k) {
        halves.emplace_back(half_of(n, i, j, k), static_cast<std::int32_t>(c));
      };
      add_half(0, 1, 2);
      if (corner_count(mesh_.cells[c].kind) == 4) add_half(0, 2, 3), add_half(1, 2, 3), add_half(3, 0, 1);
    }
    std::ranges::sort(halves);
    for (std::size_t i = 1; i < halves.size(); ++i)
      if (halves[i].first == halves[i - 1].first && halves[i].second != halves[i - 1].second)
        for (const std::size_t k : {i - 1, i})
          if (const auto c = static_cast<std::size_t>(halves[k].second); has_four_corners(mesh_.cells[c]))
            candidates_.push_back(c);
    std::ranges::sort(candidates_);
    candidates_.erase(std::unique(candidates_.begin(), candidates_.end()), candidates_.end());
  }

  // The better diagonal, from its lower end; if both are equally good, the diagonal with the lowest end.
  void set_canonical(std::array<std::int32_t, 8>& n) const {
    while (n[0] != std::min({n[0], n[1], n[2], n[3]})) n = turned_once(n);
    if (worse_half(mesh_, turned_once(n)) > worse_half(mesh_, n)) turn(n);
  }

  static void turn(std::array<std::int32_t, 8>& n) {
    n = turned_once(n);
    if (n[2] < n[0]) n = turned_once(turned_once(n));
  }

  void count(const Cell& cell, int by) {
    count_[half_of(cell.nodes, 0, 1, 2)] += by;
    if (corner_count(cell.kind) == 4) count_[half_of(cell.nodes, 0, 2, 3)] += by;
  }

  [[nodiscard]] int others_like(const Cell& cell) {
    return count_[half_of(cell.nodes, 0, 1, 2)] + count_[half_of(cell.nodes, 0, 2, 3)];
  }

  void turn_if_better(Cell& cell) {
    count(cell, -1);
    Cell turned = cell;
    turn(turned.nodes);
    if (others_like(cell) > 0 && others_like(turned) == 0) cell = turned;
    count(cell, 1);
  }

  FlatMesh& mesh_;
  std::vector<std::size_t> candidates_;  // ascending
  std::map<Half, int> count_;
};

// The diagonal from corner 0 cuts a quadrilateral.
void turn_quads(FlatMesh& mesh, std::size_t first_cell, std::size_t first_triangle) {
  for (std::size_t c = first_cell, t = first_triangle; c < mesh.cells.size(); ++c) {
    std::array<std::int32_t, 8>& n = mesh.cells[c].nodes;
    if (corner_count(mesh.cells[c].kind) == 3) {
      ++t;
      continue;
    }
    const std::array<std::int32_t, 8> turned = turned_once(n);
    if (worse_half(mesh, turned) > worse_half(mesh, n)) n = turned;
    mesh.triangles[t++] = {n[0], n[1], n[2]};
    mesh.triangles[t++] = {n[0], n[2], n[3]};
  }
}

}  // namespace

ElementLists lists_of(const FlatMesh& mesh) {
  ElementLists lists;
  const auto ref = [&](std::size_t t) { return mesh.triangle_refs.empty() ? 0 : mesh.triangle_refs[t]; };
  std::size_t t = 0;
  for (const Cell& cell : mesh.cells) {
    if (cell.kind == CellKind::triangle3) add(cell.nodes, ref(t), lists.triangles);
    if (cell.kind == CellKind::triangle6) add(cell.nodes, ref(t), lists.triangles6);
    if (cell.kind == CellKind::quad4) add(cell.nodes, ref(t), lists.quads);
    if (cell.kind == CellKind::quad8) add(cell.nodes, ref(t), lists.quads8);
    t += corner_count(cell.kind) == 4 ? 2 : 1;
  }
  lists.edges.nodes.reserve(mesh.edges.size());
  lists.edges.refs.reserve(mesh.edges.size());
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    const auto [a, b] = mesh.edges[e];
    const std::int32_t edge_ref = mesh.edge_refs.empty() ? 0 : mesh.edge_refs[e];
    if (mesh.edge_mids.empty())
      lists.edges.nodes.push_back({a, b}), lists.edges.refs.push_back(edge_ref);
    else
      lists.edges3.nodes.push_back({a, b, mesh.edge_mids[e]}), lists.edges3.refs.push_back(edge_ref);
  }
  return lists;
}

Vec3 centre_of(const FlatMesh& mesh, const std::array<std::int32_t, 8>& n) noexcept {
  const auto at = [&](std::size_t i) -> const Vec3& { return mesh.vertices[n[i]]; };
  return 0.5 * (at(4) + at(5) + at(6) + at(7)) - 0.25 * (at(0) + at(1) + at(2) + at(3));
}

MeditElements::MeditElements(const FlatMesh& mesh)
    : lists(lists_of(mesh)),
      triangles(mesh.cells.empty() ? mesh.triangles : lists.triangles.nodes),
      triangle_refs(mesh.cells.empty() ? mesh.triangle_refs : lists.triangles.refs) {
  for (const std::array<std::int32_t, 8>& nodes : lists.quads8.nodes) {
    std::array<std::int32_t, 9> nine;
    std::ranges::copy(nodes, nine.begin());
    nine[8] = static_cast<std::int32_t>(mesh.vertices.size() + centres.size());
    quads9.nodes.push_back(nine);
    centres.push_back(centre_of(mesh, nodes));
  }
  quads9.refs = lists.quads8.refs;
}

void set_elements(const ElementLists& lists, FlatMesh& mesh) {
  const bool straight = !lists.triangles.nodes.empty() || !lists.quads.nodes.empty();
  const bool curved = !lists.triangles6.nodes.empty() || !lists.quads8.nodes.empty();
  if (straight && curved) throw InvalidArgument("elements of first and of second order are mixed");
  if (!curved && lists.quads.nodes.empty()) {
    mesh.triangles = lists.triangles.nodes, mesh.triangle_refs = lists.triangles.refs;
  } else {
    add_all(lists.quads8, CellKind::quad8, mesh);
    add_all(lists.triangles6, CellKind::triangle6, mesh);
    add_all(lists.quads, CellKind::quad4, mesh);
    add_all(lists.triangles, CellKind::triangle3, mesh);
    turn_quads(mesh, 0, 0);
    // Two quadrilaterals that meet in two edges, as at the apex of a cone, may have one triangle as their better halves.
    EqualHalves(mesh).part();
  }
  // If straight and curved edges are mixed, only the ends are kept.
  const bool with_mids = lists.edges.nodes.empty();
  mesh.edges = lists.edges.nodes, mesh.edge_refs = lists.edges.refs;
  for (std::size_t e = 0; e < lists.edges3.nodes.size(); ++e) {
    const auto [a, b, middle] = lists.edges3.nodes[e];
    mesh.edges.push_back({a, b});
    if (with_mids) mesh.edge_mids.push_back(middle);
    mesh.edge_refs.push_back(lists.edges3.refs[e]);
  }
}

namespace {

// Takes the vertices out that `gone` marks, and numbers the others again.
void remove_vertices(const std::vector<char>& gone, ElementLists& lists, FlatMesh& mesh) {
  std::vector<std::int32_t> rank(gone.size(), -1);
  std::int32_t next = 0;
  for (std::size_t v = 0; v < gone.size(); ++v) {
    if (gone[v] != 0) continue;
    rank[v] = next;
    mesh.vertices[static_cast<std::size_t>(next)] = Vec3(mesh.vertices[v]);
    mesh.vertex_refs[static_cast<std::size_t>(next++)] = mesh.vertex_refs[v];
  }
  mesh.vertices.resize(static_cast<std::size_t>(next)), mesh.vertex_refs.resize(static_cast<std::size_t>(next));
  const auto renumber = [&](auto& list) {
    for (auto& nodes : list.nodes)
      for (std::int32_t& v : nodes) v = rank[v];
  };
  renumber(lists.triangles), renumber(lists.triangles6), renumber(lists.quads), renumber(lists.quads8);
  renumber(lists.edges), renumber(lists.edges3);
  for (auto& nodes : mesh.tetrahedra)
    for (std::int32_t& v : nodes) v = rank[static_cast<std::size_t>(v)];
}

}  // namespace

void take_quads9(const std::vector<std::array<std::int32_t, 9>>& quads, const std::vector<std::int32_t>& refs,
                 ElementLists& lists, FlatMesh& mesh) {
  std::vector<char> gone(mesh.vertices.size(), 0);
  for (std::size_t i = 0; i < quads.size(); ++i) {
    std::array<std::int32_t, 8> nodes;
    std::copy_n(quads[i].begin(), 8, nodes.begin());
    gone[static_cast<std::size_t>(quads[i][8])] = 1;
    lists.quads8.nodes.push_back(nodes), lists.quads8.refs.push_back(refs[i]);
  }
  const auto keep = [&](const auto& list) {
    for (const auto& nodes : list.nodes)
      for (const std::int32_t v : nodes) gone[v] = 0;
  };
  keep(lists.triangles), keep(lists.triangles6), keep(lists.quads), keep(lists.quads8), keep(lists.edges);
  keep(lists.edges3);
  for (const auto& nodes : mesh.tetrahedra)
    for (const std::int32_t v : nodes) gone[static_cast<std::size_t>(v)] = 0;
  if (!quads.empty()) remove_vertices(gone, lists, mesh);
}

}  // namespace carreau
