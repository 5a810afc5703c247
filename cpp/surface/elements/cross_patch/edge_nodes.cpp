// SPDX-License-Identifier: BSD-3-Clause
#include "surface/elements/cross_patch/edge_nodes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "mesh/elements/jacobian.h"
#include "support/rounding_of.h"
#include "surface/elements/base/curve_middles.h"
#include "surface/elements/base/mender.h"

namespace carreau {

namespace {

/// A node between two local vertices, on a line or inside: then it is new, and free.
using Node = LineMiddle;

/// Nodes of all edges, by local vertices.
class NodeMaker {
 public:
  NodeMaker(const AtlasSurface& surface, const PlacedVertices& vertices, LineMiddles& lines, const ElementCells& cells,
            Monitor& monitor)
      : surface_(surface), vertices_(vertices), lines_(lines), cells_(cells), monitor_(monitor) {}

  void run() {
    std::size_t count = 0;
    for (const MixedCell& cell : cells_.quads.cells()) {
      if (count++ % 64 == 0) monitor_.checkpoint();
      SpaceCell& sides = of_cell.emplace_back(SpaceCell{-1, -1, -1, -1});
      for (int k = 0, n = corners_of(cell); k < n; ++k) sides[k] = node_between(cell[k], cell[(k + 1) % n]);
    }
  }

  std::vector<Node> nodes;
  std::vector<SpaceCell> of_cell;  // indices in nodes

 private:
  std::int32_t node_between(std::int32_t a, std::int32_t b) {
    const auto [found, is_new] = of_edge_.try_emplace(mesh_edge(a, b), static_cast<std::int32_t>(nodes.size()));
    if (!is_new) return found->second;
    const MeshEdge ends = mesh_edge(a, b);
    nodes.push_back(is_imposed(cells_, lines_, a, b) ? middle_on_line(vertices_, lines_, cells_, ends) : inside(ends));
    return found->second;
  }

  [[nodiscard]] double size_along(std::int32_t v, const Vec3& way) const {
    const WantedSize& wanted = cells_.quads.wanted(v);
    if (!surface_.by_direction()) return wanted.h;
    const double l = length(wanted.metric, way);
    return l > 0 ? norm(way) / l : wanted.h;
  }

  [[nodiscard]] Node inside(const MeshEdge& ends) const {
    const Vec3 p = cells_.quads.place(ends[0]).xyz, q = cells_.quads.place(ends[1]).xyz, way = q - p;
    const double at_a = size_along(ends[0], way), at_b = size_along(ends[1], way);
    const Vec3 target = lerp(p, q, metric_middle(1 / at_a, 2 / (at_a + at_b), 1 / at_b));
    return {place_from(surface_, cells_.quads, ends, target), -1};
  }

  const AtlasSurface& surface_;
  const PlacedVertices& vertices_;
  LineMiddles& lines_;
  const ElementCells& cells_;
  Monitor& monitor_;
  std::map<MeshEdge, std::int32_t> of_edge_;
};

/// A node of an element with a place to test.
struct TriedNode {
  std::int32_t node;
  SurfacePlace place;
};

/// Nodes are local vertices, then the nodes of edges.
class SpaceMender : public Mender<SpaceMender, Vec3> {
 public:
  SpaceMender(const AtlasSurface& surface, ElementCells& cells, NodeMaker& made, Monitor& monitor)
      : Mender(elements(cells, made), static_cast<std::int32_t>(cells.quads.vertices()),
               static_cast<std::int32_t>(cells.quads.vertices() + made.nodes.size()), fixed_nodes(cells, made), monitor),
        surface_(surface),
        cells_(cells),
        nodes_(made.nodes) {}

  [[nodiscard]] double score(const Cell& cell) const {
    const Jacobian found = jacobian_of(cell);
    const Vec3 normal = normal_of(cell);
    return dot(normal, normal) > 0 && !(dot(found.mean(), normal) > 0) ? -1 : found.least();
  }
  // Divides by the mean: an element on the wrong side of the surface may still be repaired.
  [[nodiscard]] double score_at(const Cell& cell, int corner) const {
    const Jacobian found = jacobian_of(cell);
    const Vec3 mean = found.mean();
    if (!(dot(mean, normal_of(cell)) > 0)) return 1;
    return dot(found.c[coefficient_at(cell.kind, corner)], mean) / dot(mean, mean);
  }

  [[nodiscard]] std::array<double, 2> orientations(const Cell& cell) const {
    const std::array<std::int32_t, 8>& n = cell.nodes;
    const double first = orientation(n[0], n[1], n[2]);
    return {first, corner_count(cell.kind) == 4 ? orientation(n[0], n[2], n[3]) : first};
  }

  [[nodiscard]] std::array<Vec3, 8> ways(std::int32_t node, double step) const {
    const SurfacePlace& at = place(node);
    const double by =
        step * reach(node, [&](std::int32_t a, std::int32_t b) { return norm(place(b).xyz - place(a).xyz); });
    const SpaceQuads::Frame frame = SpaceQuads::plane_at(at);
    std::array<Vec3, 8> all;
    for (int k = 0; k < 8; ++k) {
      const double angle = k * (std::numbers::pi / 4);
      all[k] = by * (std::cos(angle) * frame.e1 + std::sin(angle) * frame.e2);
    }
    return all;
  }

  [[nodiscard]] std::vector<TriedNode> places(const std::vector<std::pair<std::int32_t, Vec3>>& moves) const {
    std::vector<TriedNode> trials;
    for (const auto& [node, by] : moves) {
      const SurfacePlace& from = place(node);
      if (!from.regular) return {};
      const std::optional<SurfacePlace> there = surface_.towards(from, from.xyz + by);
      if (!there) return {};
      trials.push_back({node, *there});
    }
    return trials;
  }

  [[nodiscard]] TriedNode trial_of(std::int32_t node) const { return {node, place(node)}; }
  void put(const TriedNode& trial) {
    if (trial.node < corners())
      cells_.quads.put(trial.node, trial.place);
    else
      nodes_[trial.node - corners()].place = trial.place;
  }

 private:
  static std::vector<Cell> elements(const ElementCells& cells, const NodeMaker& made) {
    std::vector<Cell> all;
    const auto first = static_cast<std::int32_t>(cells.quads.vertices());
    const bool curved = !made.of_cell.empty();
    for (std::size_t c = 0; c < cells.quads.cells().size(); ++c) {
      const MixedCell& corners = cells.quads.cells()[c];
      const int n = corners_of(corners);
      Cell& cell = all.emplace_back();
      if (curved)
        cell.kind = n == 4 ? CellKind::quad8 : CellKind::triangle6;
      else
        cell.kind = n == 4 ? CellKind::quad4 : CellKind::triangle3;
      for (int k = 0; k < n; ++k) {
        cell.nodes[k] = corners[k];
        if (curved) cell.nodes[n + k] = first + made.of_cell[c][k];
      }
    }
    return all;
  }
  static std::vector<char> fixed_nodes(const ElementCells& cells, const NodeMaker& made) {
    std::vector<char> fixed;
    for (std::size_t v = 0; v < cells.quads.vertices(); ++v) fixed.push_back(static_cast<char>(cells.quads.is_fixed(v)));
    for (const Node& node : made.nodes) fixed.push_back(static_cast<char>(node.vertex >= 0));
    return fixed;
  }

  [[nodiscard]] Jacobian jacobian_of(const Cell& cell) const {
    const auto all = static_cast<std::size_t>(node_count(cell.kind));
    std::array<Vec3, 8> xyz;
    for (std::size_t i = 0; i < all; ++i) xyz[i] = place(cell.nodes[i]).xyz;
    return jacobian(cell.kind, {xyz.data(), all});
  }
  [[nodiscard]] Vec3 normal_of(const Cell& cell) const {
    Vec3 normal{0, 0, 0};
    for (int i = 0; i < corner_count(cell.kind); ++i) normal += place(cell.nodes[i]).normal;
    return normal;
  }
  [[nodiscard]] const SurfacePlace& place(std::int32_t node) const {
    return node < corners() ? cells_.quads.place(node) : nodes_[node - corners()].place;
  }
  // Orientation of a straight triangle, by the normals of its corners.
  [[nodiscard]] double orientation(std::int32_t a, std::int32_t b, std::int32_t c) const {
    const SurfacePlace &p = place(a), &q = place(b), &r = place(c);
    return dot(cross(q.xyz - p.xyz, r.xyz - p.xyz), p.normal + q.normal + r.normal);
  }

  const AtlasSurface& surface_;
  ElementCells& cells_;
  std::vector<Node>& nodes_;
};

}  // namespace

void mend_straight(const AtlasSurface& surface, const PlacedVertices& vertices, LineMiddles& lines, ElementCells& cells,
                   Monitor& monitor) {
  NodeMaker none(surface, vertices, lines, cells, monitor);
  SpaceMender mender(surface, cells, none, monitor);
  (void)mender.find_below(thresholds::elements::good_jacobian);
  mender.mend();
}

EdgeNodes make_nodes(const AtlasSurface& surface, PlacedVertices& vertices, LineMiddles& lines, ElementCells& cells,
                     Monitor& monitor) {
  NodeMaker maker(surface, vertices, lines, cells, monitor);
  maker.run();
  EdgeNodes made;
  {
    SpaceMender mender(surface, cells, maker, monitor);
    (void)mender.find_below(thresholds::elements::good_jacobian);
    mender.mend();
    made.moved = mender.moves();
    (void)mender.find_below(rounding_of::sizes);
    made.invalid = mender.bad();
  }
  std::vector<std::int32_t> vertex;
  for (const Node& node : maker.nodes)
    vertex.push_back(node.vertex >= 0 ? node.vertex : vertices.add(node.place, surface.wanted(node.place)));
  made.of_cell = std::move(maker.of_cell);
  for (SpaceCell& nodes : made.of_cell)
    for (std::int32_t& node : nodes)
      if (node >= 0) node = vertex[node];
  return made;
}

}  // namespace carreau
