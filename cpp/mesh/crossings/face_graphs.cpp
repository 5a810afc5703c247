// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/crossings/face_graphs.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <utility>
#include <vector>

#include "mesh/crossings/outline.h"
#include "mesh/vertex_hash.h"
#include "support/stepped_tasks.h"

namespace carreau {

namespace {

// Smaller faces are not searched: other searches join them. Vertices are numbered nearly without gaps in faces that are searched.
// [time only]
constexpr std::size_t min_face = 256, max_gaps = 4;
// Shares of triangles that are well seen at least, and turned away at most. [time only]
constexpr double min_seen = 0.4, max_turned_away = 0.05;
// Removals of triangles at vertices that alone connect parts of a face. [time only]
constexpr int max_removals = 3;

/// One face. Its state lives as long as its search.
class FaceGraph {
 public:
  FaceGraph(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
            std::span<const TriangleView> views, std::int32_t on_curves)
      : vertices_(vertices), triangles_(triangles), views_(views), on_curves_(on_curves) {}

  /// True if all triangles but those with out()[t] != 0 are a graph.
  bool is_graph() {
    if (triangles_.size() < min_face || !find_side() || !find_range()) return false;
    out_.assign(triangles_.size(), 0);
    const auto most = static_cast<std::size_t>(max_turned_away * static_cast<double>(triangles_.size()));
    std::size_t away = 0;
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      if (!is_turned(t)) {
        if (++away > most) return false;
        leave_out(t);
      }
    for (int removal = 0; removal <= max_removals; ++removal) {
      if (!find_outline()) return false;
      const std::vector<std::int32_t> pinched = pinched_vertices(outline_);
      if (pinched.empty()) return goes_round_once(outline_);
      for (std::size_t t = 0; t < triangles_.size(); ++t)
        for (const std::int32_t v : triangles_[t])
          if (out_[t] == 0 && std::binary_search(pinched.begin(), pinched.end(), v)) leave_out(t);
    }
    return false;
  }
  [[nodiscard]] std::span<const char> out() const noexcept { return out_; }

 private:
  [[nodiscard]] const Vec3& at(std::int32_t v) const noexcept { return vertices_[static_cast<std::size_t>(v)]; }

  // The side from which most triangles are well seen.
  bool find_side() {
    std::array<std::size_t, 6> seen{};
    for (const TriangleView& view : views_) {
      if (!view.any()) return false;
      for (std::size_t s = 0; s < seen.size(); ++s) seen[s] += view.good >> s & 1U;
    }
    const auto most = std::max_element(seen.begin(), seen.end());
    side_ = static_cast<std::int8_t>(most - seen.begin());
    return static_cast<double>(*most) >= min_seen * static_cast<double>(views_.size());
  }

  bool find_range() {
    std::int32_t last = -1;
    low_ = static_cast<std::int32_t>(vertices_.size());
    for (const auto& t : triangles_)
      for (const std::int32_t v : t)
        if (v >= on_curves_) low_ = std::min(low_, v), last = std::max(last, v);
    const std::size_t n = last < low_ ? 0 : static_cast<std::size_t>(last - low_) + 1;
    touched_.assign(n, 0);
    return n <= max_gaps * triangles_.size();
  }

  [[nodiscard]] bool is_turned(std::size_t t) const noexcept {
    if (views_[t].side == side_) return true;
    const auto& [a, b, c] = triangles_[t];
    return turn(side_ >> 1, at(a), at(b), at(c)) == 1 - 2 * (side_ & 1);
  }

  // Its vertices may lie on the outline from now on.
  void leave_out(std::size_t t) {
    out_[t] = 1;
    for (const std::int32_t v : triangles_[t])
      if (v >= on_curves_) touched_[static_cast<std::size_t>(v - low_)] = 1;
  }
  [[nodiscard]] bool may_be_outside(std::int32_t v) const noexcept {
    return v < on_curves_ || touched_[static_cast<std::size_t>(v - low_)] != 0;
  }

  struct Side {
    std::int32_t a, b;
    [[nodiscard]] std::pair<std::int32_t, std::int32_t> key() const noexcept { return std::minmax(a, b); }
  };

  // False if the triangles round an inner vertex do not close.
  bool find_outline() {
    sides_.clear();
    sums_.assign(touched_.size(), 0);
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      if (out_[t] == 0) add_sides(triangles_[t]);
    for (std::size_t v = 0; v < sums_.size(); ++v)
      if (sums_[v] != 0 && touched_[v] == 0) return false;
    return cancel_sides();
  }
  void add_sides(const std::array<std::int32_t, 3>& t) {
    const std::array<bool, 3> outside{may_be_outside(t[0]), may_be_outside(t[1]), may_be_outside(t[2])};
    const std::array<std::uint64_t, 3> hash{vertex_hash(t[0]), vertex_hash(t[1]), vertex_hash(t[2])};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t next = i == 2 ? 0 : i + 1, before = i == 0 ? 2 : i - 1;
      if (!outside[i])
        sums_[static_cast<std::size_t>(t[i] - low_)] += hash[next] - hash[before];
      else if (outside[next])
        sides_.push_back({t[i], t[next]});
    }
  }

  // False if some side is met twice in one direction.
  bool cancel_sides() {
    std::sort(sides_.begin(), sides_.end(), [](const Side& p, const Side& q) {
      return p.key() < q.key() || (p.key() == q.key() && p.a < q.a);
    });
    outline_.clear();
    for (std::size_t k = 0; k < sides_.size();) {
      std::size_t end = k;
      while (end < sides_.size() && sides_[end].key() == sides_[k].key()) ++end;
      if (end - k > 2 || (end - k == 2 && sides_[k].a == sides_[k + 1].a)) return false;
      if (end - k == 1) add_to_outline(sides_[k]);
      k = end;
    }
    return true;
  }
  void add_to_outline(Side side) {
    if ((side_ & 1) != 0) std::swap(side.a, side.b);
    outline_.push_back({side.a, side.b, along(side_ >> 1, at(side.a)), along(side_ >> 1, at(side.b))});
  }

  std::span<const Vec3> vertices_;
  std::span<const std::array<std::int32_t, 3>> triangles_;  // of the face, as all below
  std::span<const TriangleView> views_;
  std::int32_t on_curves_;
  std::int8_t side_ = 0;
  std::int32_t low_ = 0;  // the first of its vertices that are not on curves
  std::vector<char> out_, touched_;
  std::vector<std::uint64_t> sums_;
  std::vector<Side> sides_;
  std::vector<OutlineEdge> outline_;
};

}  // namespace

std::int32_t find_face_graphs(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                              std::span<const TriangleView> views, const FacesOfTriangles& faces,
                              std::span<std::int32_t> graph, int threads, Monitor& monitor) {
  if (faces.first.size() < 2) return 0;
  std::vector<char> found(faces.first.size() - 1, 0);
  const auto range = [&](std::size_t f) {
    return std::pair{static_cast<std::size_t>(faces.first[f]), static_cast<std::size_t>(faces.first[f + 1] - faces.first[f])};
  };
  const auto search = [&](std::size_t f, Monitor& own) {
    own.checkpoint();
    const auto [begin, n] = range(f);
    FaceGraph face(vertices, triangles.subspan(begin, n), views.subspan(begin, n), faces.on_curves);
    if (!face.is_graph()) return;
    found[f] = 1;
    for (std::size_t k = 0; k < n; ++k)
      if (face.out()[k] == 0) graph[begin + k] = 0;
  };
  run_each(found.size(), false, threads, search, monitor);
  std::int32_t count = 0;
  for (std::size_t f = 0; f < found.size(); ++f) {
    if (found[f] == 0) continue;
    const auto [begin, n] = range(f);
    for (std::size_t k = begin; k < begin + n; ++k)
      if (graph[k] >= 0) graph[k] = count;
    ++count;
  }
  return count;
}

}  // namespace carreau
