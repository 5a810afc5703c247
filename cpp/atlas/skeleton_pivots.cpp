// SPDX-License-Identifier: BSD-3-Clause
// Pivots by the pseudo-skeleton (Atlas sec. 5.2.2.3 to 5.2.2.5, 5.3.2.2).
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "atlas/pivots.h"
#include "atlas/pseudo_skeleton.h"
#include "atlas/thresholds.h"
#include "predicates/predicates.h"

namespace carreau::atlas {
namespace {

/// A pivot inside, with the edges that it faces.
struct Inner {
  Vec2 place{0, 0};
  std::size_t first = 0, last = 0;
};

/// The edges of the loop between an inner pivot and the next one: all their turns are to one side.
struct Walk {
  std::size_t from = 0, edges = 0;  ///< the first edge, and how many more
  bool right = false;
};

class SkeletonPivots {
 public:
  SkeletonPivots(const Polygon& loop, const Polygon* outer)
      : loop_(loop), outer_(outer != nullptr ? *outer : loop), m_(loop.size()), skeleton_(pseudo_skeleton(loop)) {}

  Pivots make() {
    if (skeleton_.ears.size() < 2) return {};
    for (std::size_t k = 0; k < skeleton_.ears.size(); ++k)
      walk_between(skeleton_.ears[k], skeleton_.ears[next_of(k, skeleton_.ears.size())]);
    Pivots pivots;
    for (std::size_t k = 0; k < inner_.size(); ++k) {
      const Vec2 anchor = middle(walks_[k]);
      pivots.place.push_back(inner_[k].place), pivots.anchor.push_back(anchor);
      pivots.place.push_back(outer_pivot(inner_[k].place, inner_[next_of(k, inner_.size())].place, walks_[k], anchor));
      pivots.anchor.push_back(anchor);
    }
    return pivots;
  }

 private:
  [[nodiscard]] const Vec2& vertex(std::size_t v) const { return loop_[v % m_]; }
  /// The turn at the vertex between edge e and the next edge: +1 to the left.
  [[nodiscard]] int turn(std::size_t e) const { return orientation(vertex(e), vertex(e + 1), vertex(e + 2)); }
  [[nodiscard]] double turn_angle(std::size_t e) const {
    const Vec2 a = vertex(e + 1) - vertex(e), b = vertex(e + 2) - vertex(e + 1);
    return std::atan2(cross(a, b), dot(a, b));
  }

  /// The point half-way along the walk from the middle of its first edge to the middle of its last edge.
  [[nodiscard]] Vec2 middle(const Walk& w) const {
    const auto length = [&](std::size_t e) { return norm(vertex(e + 1) - vertex(e)); };
    double whole = 0;
    for (std::size_t e = w.from; e <= w.from + w.edges; ++e)
      whole += length(e) * (e == w.from || e == w.from + w.edges ? .5 : 1);
    double left = w.edges == 0 ? length(w.from) / 2 : whole / 2 + length(w.from) / 2;
    std::size_t e = w.from;
    while (e < w.from + w.edges && left > length(e)) left -= length(e++);
    return lerp(vertex(e), vertex(e + 1), std::min(1.0, left / length(e)));
  }

  [[nodiscard]] bool meets_skeleton(const Vec2& a, const Vec2& b) const {
    return std::any_of(skeleton_.edges.begin(), skeleton_.edges.end(),
                       [&](const auto& e) { return segments_cross(a, b, e.first, e.second); });
  }

  void walk_between(std::size_t ear, std::size_t next_ear) {
    inner_.push_back({skeleton_.facing[ear], previous_of(ear, m_), ear});
    std::size_t at = ear;
    const std::size_t stop = ear + (previous_of(next_ear, m_) + m_ - ear) % m_;
    do {
      const Walk w = turn(at) < 0 ? right_walk(at, stop) : left_walk(at, stop);
      walks_.push_back(w);
      at += w.edges;
      if (at < stop) inner_.push_back({skeleton_.facing[at % m_], at, at});
    } while (at < stop);
  }

  [[nodiscard]] Walk right_walk(std::size_t at, std::size_t stop) const {
    Walk w{at, 0, true};
    double angle = 0;
    while (at + w.edges < stop && turn(at + w.edges) <= 0) {
      angle -= turn_angle(at + w.edges);
      if (w.edges > 0 && angle > std::numbers::pi) break;
      ++w.edges;
    }
    return w;
  }

  [[nodiscard]] Walk left_walk(std::size_t at, std::size_t stop) const {
    Walk w{at, 0, false};
    while (at + w.edges < stop && turn(at + w.edges) >= 0) {
      const Walk longer{at, w.edges + 1, false};
      const Vec2 p = middle(longer);
      const bool behind_wall =
          meets_skeleton(inner_.back().place, p) || meets_skeleton(p, skeleton_.facing[(at + longer.edges) % m_]);
      if (w.edges > 0 && behind_wall) break;
      w = longer;
    }
    return w;
  }

  /// The nearest crossing of a ray with a border, as a multiple of the direction, beyond `least`; infinity without
  /// crossing.
  [[nodiscard]] static double nearest(const Polygon& border, const Vec2& from, const Vec2& direction, double least) {
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < border.size(); ++i) {
      const Vec2 a = border[i] - from, edge = border[next_of(i, border.size())] - border[i];
      const double determinant = cross(direction, edge);
      if (determinant == 0) continue;
      const double along = cross(a, edge) / determinant, share = cross(a, direction) / determinant;
      if (share >= 0 && share <= 1 && along > least) best = std::min(best, along);
    }
    return best;
  }

  [[nodiscard]] Vec2 outer_pivot(const Vec2& s1, const Vec2& s2, const Walk& w, const Vec2& anchor) const {
    const Vec2 middle_of = (s1 + s2) / 2, right(s2.y() - s1.y(), s1.x() - s2.x());  // as long as from s1 to s2
    if (w.right && !is_inside(outer_, middle_of)) return middle_of;
    const Vec2 from = w.right ? middle_of : anchor;
    constexpr double beyond = 1e-9, half_way = 0.5;
    // Without an outer border the loop is left at once from a point on it, and at the first crossing from inside.
    const bool on_border = &outer_ == &loop_ && !w.right;
    const double leaves = on_border ? 0 : nearest(outer_, from, right, beyond);
    if (!std::isfinite(leaves)) return anchor + half_way * right;
    const double again =
        std::min(nearest(outer_, from, right, leaves + beyond), nearest(loop_, from, right, leaves + beyond));
    const double further = std::isfinite(again) ? (again - leaves) / 2 : half_way;
    return from + (leaves + further) * right;
  }

  const Polygon& loop_;
  const Polygon& outer_;
  std::size_t m_;
  PseudoSkeleton skeleton_;
  std::vector<Inner> inner_;
  std::vector<Walk> walks_;
};

}  // namespace

Pivots skeleton_pivots(const Polygon& loop, const Polygon* outer) { return SkeletonPivots(loop, outer).make(); }

}  // namespace carreau::atlas
