#include "plane/constraints.h"

#include <algorithm>
#include <string>

#include "predicates/predicates.h"

namespace carreau::plane {

namespace {

// The box around everything is this many times as large as the domain.
constexpr double box_margin = 3;
constexpr int turns_between_checks = 4096;

class Constrainer {
 public:
  Constrainer(const PlaneDomain& domain, Monitor& monitor)
      : domain_(domain), monitor_(monitor), count_(static_cast<int>(domain.vertices.size())) {}

  Triangulation run() {
    check();
    make_box();
    insert_all();
    for (std::size_t e = 0; e < domain_.edges.size(); ++e) impose(static_cast<int>(e));
    keep_inside();
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(Vec2 uv, const std::string& sentence) const { throw DomainError(Where{.uv = uv}, sentence); }
  static std::string name_of(const PlaneEdge& edge) {
    return edge.curve < 0
               ? "an edge"
               : "edge " + std::to_string(edge.segment + 1) + " of the curve of rank " + std::to_string(edge.curve + 1);
  }
  void tick() {
    if (++work_ % turns_between_checks == 0) monitor_.checkpoint();
  }

  void check() const {
    if (count_ < 3) throw DomainError("the domain has fewer than three vertices");
    if (count_ > INT32_MAX / 16) throw LimitError("the boundary has too many vertices");
    for (const Vec2 p : domain_.vertices)
      if (!is_finite(p)) throw DomainError("a vertex of the boundary is not finite");
    std::vector<int> balance(domain_.vertices.size(), 0);
    bool any = false;
    for (const PlaneEdge& edge : domain_.edges) {
      if (edge.a < 0 || edge.b < 0 || edge.a >= count_ || edge.b >= count_ || edge.a == edge.b)
        throw DomainError("an edge of the boundary has no two vertices");
      if (edge.kind == PlaneEdgeKind::internal) continue;
      ++balance[edge.a];
      --balance[edge.b];
      any = true;
    }
    if (!any) throw DomainError("the domain has no boundary");
    for (int v = 0; v < count_; ++v)
      if (balance[v] != 0)
        fail(domain_.vertices[v], "the boundary does not close, or is not turned one way, at this point");
  }

  void make_box() {
    Vec2 low = domain_.vertices[0], high = low;
    for (const Vec2 p : domain_.vertices) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    const double w = high.x - low.x, h = high.y - low.y;
    if (!(w > 0) || !(h > 0)) fail(low, "the domain has no area");
    metric_ = {1 / (w * w), 0, 1 / (h * h)};
    for (const Vec2 p : domain_.vertices) add_vertex(p);
    // Corners a little out of line, so that no vertex of a rectangle sees two of them at once.
    const double m = box_margin;
    const int q = add_vertex({low.x - m * w, low.y - m * h});
    add_vertex({high.x + 1.02 * m * w, low.y - 1.05 * m * h});
    add_vertex({high.x + m * w, high.y + m * h});
    add_vertex({low.x - 0.97 * m * w, high.y + 1.01 * m * h});
    mesh_.triangles.resize(2);
    Triangle &first = mesh_.triangles[0], &second = mesh_.triangles[1];
    first.v[0] = q, first.v[1] = q + 1, first.v[2] = q + 2;
    second.v[0] = q, second.v[1] = q + 2, second.v[2] = q + 3;
    first.n[1] = 4 * 1 + 2;
    second.n[2] = 4 * 0 + 1;
  }

  int add_vertex(Vec2 p) {
    mesh_.vertices.push_back({p.x, p.y, static_cast<float>(metric_.a), 0, static_cast<float>(metric_.c), -1});
    return static_cast<int>(mesh_.vertices.size()) - 1;
  }

  // Every 2^k-th vertex first, then the finer ones beside the coarser: boundaries come in order, and each vertex then
  // falls near one that is already there.
  void insert_all() {
    int stride = 1;
    while (stride < count_ / 4) stride *= 2;
    int hint = 0;
    for (int s = stride; s >= 1; s /= 2)
      for (int v = s == stride ? 0 : s; v < count_; v += s == stride ? s : 2 * s) {
        if (s != stride) hint = mesh_.vertices[v - s].triangle;
        hint = insert(v, hint);
      }
  }

  int insert(int v, int hint) {
    tick();
    const Vec2 p = domain_.vertices[v];
    const int start = mesh_.locate(p, hint);
    if (start < 0) fail(p, "the vertex cannot be placed");
    const Triangle& T = mesh_.triangles[start];
    for (const std::int32_t w : T.v)
      if (mesh_.at(w) == p) fail(p, "two vertices of the boundary are one point of the parameter plane");
    // insert() appends a vertex: the one that exists takes its place.
    if (!mesh_.insert(p, metric_, start, {})) fail(p, "the vertex cannot be inserted");
    const int extra = static_cast<int>(mesh_.vertices.size()) - 1;
    for (const std::int32_t t : mesh_.star()) {
      if (t < 0) continue;
      Triangle& star = mesh_.triangles[t];
      if (star.v[0] == extra) star.v[0] = v;
    }
    mesh_.vertices[v].triangle = mesh_.vertices[extra].triangle;
    mesh_.vertices.pop_back();
    return mesh_.vertices[v].triangle;
  }

  // Triangle at `a` whose opposite edge the ray a -> b crosses, or one that has the edge a - b (then `corner` is that
  // of the other vertex of the triangle). Turns around a.
  struct Sector {
    int triangle = -1;
    int corner = -1;  // of a
    bool has_edge = false;
    bool edge_is_next = false;  // b is the corner after a
  };
  Sector sector_of(int a, int b) {
    const Vec2 p = mesh_.at(a), q = mesh_.at(b);
    const int start = mesh_.vertices[a].triangle;
    int t = start;
    do {
      tick();
      const Triangle& T = mesh_.triangles[t];
      const int k = mesh_.corner_of(t, a), l = T.v[next3[k]], r = T.v[prev3[k]];
      if (l == b) return {t, k, true, true};
      if (r == b) return {t, k, true, false};
      const int left = orientation(p, mesh_.at(l), q), right = orientation(p, mesh_.at(r), q);
      if (left > 0 && right < 0) return {t, k, false, false};
      for (const int w : {l, r}) {
        if (orientation(p, q, mesh_.at(w)) != 0) continue;
        const Vec2 d = q - p, f = mesh_.at(w) - p;
        if (dot(d, f) > 0) fail(mesh_.at(w), "a vertex lies on an edge of the boundary that does not end there");
      }
      const HalfEdge after = T.n[next3[k]];
      if (after == no_edge) break;
      t = after >> 2;
    } while (t != start);
    fail(p, "an edge of the boundary cannot be found");
  }

  void impose(int e) {
    const PlaneEdge& edge = domain_.edges[e];
    Sector sector = sector_of(edge.a, edge.b);
    if (!sector.has_edge) {
      recover(edge, sector);
      sector = sector_of(edge.a, edge.b);
      if (!sector.has_edge) fail(mesh_.at(edge.a), name_of(edge) + " cannot be recovered");
    }
    const int i = sector.edge_is_next ? prev3[sector.corner] : next3[sector.corner];
    mark(4 * sector.triangle + i, edge);
  }

  void mark(HalfEdge he, const PlaneEdge& edge) {
    Triangle& T = mesh_.triangles[he >> 2];
    const int i = he & 3;
    if ((T.imposed >> i & 1) != 0) fail(mesh_.at(edge.a), "two edges of the boundary coincide (" + name_of(edge) + ")");
    const HalfEdge other = T.n[i];
    const auto set = [&](HalfEdge h) {
      if (h == no_edge) return;
      Triangle& U = mesh_.triangles[h >> 2];
      U.imposed = static_cast<std::uint8_t>(U.imposed | 1U << (h & 3));
      if (edge.kind == PlaneEdgeKind::degenerate)
        U.degenerate = static_cast<std::uint8_t>(U.degenerate | 1U << (h & 3));
    };
    set(he);
    set(other);
  }

  // Swaps the edges that cross a - b until it is there. Each is kept by its two ends, since numbers of triangles
  // change; a swap that does not yet remove a crossing is tried again later (always ends in the plane, with exact
  // tests).
  void recover(const PlaneEdge& edge, const Sector& first) {
    const Vec2 p = mesh_.at(edge.a), q = mesh_.at(edge.b);
    std::vector<std::pair<int, int>> crossing;
    int t = first.triangle, i = first.corner;
    for (;;) {
      tick();
      const Triangle& T = mesh_.triangles[t];
      if ((T.imposed >> i & 1) != 0)
        fail(mesh_.at(T.v[next3[i]]), "two edges of the boundary cross (" + name_of(edge) + ")");
      const int l = T.v[prev3[i]], r = T.v[next3[i]];
      crossing.emplace_back(r, l);
      const HalfEdge beyond = T.n[i];
      t = beyond >> 2;
      const int j = beyond & 3, d = mesh_.triangles[t].v[j];
      if (d == edge.b) break;
      const int side = orientation(p, q, mesh_.at(d));
      if (side == 0) fail(mesh_.at(d), "a vertex lies on " + name_of(edge) + ", which does not end there");
      // The triangle is d, l', r' from corner j in its own order: corner j+1 is l, corner j+2 is r.
      i = side > 0 ? next3[j] : prev3[j];
    }
    std::size_t idle = 0;
    for (std::size_t head = 0; head < crossing.size(); ++head) {
      tick();
      const auto [u, v] = crossing[head];
      const HalfEdge he = half_edge(u, v);
      if (he == no_edge) continue;
      if (!mesh_.can_swap(he >> 2, he & 3)) {
        crossing.emplace_back(u, v);
        if (++idle > 4 * crossing.size() + 1000)
          fail(p, "an edge of the boundary cannot be recovered (" + name_of(edge) + ")");
        continue;
      }
      idle = 0;
      const int s = he >> 2;
      mesh_.swap_edge(s, he & 3);
      // The new diagonal is c - d: corners 0 and 2 of s.
      const int c = mesh_.triangles[s].v[0], d = mesh_.triangles[s].v[2];
      if (c == edge.a || c == edge.b || d == edge.a || d == edge.b) continue;
      if (orientation(p, q, mesh_.at(c)) * orientation(p, q, mesh_.at(d)) < 0) crossing.emplace_back(c, d);
    }
  }

  // Turns around u, one way and then, when u lies on the border of the box, the other.
  HalfEdge half_edge(int u, int v) {
    const int start = mesh_.vertices[u].triangle;
    for (const bool left : {true, false}) {
      int t = start;
      do {
        const Triangle& T = mesh_.triangles[t];
        const int k = mesh_.corner_of(t, u);
        if (T.v[next3[k]] == v) return 4 * t + prev3[k];
        if (T.v[prev3[k]] == v) return 4 * t + next3[k];
        const HalfEdge after = T.n[left ? next3[k] : prev3[k]];
        if (after == no_edge) break;
        t = after >> 2;
      } while (t != start);
    }
    return no_edge;
  }

  void keep_inside() {
    std::vector<std::int8_t> side(mesh_.triangles.size(), 0);  // 1 inside, -1 outside
    std::vector<std::int32_t> queue;
    const auto tell = [&](int t, std::int8_t s, Vec2 where) {
      if (side[t] == s) return;
      if (side[t] != 0) fail(where, "the inside of the domain cannot be told: loops are turned against each other");
      side[t] = s;
      queue.push_back(t);
    };
    std::vector<char> separates(4 * mesh_.triangles.size(), 0);
    for (const PlaneEdge& edge : domain_.edges) {
      if (edge.kind == PlaneEdgeKind::internal) continue;
      const Sector sector = sector_of(edge.a, edge.b);
      const Vec2 where = mesh_.at(edge.a);
      const int i = sector.edge_is_next ? prev3[sector.corner] : next3[sector.corner];
      const HalfEdge he = 4 * sector.triangle + i, other = mesh_.triangles[sector.triangle].n[i];
      separates[he] = 1;
      if (other != no_edge) separates[other] = 1;
      // a before b in counterclockwise order: the triangle lies on the left.
      tell(sector.triangle, sector.edge_is_next ? 1 : -1, where);
      if (other != no_edge) tell(other >> 2, sector.edge_is_next ? -1 : 1, where);
    }
    while (!queue.empty()) {
      const int t = queue.back();
      queue.pop_back();
      for (int i = 0; i < 3; ++i) {
        if (separates[4 * t + i] != 0) continue;
        const HalfEdge other = mesh_.triangles[t].n[i];
        if (other == no_edge) {
          if (side[t] > 0)
            fail(mesh_.at(mesh_.triangles[t].v[0]),
                 "the domain is the outside of its boundary: the boundary is turned the wrong way");
        } else {
          tell(other >> 2, side[t], mesh_.at(mesh_.triangles[t].v[0]));
        }
      }
    }
    compress(side);
  }

  void compress(const std::vector<std::int8_t>& side) {
    std::vector<std::int32_t> rank(mesh_.triangles.size(), -1);
    std::int32_t kept = 0;
    for (std::size_t t = 0; t < side.size(); ++t)
      if (side[t] > 0) rank[t] = kept++;
    for (std::size_t t = 0; t < side.size(); ++t) {
      if (side[t] <= 0) continue;
      Triangle T = mesh_.triangles[t];
      for (HalfEdge& n : T.n)
        if (n != no_edge) n = rank[n >> 2] < 0 ? no_edge : 4 * rank[n >> 2] + (n & 3);
      mesh_.triangles[rank[t]] = T;
    }
    mesh_.triangles.resize(kept);
    mesh_.vertices.resize(count_);
    for (Vertex& v : mesh_.vertices) v.triangle = -1;
    for (std::int32_t t = 0; t < kept; ++t)
      for (const std::int32_t v : mesh_.triangles[t].v) mesh_.vertices[v].triangle = t;
    for (int v = 0; v < count_; ++v)
      if (mesh_.vertices[v].triangle < 0) fail(mesh_.at(v), "an imposed point or curve lies outside the domain");
  }

  const PlaneDomain& domain_;
  Monitor& monitor_;
  int count_;
  Metric2 metric_;
  Triangulation mesh_;
  long work_ = 0;
};

}  // namespace

Triangulation triangulate(const PlaneDomain& domain, Monitor& monitor) { return Constrainer(domain, monitor).run(); }

}  // namespace carreau::plane
