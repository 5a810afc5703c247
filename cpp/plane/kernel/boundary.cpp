// SPDX-License-Identifier: BSD-3-Clause
#include "plane/kernel/boundary.h"

#include <algorithm>

#include "plane/kernel/domain_reader.h"
#include "plane/kernel/edge_recovery.h"
#include "plane/kernel/thresholds.h"
#include "predicates/predicates.h"
#include "support/work_sizes.h"

namespace carreau::plane {

namespace {

class BoundaryMesher {
 public:
  BoundaryMesher(const PlaneDomain& domain, Monitor& monitor)
      : domain_(domain), monitor_(monitor), count_(static_cast<int>(domain.vertices.size())) {}

  BoundaryMesh run() {
    check_domain(domain_);
    frame_ = frame_of(domain_);
    make_box();
    insert_all();
    for (const PlaneEdge& edge : domain_.edges) impose(edge);
    make_delaunay();
    keep_inside();
    return {frame_, std::move(mesh_)};
  }

 private:
  void tick() {
    if (++work_ % work_sizes::searches == 0) monitor_.checkpoint();
  }
  [[nodiscard]] Vec2 uv(int v) const { return domain_.vertices[v]; }

  // Two triangles around everything. Their corners are a little out of line, so that their distances from a side of a
  // rectangular domain differ.
  void make_box() {
    Vec2 low = frame_.inward(domain_.vertices[0]), high = low;
    mesh_.vertices.resize(domain_.vertices.size() + 4);
    for (int v = 0; v < count_; ++v) {
      const Vec2 p = frame_.inward(domain_.vertices[v]);
      mesh_.vertices[v].x = p.x(), mesh_.vertices[v].y = p.y();
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const double w = 3 * (high.x() - low.x()), h = 3 * (high.y() - low.y());
    const Vec2 corners[4] = {{low.x() - w, low.y() - h},
                             {high.x() + 1.02 * w, low.y() - 1.05 * h},
                             {high.x() + w, high.y() + h},
                             {low.x() - 0.97 * w, high.y() + 1.01 * h}};
    for (int k = 0; k < 4; ++k)
      mesh_.vertices[count_ + k].x = corners[k].x(), mesh_.vertices[count_ + k].y = corners[k].y();
    mesh_.triangles.reserve(2 * domain_.vertices.size() + 2);
    mesh_.triangles.resize(2);
    Triangle &first = mesh_.triangles[0], &second = mesh_.triangles[1];
    first.v[0] = second.v[0] = count_;
    first.v[1] = count_ + 1, first.v[2] = second.v[1] = count_ + 2, second.v[2] = count_ + 3;
    first.n[1] = 4 * 1 + 2;
    second.n[2] = 4 * 0 + 1;
    for (int k = 0; k < 4; ++k) mesh_.vertices[count_ + k].triangle = k == 3 ? 1 : 0;
  }

  // Every 2^k-th vertex along the edges first, then the finer ones, each beside a coarser neighbour.
  void insert_all() {
    const std::vector<int> order = order_along_edges(domain_);
    const int n = count_;
    int stride = 1;
    while (stride < n / 4) stride *= 2;
    int hint = 0;
    for (int s = stride; s >= 1; s /= 2)
      for (int k = s == stride ? 0 : s; k < n; k += s == stride ? s : 2 * s) {
        if (s != stride) hint = mesh_.vertices[order[k - s]].triangle;
        insert(order[k], hint);
        hint = mesh_.vertices[order[k]].triangle;
      }
  }

  void insert(int v, int hint) {
    tick();
    const int start = mesh_.locate(mesh_.at(v), hint);
    if (start < 0) throw_at(uv(v), "vertex " + std::to_string(v) + " cannot be placed");
    for (const std::int32_t w : mesh_.triangles[start].v)
      if (mesh_.at(w) == mesh_.at(v))
        throw_at(uv(v), "vertices " + std::to_string(std::min(v, w)) + " and " + std::to_string(std::max(v, w)) +
                            " are the same point of the parameter plane");
    if (!mesh_.dig(mesh_.at(v), Metric2{}, start, {}))
      throw_at(uv(v), "vertex " + std::to_string(v) + " cannot be inserted");
    mesh_.fill(v);
  }

  void impose(const PlaneEdge& edge) {
    tick();
    const RecoveredEdge found = recover_edge(mesh_, edge.a, edge.b);
    if (found.edge == no_edge) explain(edge, found);
    if (mesh_.is_imposed(found.edge >> 2, found.edge & 3))
      throw_at(uv(edge.a), name_of(edge) + " coincides with " + name_of_edge_between(domain_, edge.a, edge.b));
    mesh_.impose(found.edge, edge.kind == PlaneEdgeKind::degenerate);
  }

  [[noreturn]] void explain(const PlaneEdge& edge, const RecoveredEdge& found) const {
    if (found.vertex >= 0)
      throw_at(uv(found.vertex), "vertex " + std::to_string(found.vertex) + " lies on " + name_of(edge));
    if (found.imposed == no_edge) throw_at(uv(edge.a), name_of(edge) + " cannot be found");
    const Triangle& T = mesh_.triangles[found.imposed >> 2];
    const int u = T.v[next3[found.imposed & 3]], v = T.v[prev3[found.imposed & 3]];
    const Vec2 a = uv(edge.a), d = uv(edge.b) - a, p = uv(u), e = uv(v) - p;
    const double at = cross(p - a, e) / cross(d, e);
    throw_at(std::isfinite(at) ? a + at * d : a, name_of(edge) + " crosses " + name_of_edge_between(domain_, u, v));
  }

  // Recovered edges have spoiled the Delaunay property: swaps back, exactly, which always ends.
  void make_delaunay() {
    std::vector<HalfEdge> open;
    open.reserve(3 * mesh_.triangles.size());
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh_.triangles.size()); ++t)
      for (int i = 0; i < 3; ++i)
        if (mesh_.triangles[t].n[i] > 4 * t + i) open.push_back(4 * t + i);
    while (!open.empty()) {
      tick();
      const HalfEdge he = open.back();
      open.pop_back();
      const int t = he >> 2, i = he & 3;
      const Triangle& T = mesh_.triangles[t];
      if (T.n[i] == no_edge || mesh_.is_imposed(t, i)) continue;
      const int u = T.n[i] >> 2, d = mesh_.triangles[u].v[T.n[i] & 3];
      if (in_circle(mesh_.at(T.v[0]), mesh_.at(T.v[1]), mesh_.at(T.v[2]), mesh_.at(d)) <= 0 || !mesh_.can_swap(t, i))
        continue;
      mesh_.swap_edge(t, i);
      for (const HalfEdge outer : {4 * t, 4 * t + 2, 4 * u, 4 * u + 1}) open.push_back(outer);
    }
  }

  // Floods both sides from the boundary's edges: 1 inside, -1 outside.
  void keep_inside() {
    side_.assign(mesh_.triangles.size(), 0);
    queue_.reserve(mesh_.triangles.size());
    std::vector<char> separates(4 * mesh_.triangles.size(), 0);
    for (const PlaneEdge& edge : domain_.edges) {
      if (edge.kind == PlaneEdgeKind::internal) continue;
      tick();
      const HalfEdge he = mesh_.find_edge(edge.a, edge.b), other = mesh_.triangles[he >> 2].n[he & 3];
      separates[he] = separates[other] = 1;
      const bool left = mesh_.triangles[he >> 2].v[next3[he & 3]] == edge.a;
      tell((left ? he : other) >> 2, 1, edge);
      tell((left ? other : he) >> 2, -1, edge);
    }
    while (!queue_.empty()) {
      tick();
      const int t = queue_.back();
      queue_.pop_back();
      for (int i = 0; i < 3; ++i) {
        if (separates[4 * t + i] != 0) continue;
        const HalfEdge other = mesh_.triangles[t].n[i];
        if (other != no_edge)
          tell_beyond(t, i);
        else if (side_[t] > 0)
          throw_at(uv(domain_.edges[0].a),
                   "the domain would be the outside of its boundary: the boundary is turned the wrong way");
      }
    }
    remove_outside();
  }

  void tell(int t, std::int8_t side, const PlaneEdge& edge) {
    if (side_[t] == -side)
      throw_at(uv(edge.a),
               "the domain cannot lie on the left of " + name_of(edge) + ": loops are turned against each other");
    if (side_[t] == 0) queue_.push_back(t);
    side_[t] = side;
  }

  void tell_beyond(int t, int i) {
    const int u = mesh_.triangles[t].n[i] >> 2;
    if (side_[u] == -side_[t]) {
      const int a = mesh_.triangles[t].v[next3[i]], b = mesh_.triangles[t].v[prev3[i]], v = a < count_ ? a : b;
      throw_at(v < count_ ? uv(v) : uv(domain_.edges[0].a),
               "the inside of the domain is ambiguous: loops are turned against each other");
    }
    if (side_[u] == 0) queue_.push_back(u);
    side_[u] = side_[t];
  }

  void remove_outside() {
    auto& triangles = mesh_.triangles;
    std::vector<std::int32_t> rank(triangles.size(), -1);
    std::int32_t kept = 0;
    for (std::size_t t = 0; t < side_.size(); ++t)
      if (side_[t] > 0) rank[t] = kept++;
    for (std::size_t t = 0; t < side_.size(); ++t) {
      if (side_[t] <= 0) continue;
      Triangle T = triangles[t];
      for (HalfEdge& n : T.n)
        if (n != no_edge) n = rank[n >> 2] < 0 ? no_edge : 4 * rank[n >> 2] + (n & 3);
      triangles[rank[t]] = T;
    }
    triangles.resize(kept);
    mesh_.vertices.resize(count_);
    for (Vertex& v : mesh_.vertices) v.triangle = -1;
    for (std::int32_t t = 0; t < kept; ++t)
      for (const std::int32_t v : triangles[t].v) mesh_.vertices[v].triangle = t;
    for (int v = 0; v < count_; ++v)
      if (mesh_.vertices[v].triangle < 0) throw_at(uv(v), "vertex " + std::to_string(v) + " lies outside the domain");
    for (const PlaneEdge& edge : domain_.edges)
      if (edge.kind == PlaneEdgeKind::internal && mesh_.find_edge(edge.a, edge.b) == no_edge) check_inside(edge);
  }

  // Both ends of an internal edge can lie on the boundary, and the edge outside; a vertex at which loops touch has
  // several fans, and find_edge finds only one.
  void check_inside(const PlaneEdge& edge) const {
    for (const Triangle& T : mesh_.triangles)
      for (int i = 0; i < 3; ++i)
        if ((T.v[i] == edge.a && T.v[next3[i]] == edge.b) || (T.v[i] == edge.b && T.v[next3[i]] == edge.a)) return;
    throw_at(uv(edge.a), name_of(edge) + " lies outside the domain");
  }

  const PlaneDomain& domain_;
  Monitor& monitor_;
  int count_;
  Frame frame_;
  Triangulation mesh_;
  std::vector<std::int8_t> side_;
  std::vector<std::int32_t> queue_;
  long work_ = 0;
};

}  // namespace

BoundaryMesh triangulate_boundary(const PlaneDomain& domain, Monitor& monitor) {
  return BoundaryMesher(domain, monitor).run();
}

}  // namespace carreau::plane
