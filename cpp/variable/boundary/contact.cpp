// SPDX-License-Identifier: BSD-3-Clause
#include "variable/boundary/contact.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "predicates/polygon_locator.h"
#include "support/error.h"
#include "support/segment.h"
#include "support/short_number.h"
#include "variable/base/thresholds.h"

namespace carreau::variable {

namespace th = thresholds::variable;

std::int32_t BoundaryLoop::kind_of_edge(std::size_t i) const noexcept {
  if (edges[i].follows_tool) return Kind::bound + nodes[i].place.tool;
  return edges[i].imposed ? Kind::imposed : Kind::free_boundary;
}

std::int32_t BoundaryLoop::kind_of_node(std::size_t i) const noexcept {
  if (nodes[i].is_bound()) return Kind::bound + nodes[i].place.tool;
  return edges[i].imposed || edges[before(i)].imposed ? Kind::imposed : Kind::free_boundary;
}

void BoundaryLoop::remove(std::size_t i) {
  // The longer of the two edges defines the edge that replaces them.
  const std::size_t previous = before(i);
  if (length(i) > length(previous)) edges[previous].imposed = edges[i].imposed, edges[previous].bared = edges[i].bared;
  edges[previous].follows_tool = false;
  nodes.erase(nodes.begin() + static_cast<std::ptrdiff_t>(i));
  edges.erase(edges.begin() + static_cast<std::ptrdiff_t>(i));
}

std::vector<BoundaryLoop> boundary_of(const Eroded& eroded) {
  const Piece& piece = eroded.piece;
  struct Out {
    std::int32_t to = -1;
    bool imposed = false, bared = false;
  };
  std::vector<Out> out(piece.vertices.size());
  for (std::size_t t = 0; t < piece.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (eroded.adjacency[t][k] < 0)
        out[static_cast<std::size_t>(piece.triangles[t][k])] = {piece.triangles[t][(k + 1) % 3],
                                                                eroded.bared[t][k] || eroded.imposed[t][k], eroded.bared[t][k]};
  std::vector<BoundaryLoop> loops;
  for (std::size_t first = 0; first < out.size(); ++first) {
    if (out[first].to < 0) continue;
    BoundaryLoop& loop = loops.emplace_back();
    for (auto v = static_cast<std::int32_t>(first); out[static_cast<std::size_t>(v)].to >= 0;) {
      Out& next = out[static_cast<std::size_t>(v)];
      BoundaryNode node;
      node.point = piece.vertices[static_cast<std::size_t>(v)], node.vertex = v, node.on = {v, v};
      loop.nodes.push_back(node);
      loop.edges.push_back({.imposed = next.imposed, .bared = next.bared});
      v = next.to;
      next.to = -1;
    }
  }
  return loops;
}

namespace {

std::string at(const Vec2& p) { return "(" + short_number(p.x()) + ", " + short_number(p.y()) + ")"; }

void bind_nodes(std::vector<BoundaryLoop>& loops, const Tools& tools, const ContactDistances& distances) {
  for (BoundaryLoop& loop : loops)
    for (BoundaryNode& node : loop.nodes) {
      const ToolPlace place = tools.nearest(node.point);
      if (place.distance <= (place.in_solid ? distances.step : distances.reach)) {
        node.place = place, node.point = place.point;
      } else if (place.in_solid) {
        throw InvalidArgument("a vertex of the piece at " + at(node.point) + " lies " + short_number(place.distance) +
                              " deep in tool " + std::to_string(place.tool) + " (from 0), more than a step of " +
                              short_number(distances.step));
      }
    }
}

/// The edges of the boundary in a tree.
class EdgeTree {
 public:
  explicit EdgeTree(const std::vector<BoundaryLoop>& loops) {
    std::vector<BoxTree::Box> boxes;
    std::vector<Vec3> centres;
    for (std::size_t l = 0; l < loops.size(); ++l)
      for (std::size_t i = 0; i < loops[l].size(); ++i) {
        const Vec2 a = loops[l].nodes[i].point, b = loops[l].nodes[loops[l].after(i)].point;
        edges_.push_back({l, i, a, b});
        BoxTree::Box box;
        box.add(Vec3{a.x(), a.y(), 0}), box.add(Vec3{b.x(), b.y(), 0});
        boxes.push_back(box);
        centres.emplace_back((box.low + box.high) / 2);
      }
    tree_ = BoxTree(boxes, centres);
  }
  struct Edge {
    std::size_t loop, edge;
    Vec2 a, b;
  };
  struct Found {
    const Edge* edge = nullptr;
    double squared = infinity;
  };
  [[nodiscard]] Found nearest(const Vec2& p) const {
    Found best;
    const Vec3 q{p.x(), p.y(), 0};
    tree_.nearest_first([&](std::size_t n) { return tree_.node(n).box.squared_distance(q); },
                        [&](double bound) { return bound <= best.squared; },
                        [&](const BoxTree::Node& leaf) {
                          for (const std::int32_t i : tree_.things(leaf)) {
                            const Edge& e = edges_[static_cast<std::size_t>(i)];
                            const double found = squared_distance_to_segment(p, e.a, e.b);
                            if (found < best.squared || (found == best.squared && &e < best.edge)) best = {&e, found};
                          }
                        });
    return best;
  }
  [[nodiscard]] const BoxTree::Box& box() const { return tree_.node(0).box; }
  [[nodiscard]] PolygonLocator locator() const {
    std::vector<Vec2> ends;
    std::vector<std::pair<int, int>> pairs;
    for (const Edge& e : edges_) {
      pairs.emplace_back(static_cast<int>(ends.size()), static_cast<int>(ends.size()) + 1);
      ends.push_back(e.a), ends.push_back(e.b);
    }
    return {ends, pairs};
  }

 private:
  std::vector<Edge> edges_;
  BoxTree tree_;
};

struct Insertion {
  std::size_t loop, edge;
  double fraction;
  ToolPlace place;
};

/// Nodes of tools that lie in a region of an edge.
std::vector<Insertion> nodes_to_insert(const std::vector<BoundaryLoop>& loops, const Tools& tools,
                                       const ContactDistances& distances) {
  const double step = distances.step;
  const EdgeTree tree(loops);
  const PolygonLocator locator = tree.locator();
  std::vector<Insertion> insertions;
  for (const ToolPlace& node : tools.nodes()) {
    const Vec2& p = node.point;
    if (tree.box().squared_distance(Vec3{p.x(), p.y(), 0}) > step * step) continue;
    const auto found = tree.nearest(p);
    const BoundaryLoop& loop = loops[found.edge->loop];
    const BoundaryNode &a = loop.nodes[found.edge->edge], &b = loop.nodes[loop.after(found.edge->edge)];
    if (a.place.tool == node.tool && b.place.tool == node.tool) continue;  // the edge will follow the tool
    const bool is_deep = locator.contains(p);
    const double most = is_deep ? step : distances.reach;
    if (found.squared <= most * most)
      insertions.push_back(
          {found.edge->loop, found.edge->edge, fraction_on_segment(p, found.edge->a, found.edge->b), node});
    else if (is_deep)
      throw InvalidArgument("tool " + std::to_string(node.tool) + " (from 0) reaches " +
                            short_number(std::sqrt(found.squared)) + " deep into the piece at " + at(p) +
                            ", more than a step of " + short_number(step));
  }
  std::sort(insertions.begin(), insertions.end(), [](const Insertion& p, const Insertion& q) {
    if (p.loop != q.loop) return p.loop < q.loop;
    if (p.edge != q.edge) return p.edge < q.edge;
    if (p.fraction != q.fraction) return p.fraction < q.fraction;
    return p.place.part < q.place.part;
  });
  return insertions;
}

/// A free node of the piece that is near moves to the tool's node; otherwise the tool's node becomes a separate node.
void insert_nodes(BoundaryLoop& loop, std::size_t edge, std::span<const Insertion> insertions, double h_min) {
  BoundaryNode &a = loop.nodes[edge], &b = loop.nodes[loop.after(edge)];
  const std::array<std::int32_t, 2> on{a.on[0], b.on[1]};
  std::vector<BoundaryNode> added;
  for (const Insertion& insertion : insertions) {
    const ToolPlace& place = insertion.place;
    const auto is_near = [&](const BoundaryNode& n) { return norm(n.point - place.point) <= th::takes_along * h_min; };
    if (is_near(a) || is_near(b)) {
      BoundaryNode& n = is_near(a) ? a : b;
      if (!n.is_bound()) n.place = place, n.point = place.point;
    } else if (added.empty() || !is_near(added.back())) {
      BoundaryNode node;
      node.point = place.point, node.on = on, node.place = place;
      added.push_back(node);
    }
  }
  const auto where = static_cast<std::ptrdiff_t>(edge) + 1;
  loop.edges.insert(loop.edges.begin() + where, added.size(), loop.edges[edge]);
  loop.nodes.insert(loop.nodes.begin() + where, added.begin(), added.end());
}

void insert_all(std::vector<BoundaryLoop>& loops, const std::vector<Insertion>& insertions, double h_min) {
  // From the last edge of a loop to its first, so that ranks stay.
  for (std::size_t end = insertions.size(); end > 0;) {
    std::size_t first = end - 1;
    while (first > 0 && insertions[first - 1].loop == insertions[end - 1].loop &&
           insertions[first - 1].edge == insertions[end - 1].edge)
      --first;
    insert_nodes(loops[insertions[first].loop], insertions[first].edge,
                 std::span(insertions).subspan(first, end - first), h_min);
    end = first;
  }
}

/// Nodes that fell together on a tool, or changed places there.
void drop_crowded(BoundaryLoop& loop, const Tools& tools, double h_min) {
  for (std::size_t i = 0; i < loop.size() && loop.size() > 3;) {
    const BoundaryNode &a = loop.nodes[i], &b = loop.nodes[loop.after(i)];
    const bool crowded = a.is_bound() && a.place.tool == b.place.tool &&
                         (norm(b.point - a.point) <= th::crowded * h_min ||
                          (norm(b.point - a.point) <= h_min && tools.way_back(a.place.tool, a.place.s, b.place.s) < 0));
    if (crowded)
      loop.remove(loop.after(i));
    else
      ++i;
  }
}

}  // namespace

void follow_tools(BoundaryLoop& loop, const Tools& tools, double h_min) {
  drop_crowded(loop, tools, h_min);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const BoundaryNode &a = loop.nodes[i], &b = loop.nodes[loop.after(i)];
    BoundaryLoop::Edge& edge = loop.edges[i];
    edge.follows_tool = false;
    if (!a.is_bound() || a.place.tool != b.place.tool) continue;
    const double way = tools.way_back(a.place.tool, a.place.s, b.place.s), chord = norm(b.point - a.point);
    if (way <= 0 || way > th::longest_path * chord) continue;
    if (way > th::straight_path * chord && !tools.nearest((a.point + b.point) / 2).in_solid) continue;
    edge.follows_tool = true, edge.way = way;
  }
}

void bind_to_tools(std::vector<BoundaryLoop>& loops, const Tools& tools, ContactDistances distances, double h_min) {
  if (tools.empty()) return;
  bind_nodes(loops, tools, distances);
  insert_all(loops, nodes_to_insert(loops, tools, distances), h_min);
  for (BoundaryLoop& loop : loops) follow_tools(loop, tools, h_min);
}

}  // namespace carreau::variable
