// SPDX-License-Identifier: BSD-3-Clause
#include "plane/kernel/edge_recovery.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory_resource>
#include <utility>
#include <vector>

#include "predicates/predicates.h"

namespace carreau::plane {

namespace {

// An edge of the polygon on one side of the segment, the polygon on its left.
struct ChainEdge {
  std::int32_t a, b;
  HalfEdge inner;    // in the triangle that will go; no_edge for edges made here
  HalfEdge outside;  // its other side
  std::uint8_t imposed, degenerate;
};

class Recovery {
 public:
  Recovery(Triangulation& mesh, int a, int b) : mesh_(mesh), a_(a), b_(b), p_(mesh.at(a)), q_(mesh.at(b)) {}

  RecoveredEdge run(std::vector<std::int32_t>* changed) {
    int corner = -1;
    const int t = first_triangle(corner);
    if (t < 0 || !cross(t, corner)) return result_;
    std::reverse(left_.begin(), left_.end());
    free_ = crossed_;
    sorted_ = crossed_;
    std::sort(sorted_.begin(), sorted_.end());
    const HalfEdge below = triangulate(right_), above = triangulate(left_);
    link(below, above);
    join_folds();
    if (changed != nullptr) changed->assign(crossed_.begin(), crossed_.end());
    result_.edge = below;
    return result_;
  }

 private:
  [[nodiscard]] int side(int v) const noexcept { return orientation(p_, q_, mesh_.at(v)); }
  // For v on the line: whether it lies on the same side of a as b.
  [[nodiscard]] bool ahead(int v) const noexcept {
    const Vec2 w = mesh_.at(v);
    return p_.x() != q_.x() ? (w.x() > p_.x()) == (q_.x() > p_.x()) : (w.y() > p_.y()) == (q_.y() > p_.y());
  }

  // The triangle at a that the segment enters, and the corner of a in it. -1: result_ decides.
  int first_triangle(int& corner) {
    const HalfEdge there = mesh_.find_edge(a_, b_);
    if (there != no_edge) {
      result_.edge = there;
      return -1;
    }
    const int start = mesh_.vertices[a_].triangle;
    int t = start;
    bool backwards = false;
    for (;;) {
      const Triangle& T = mesh_.triangles[t];
      corner = mesh_.corner_of(t, a_);
      const int r = T.v[next3[corner]], l = T.v[prev3[corner]];
      const int of_r = side(r), of_l = side(l);
      for (const auto& [v, s] : {std::pair(r, of_r), std::pair(l, of_l)})
        if (s == 0 && ahead(v)) {
          result_.vertex = v;
          return -1;
        }
      if (of_r < 0 && of_l > 0) return t;
      const HalfEdge go = backwards ? T.n[prev3[corner]] : T.n[next3[corner]];
      if (go != no_edge) {
        t = go >> 2;
        if (t == start) return -1;
      } else if (!backwards) {
        backwards = true;
        t = start;
        const HalfEdge before = mesh_.triangles[t].n[prev3[mesh_.corner_of(t, a_)]];
        if (before == no_edge) return -1;
        t = before >> 2;
      } else {
        return -1;
      }
    }
  }

  ChainEdge chain_edge(int t, int i) const {
    const Triangle& T = mesh_.triangles[t];
    return {T.v[next3[i]],
            T.v[prev3[i]],
            4 * t + i,
            T.n[i],
            static_cast<std::uint8_t>(T.imposed >> i & 1),
            static_cast<std::uint8_t>(T.degenerate >> i & 1)};
  }

  // Follows the segment: fills crossed_, right_ (from a to b) and left_ (from a to b, each edge turned to the segment).
  bool cross(int t, int i) {
    crossed_.push_back(t);
    right_.push_back(chain_edge(t, prev3[i]));
    left_.push_back(chain_edge(t, next3[i]));
    for (;;) {
      const HalfEdge beyond = mesh_.triangles[t].n[i];
      if (mesh_.is_imposed(t, i) || beyond == no_edge) {
        result_.imposed = 4 * t + i;
        return false;
      }
      t = beyond >> 2;
      const int j = beyond & 3, d = mesh_.triangles[t].v[j];
      crossed_.push_back(t);
      // Corner j is d, then l, then r.
      if (d == b_) {
        right_.push_back(chain_edge(t, next3[j]));
        left_.push_back(chain_edge(t, prev3[j]));
        return true;
      }
      const int s = side(d);
      if (s == 0) {
        result_.vertex = d;
        return false;
      }
      if (s > 0) {
        left_.push_back(chain_edge(t, prev3[j]));
        i = next3[j];
      } else {
        right_.push_back(chain_edge(t, next3[j]));
        i = prev3[j];
      }
    }
  }

  void link(HalfEdge h, HalfEdge g) {
    mesh_.triangles[h >> 2].n[h & 3] = g;
    if (g != no_edge) mesh_.triangles[g >> 2].n[g & 3] = h;
  }

  // A polygon all of whose vertices see the segment that closes it: a corner that turns left is an ear (Graham's scan).
  // Returns the half-edge on the segment.
  HalfEdge triangulate(const std::pmr::vector<ChainEdge>& chain) {
    std::pmr::vector<ChainEdge> open(&memory_);
    for (const ChainEdge& edge : chain) {
      open.push_back(edge);
      while (open.size() > 1) {
        const ChainEdge e = open[open.size() - 2], f = open.back();
        if (orientation(mesh_.at(e.a), mesh_.at(e.b), mesh_.at(f.b)) <= 0) break;
        open.pop_back();
        open.back() = {e.a, f.b, no_edge, make_triangle(e, f), 0, 0};
      }
    }
    return open.front().outside;
  }

  // e.a, e.b, f.b; returns its third half-edge.
  HalfEdge make_triangle(const ChainEdge& e, const ChainEdge& f) {
    const int t = free_.back();
    free_.pop_back();
    Triangle& T = mesh_.triangles[t];
    T = {};
    T.v[0] = e.a, T.v[1] = e.b, T.v[2] = f.b;
    T.imposed = static_cast<std::uint8_t>(e.imposed << 2 | f.imposed);
    T.degenerate = static_cast<std::uint8_t>(e.degenerate << 2 | f.degenerate);
    attach(4 * t + 2, e);
    attach(4 * t, f);
    for (const std::int32_t v : T.v) mesh_.vertices[v].triangle = t;
    return 4 * t + 1;
  }

  // An edge both of whose sides were crossed belongs to the chain twice: its two new triangles meet at the end.
  void attach(HalfEdge he, const ChainEdge& e) {
    const bool fold = e.inner != no_edge && e.outside != no_edge &&
                      std::binary_search(sorted_.begin(), sorted_.end(), e.outside >> 2);
    if (fold)
      folds_.push_back({e.inner, e.outside, he});
    else
      link(he, e.outside);
  }

  void join_folds() {
    for (const Fold& f : folds_)
      for (const Fold& g : folds_)
        if (g.inner == f.outside) mesh_.triangles[f.now >> 2].n[f.now & 3] = g.now;
  }

  struct Fold {
    HalfEdge inner, outside, now;
  };

  Triangulation& mesh_;
  int a_, b_;
  Vec2 p_, q_;
  RecoveredEdge result_;
  // Few triangles are crossed, as a rule.
  std::array<std::byte, 4096> room_;
  std::pmr::monotonic_buffer_resource memory_{room_.data(), room_.size()};
  std::pmr::vector<std::int32_t> crossed_{&memory_}, sorted_{&memory_}, free_{&memory_};
  std::pmr::vector<ChainEdge> right_{&memory_}, left_{&memory_};
  std::pmr::vector<Fold> folds_{&memory_};
};

}  // namespace

RecoveredEdge recover_edge(Triangulation& mesh, int a, int b, std::vector<std::int32_t>* changed) {
  return Recovery(mesh, a, b).run(changed);
}

}  // namespace carreau::plane
