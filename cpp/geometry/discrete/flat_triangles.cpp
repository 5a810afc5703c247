// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/discrete/flat_triangles.h"

#include <algorithm>
#include <map>
#include <queue>
#include <set>

#include "geometry/discrete/thresholds.h"
#include "geometry/discrete/triangulation.h"
#include "model/union_find.h"
#include "support/rounding_of.h"

namespace carreau::discrete {

namespace {

using Corners = std::array<std::int32_t, 3>;
using Edge = std::array<std::int32_t, 2>;

bool has_double_corner(const Corners& t) noexcept { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

class FlatDropper {
 public:
  FlatDropper(std::span<const Vec3> vertices, TriangleList& list, std::vector<Edge>& marked)
      : vertices_(vertices), list_(list), marked_(marked), gone_(list.triangles.size(), 0) {}

  std::vector<std::int32_t> run() {
    if (std::ranges::none_of(list_.triangles, [&](const Corners& t) { return is_flat(vertices_, t); })) return {};
    lines_.insert(marked_.begin(), marked_.end());
    join_corners();
    divide_sides();
    compress();
    marked_.assign(lines_.begin(), lines_.end());
    return std::move(dropped_);
  }

 private:
  [[nodiscard]] double length(std::int32_t v, std::int32_t w) const {
    return norm(vertices_[index(w)] - vertices_[index(v)]);
  }
  /// The side from this corner to the next one is the longest; the earliest of equal ones.
  [[nodiscard]] std::size_t longest_side(const Corners& t) const {
    std::size_t longest = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (length(t[k], t[(k + 1) % 3]) > length(t[longest], t[(longest + 1) % 3])) longest = k;
    return longest;
  }

  void drop(std::size_t t) {
    gone_[t] = 1;
    dropped_.push_back(list_.origin[t]);
  }

  /// Needles: a short side within rounding would stay short however the triangle is divided.
  void join_corners() {
    UnionFind joined(vertices_.size());
    bool any = false;
    for (const Corners& t : list_.triangles) {
      if (!is_flat(vertices_, t)) continue;
      const std::size_t k = longest_side(t);
      const double longest = length(t[k], t[(k + 1) % 3]);
      for (std::size_t i = 1; i < 3; ++i) {
        const std::int32_t v = t[(k + i) % 3], w = t[(k + i + 1) % 3];
        if (length(v, w) <= rounding_of::heights * longest) joined.merge(index(v), index(w)), any = true;
      }
    }
    if (!any) return;
    std::vector<std::int32_t> first(vertices_.size(), -1);
    for (std::size_t v = 0; v < first.size(); ++v)
      if (std::int32_t& known = first[joined.find(v)]; known < 0) known = static_cast<std::int32_t>(v);
    const auto move = [&](std::int32_t& v) { v = first[joined.find(index(v))]; };
    for (std::size_t t = 0; t < gone_.size(); ++t) {
      std::ranges::for_each(list_.triangles[t], move);
      if (has_double_corner(list_.triangles[t])) drop(t);
    }
    std::set<Edge> moved;
    for (Edge e : lines_) {
      std::ranges::for_each(e, move);
      if (e[0] != e[1]) moved.insert(edge_of(e[0], e[1]));
    }
    lines_ = std::move(moved);
  }

  void add_to_edges(std::size_t t) {
    const Corners& c = list_.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) of_edge_[edge_of(c[k], c[(k + 1) % 3])].push_back(t);
    if (!is_flat(vertices_, c)) return;
    const std::size_t k = longest_side(c);
    flat_.push({length(c[k], c[(k + 1) % 3]), t});
  }

  /// The longest side comes first: new sides are shorter, so that the work ends.
  void divide_sides() {
    for (std::size_t t = 0; t < gone_.size(); ++t)
      if (gone_[t] == 0) add_to_edges(t);
    constexpr std::size_t rounds = 64;  // a flat triangle among flat ones is divided a few times
    for (std::size_t left = rounds * (flat_.size() + 1); !flat_.empty() && left > 0; --left) {
      const std::size_t t = flat_.top().second;
      flat_.pop();
      if (gone_[t] == 0) divide(t);
    }
  }

  void divide(std::size_t flat) {
    const Corners c = list_.triangles[flat];
    const std::size_t k = longest_side(c);
    const std::int32_t v = c[k], w = c[(k + 1) % 3], between = c[(k + 2) % 3];
    drop(flat);
    const std::vector<std::size_t> sharing = of_edge_[edge_of(v, w)];
    for (const std::size_t t : sharing)
      if (gone_[t] == 0) divide_at(t, edge_of(v, w), between);
    if (lines_.erase(edge_of(v, w)) > 0) lines_.insert({edge_of(v, between), edge_of(between, w)});
  }

  void divide_at(std::size_t t, const Edge& side, std::int32_t between) {
    const Corners c = list_.triangles[t];
    std::size_t k = 0;
    while (edge_of(c[k], c[(k + 1) % 3]) != side) ++k;
    const std::int32_t apex = c[(k + 2) % 3];
    if (apex == between) return drop(t);
    gone_[t] = 1;
    for (const Corners& half : {Corners{c[k], between, apex}, Corners{between, c[(k + 1) % 3], apex}}) {
      list_.triangles.push_back(half);
      list_.refs.push_back(std::int32_t{list_.refs[t]});
      list_.origin.push_back(std::int32_t{list_.origin[t]});
      gone_.push_back(0);
      add_to_edges(gone_.size() - 1);
    }
  }

  void compress() {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < gone_.size(); ++t) {
      if (gone_[t] != 0) continue;
      list_.triangles[kept] = list_.triangles[t];
      list_.refs[kept] = list_.refs[t], list_.origin[kept] = list_.origin[t];
      ++kept;
    }
    list_.triangles.resize(kept), list_.refs.resize(kept), list_.origin.resize(kept);
  }

  std::span<const Vec3> vertices_;
  TriangleList& list_;
  std::vector<Edge>& marked_;
  std::set<Edge> lines_;  // the same
  std::vector<char> gone_;
  std::vector<std::int32_t> dropped_;
  std::map<Edge, std::vector<std::size_t>> of_edge_;
  std::priority_queue<std::pair<double, std::size_t>> flat_;
};

}  // namespace

bool is_flat(std::span<const Vec3> vertices, const Corners& t) noexcept {
  const Vec3 &a = vertices[index(t[0])], &b = vertices[index(t[1])], &c = vertices[index(t[2])];
  const double longest = std::max({norm(b - a), norm(c - b), norm(a - c)});
  return !(norm(cross(b - a, c - a)) > rounding_of::heights * longest * longest);
}

std::vector<std::int32_t> drop_flat_triangles(std::span<const Vec3> vertices, TriangleList list,
                                              std::vector<Edge>& marked) {
  return FlatDropper(vertices, list, marked).run();
}

}  // namespace carreau::discrete
