// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane/plane_graph.h"

#include <algorithm>
#include <map>

#include "model/union_find.h"
#include "predicates/predicates.h"

namespace carreau {

namespace {

constexpr int unknown = -3;

bool comes_before(const Vec2& p, const Vec2& q) noexcept { return p.x() < q.x() || (p.x() == q.x() && p.y() < q.y()); }

/// Half-planes of directions: 0 above, 1 below. A turn by less than half a circle compares two directions of one
/// half-plane.
int half_plane(const Vec2& d) noexcept { return d.y() > 0 || (d.y() == 0 && d.x() > 0) ? 0 : 1; }

}  // namespace

PlaneGraph::PlaneGraph(const PlaneDomainInput& input, std::span<const PlaneArc> arcs) : arcs_(arcs) {
  collect(input);
  std::vector<std::pair<int, int>> pairs;
  for (const Edge& edge : edges_) pairs.emplace_back(edge.a, edge.b);
  if (!edges_.empty()) grid_.emplace(vertices_, pairs);
  trace_loops();
  nest_loops();
}

void PlaneGraph::collect(const PlaneDomainInput& input) {
  for (const PlanePoint& point : input.points) vertices_.push_back(point.xy);
  UnionFind joined(input.points.size());
  for (std::size_t i = 0; i < arcs_.size(); ++i) {
    const PlaneArc& arc = arcs_[i];
    joined.merge(arc.from, arc.to);
    int before = arc.from;
    for (std::size_t k = 1; k < arc.polyline.size(); ++k) {
      int here = arc.to;
      if (k + 1 < arc.polyline.size()) {
        here = static_cast<int>(vertices_.size());
        vertices_.push_back(arc.polyline[k]);
      }
      edges_.push_back({before, here, static_cast<int>(i)});
      before = here;
    }
  }
  std::map<std::size_t, int> rank;
  for (int i = 0; i < static_cast<int>(arcs_.size()); ++i) {
    const std::vector<Vec2>& line = arcs_[i].polyline;
    const auto [it, added] = rank.try_emplace(joined.find(arcs_[i].from), static_cast<int>(rank.size()));
    component_.push_back(it->second);
    if (added) leftmost_.push_back({line.front(), i, 0});
    for (std::size_t k = 0; k < line.size(); ++k)
      if (comes_before(line[k], leftmost_[it->second].at)) leftmost_[it->second] = {line[k], i, k};
  }
}

int PlaneGraph::end_of(int half_edge) const noexcept {
  return (half_edge & 1) == 0 ? arcs_[half_edge / 2].to : arcs_[half_edge / 2].from;
}

Vec2 PlaneGraph::direction(int half_edge) const noexcept {
  const std::vector<Vec2>& line = arcs_[half_edge / 2].polyline;
  return (half_edge & 1) == 0 ? Vec2(line[1] - line[0]) : Vec2(line[line.size() - 2] - line.back());
}

// The next half-edge around the face on the left of a half-edge is the next one clockwise at its end.
void PlaneGraph::trace_loops() {
  const int n = 2 * static_cast<int>(arcs_.size());
  std::map<int, std::vector<int>> leaving;
  for (int h = 0; h < n; ++h) leaving[end_of(h ^ 1)].push_back(h);
  next_.assign(n, unknown);
  for (auto& [point, around] : leaving) {
    std::sort(around.begin(), around.end(), [&, at = vertices_[point]](int g, int h) {
      const Vec2 d = direction(g), e = direction(h);
      const int left = half_plane(d), right = half_plane(e);
      if (left != right) return left < right;
      const int turn = orientation(at, Vec2(at + d), Vec2(at + e));
      return turn != 0 ? turn > 0 : g < h;
    });
    for (std::size_t i = 0; i < around.size(); ++i) next_[around[(i + 1) % around.size()] ^ 1] = around[i];
  }
  find_outsides(leaving);
  loop_.assign(n, unknown);
  for (int h = 0; h < n; ++h) {
    if (loop_[h] != unknown) continue;
    for (int g = h; loop_[g] == unknown; g = next_[g]) loop_[g] = static_cast<int>(first_of_loop_.size());
    first_of_loop_.push_back(h);
  }
}

// The region west of the leftmost vertex of a component is outside of it.
void PlaneGraph::find_outsides(const std::map<int, std::vector<int>>& leaving) {
  for (const Leftmost& left : leftmost_) {
    const std::vector<Vec2>& line = arcs_[left.arc].polyline;
    if (left.rank > 0 && left.rank + 1 < line.size()) {
      const bool turns_left = orientation(line[left.rank - 1], line[left.rank], line[left.rank + 1]) > 0;
      outside_.push_back(2 * left.arc + (turns_left ? 1 : 0));
      continue;
    }
    // All directions point east of it, counterclockwise from the east: the last direction that points up, or the last
    // one.
    const std::vector<int>& around = leaving.at(left.rank == 0 ? arcs_[left.arc].from : arcs_[left.arc].to);
    int last = around.back();
    for (const int h : around)
      if (half_plane(direction(h)) == 0) last = h;
    outside_.push_back(last);
  }
}

// Straight down from p the first edge of another component than `skipped`; -1: none. The ray passes an infinitely
// small distance to the right of p, so that it meets no vertex.
int PlaneGraph::edge_below(const Vec2& p, int skipped, bool& on_it) const {
  on_it = false;
  if (!grid_) return -1;
  int found = -1;
  const auto ends = [&](int e) {
    const Vec2 &a = vertices_[edges_[e].a], &b = vertices_[edges_[e].b];
    return comes_before(a, b) ? std::pair{a, b} : std::pair{b, a};
  };
  const auto is_above = [&](int e, int f) {  // both are below p, and do not cross
    const auto [a, b] = ends(e);
    const auto [c, d] = ends(f);
    const bool later = c.x() < a.x();
    int side = later ? orientation(c, d, a) : -orientation(a, b, c);
    if (side == 0) side = later ? orientation(c, d, b) : -orientation(a, b, d);
    return side > 0;
  };
  const int column = grid_->column_of(p.x());
  for (int row = grid_->row_of(p.y()); row >= 0; --row) {
    for (const int e : grid_->edges_in(column, row)) {
      const auto [low, high] = ends(e);
      if (skipped >= 0 && component_[edges_[e].arc] == skipped) continue;
      if (p.x() < low.x() || p.x() > high.x()) continue;
      const int side = orientation(low, high, p);
      if (side == 0 && p.y() >= std::min(low.y(), high.y()) && p.y() <= std::max(low.y(), high.y()))
        return on_it = true, e;
      if (p.x() < high.x() && side > 0 && e != found && (found < 0 || is_above(e, found))) found = e;
    }
    if (found < 0) continue;
    // Edges of the rows below are lower where they pass under p, unless this one dips out of its row there.
    const auto [low, high] = ends(found);
    const double y = low.y() + (high.y() - low.y()) * ((p.x() - low.x()) / (high.x() - low.x()));
    if (y > grid_->y(row)) break;
  }
  return found;
}

int PlaneGraph::half_edge_above(int edge) const noexcept {
  const Edge& e = edges_[edge];
  const bool runs_right = vertices_[e.a].x() < vertices_[e.b].x();
  return 2 * e.arc + (runs_right ? 0 : 1);
}

// The face that contains a loop around the outside of a component.
int PlaneGraph::container_of(int loop) {
  if (face_of_loop_[loop] != unknown) return face_of_loop_[loop];
  const int component = component_[first_of_loop_[loop] / 2];
  bool on_it = false;
  const int below = edge_below(leftmost_[component].at, component, on_it);
  // Components follow one another to the left: no cycle.
  const int face = below < 0 ? unbounded : container_of(loop_[half_edge_above(below)]);
  return face_of_loop_[loop] = face;
}

void PlaneGraph::nest_loops() {
  const int loops = static_cast<int>(first_of_loop_.size());
  face_of_loop_.assign(loops, unknown);
  std::vector<char> is_outside(loops, 0);
  for (const int h : outside_) is_outside[loop_[h]] = 1;
  const auto append = [&](int l) {
    int h = first_of_loop_[l];
    do {
      faces_[face_of_loop_[l]].half_edges.push_back(h);
      h = next_[h];
    } while (h != first_of_loop_[l]);
  };
  for (int l = 0; l < loops; ++l) {
    if (is_outside[l] != 0) continue;
    face_of_loop_[l] = static_cast<int>(faces_.size());
    faces_.emplace_back();
    append(l);
  }
  for (int l = 0; l < loops; ++l)
    if (is_outside[l] != 0 && container_of(l) >= 0) append(l);
  for (Face& face : faces_) {
    const auto around = [&](int half_edge) { return face_of(outside_[component_[half_edge / 2]]); };
    for (int outer = around(face.half_edges.front()); outer >= 0; outer = around(faces_[outer].half_edges.front()))
      ++face.depth;
  }
}

int PlaneGraph::face_at(const Vec2& p) const {
  bool on_it = false;
  const int below = edge_below(p, -1, on_it);
  if (on_it) return on_an_arc;
  return below < 0 ? unbounded : face_of(half_edge_above(below));
}

}  // namespace carreau
