// SPDX-License-Identifier: BSD-3-Clause
#include "gradation/proximity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <span>

#include "gradation/boundary_sides.h"
#include "gradation/thresholds.h"
#include "support/infinity.h"
#include "support/work_sizes.h"

namespace carreau {

namespace {

using namespace thresholds::gradation;

Vec3 unit(const Vec3& v) noexcept {
  const double l = norm(v);
  return l > 0 ? (1 / l) * v : Vec3{};
}

class NarrowZones {
 public:
  NarrowZones(const GradationGraph& graph, const std::vector<std::uint8_t>& sides, const std::vector<double>& wanted,
              Monitor& monitor)
      : graph_(graph),
        sides_(sides),
        wanted_(wanted),
        monitor_(monitor),
        boundaries_(graph, sides),
        on_boundary_(graph.xyz.size(), 0) {}

  std::vector<NarrowPlace> run() {
    mark_boundaries();
    send_fronts();
    for (std::size_t t = 0; t < graph_.triangles.size(); ++t) {
      if (t % work_sizes::searches == 0) monitor_.checkpoint();
      for (int i = 0; i < 3; ++i) {
        const int a = graph_.triangles[t][i], b = graph_.triangles[t][(i + 1) % 3],
                  c = graph_.triangles[t][(i + 2) % 3];
        if ((sides_[t] >> ((i + 1) % 3) & 1) != 0) from_side(a, b, c);
        if ((sides_[t] >> i & 1) == 0) along_edge(a, b);
      }
    }
    accept();
    fill_up();
    cover_ends();
    return std::move(found_);
  }

 private:
  struct Corner {
    Vec3 xyz;
    double wanted;
    std::span<const int> sides;
  };
  /// Two boundaries that face each other.
  struct Report {
    double gap;
    Vec3 across;
    std::span<const int> sides, others;  // that either may belong to
    std::array<int, 4> vertices;
    bool at_end;  // near a corner of one of them
  };

  [[nodiscard]] int vertex(int place) const noexcept { return graph_.places[place].vertex; }
  [[nodiscard]] Vec3 position(int place) const noexcept { return graph_.xyz[vertex(place)]; }

  void mark_boundaries() {
    inward_.resize(graph_.places.size());
    std::vector<double> angle(graph_.places.size(), 0);
    for (std::size_t t = 0; t < graph_.triangles.size(); ++t)
      for (int i = 0; i < 3; ++i) {
        const int a = graph_.triangles[t][i], b = graph_.triangles[t][(i + 1) % 3],
                  c = graph_.triangles[t][(i + 2) % 3];
        const Vec3 p = unit(position(b) - position(a)), q = unit(position(c) - position(a));
        inward_[a] = inward_[a] + p + q;
        angle[a] += std::acos(std::clamp(dot(p, q), -1., 1.));
        if ((sides_[t] >> i & 1) != 0) on_boundary_[vertex(a)] = on_boundary_[vertex(b)] = 1;
      }
    for (int p = 0; p < static_cast<int>(inward_.size()); ++p) {
      inward_[p] = unit(inward_[p]);
      if (on_boundary_[vertex(p)] != 0 && angle[p] < sharp_corner)
        corners_.push_back({position(p), angle[p] < wedge ? wanted_[vertex(p)] : 0, boundaries_.at_place(p)});
    }
  }

  // Sizes that grow by one for each unit of length are distances.
  void send_fronts() {
    std::vector<double> start(graph_.xyz.size(), infinity);
    for (std::size_t v = 0; v < start.size(); ++v)
      if (on_boundary_[v] != 0) start[v] = std::numeric_limits<double>::min();
    fronts_ = grade_fronts(graph_, start, {}, 1, monitor_);
  }

  /// Returns whether the front at a place comes from its boundary along the unit vector u.
  [[nodiscard]] bool comes_along(int place, const Vec3& u) const noexcept {
    const Vec3 line = fronts_.front[place].line;
    return dot(dot(line, line) > 0 ? unit(line) : inward_[place], u) > head_on;
  }

  /// Returns whether two boundaries are near each other because they meet in the corner: the fronts come from two of
  /// its sides. If a closest point may be on several sides, any two count.
  static bool both_meet(const Corner& corner, std::span<const int> sides, std::span<const int> others) {
    const auto count = [](std::span<const int> all, int side) { return std::count(all.begin(), all.end(), side); };
    for (const int p : sides)
      for (const int q : others)
        if (count(corner.sides, p) > 0 && count(corner.sides, q) > (p == q ? 1 : 0)) return true;
    return false;
  }

  /// `foot`, `other`: the approximate closest points on the two boundaries, from which the fronts come.
  void report(double gap, Vec3 across, Vec3 middle, Vec3 foot, Vec3 other, std::span<const int> sides,
              std::span<const int> others, std::array<int, 4> vertices) {
    bool at_end = false;
    for (const Corner& corner : corners_) {
      if (!(norm(corner.xyz - middle) < std::max(reach_of_corner * gap, corner.wanted))) continue;
      if (both_meet(corner, sides, others)) return;
      at_end = true;
    }
    // Fronts of two sides pass a corner of the graph as one wave, whose way is too short there.
    if (at_end && std::abs(dot(other - foot, across)) > longer_between_feet * gap) return;
    reports_.push_back({gap, across, sides, others, vertices, at_end});
  }

  // A zone goes on to its ends, near corners of one of its sides; squares have ends only, and are not zones. One of its
  // sides is enough: in the graph an arc may turn like a corner.
  void accept() {
    std::set<int> of_zones;
    for (const Report& r : reports_)
      if (!r.at_end)
        for (const auto& side : {r.sides, r.others}) of_zones.insert(side.begin(), side.end());
    const auto of_zone = [&](int side) { return of_zones.count(side) > 0; };
    for (const Report& r : reports_)
      if (!r.at_end || std::any_of(r.sides.begin(), r.sides.end(), of_zone) ||
          std::any_of(r.others.begin(), r.others.end(), of_zone))
        for (const int v : r.vertices)
          if (v >= 0) found_.push_back({v, r.gap, r.across});
  }
  /// Sides that the front at a place comes from.
  [[nodiscard]] std::span<const int> origin(int place) const noexcept {
    if (on_boundary_[vertex(place)] != 0) return boundaries_.at_place(place);
    return source(place) < 0 ? std::span<const int>() : boundaries_.at_vertex(source(place));
  }
  [[nodiscard]] int source(int place) const noexcept { return fronts_.source[vertex(place)]; }

  // The point of the boundary that the front at a place comes from.
  [[nodiscard]] Vec3 foot(int place) const noexcept {
    return graph_.xyz[source(place) < 0 ? vertex(place) : source(place)];
  }

  // A side on the boundary, and a front that comes to the opposite corner from another side.
  void from_side(int a, int b, int c) {
    const Vec3 p = position(b), d = position(c) - p, e = position(a) - p;
    const double l = dot(d, d);
    if (!(l > 0)) return;
    const double s = dot(e, d) / l;
    if (s < 0 || s > 1) return;
    const Vec3 way = s * d - e;
    const Vec3 u = unit(way);
    if (on_boundary_[vertex(a)] == 0 && source(a) == vertex(b)) return;
    if (on_boundary_[vertex(a)] == 0 && source(a) == vertex(c)) return;
    if (!comes_along(a, u)) return;
    const double gap = norm(way) + norm(fronts_.front[a].line);
    report(gap, u, position(a) + 0.5 * way, foot(a), position(a) + way, origin(a), boundaries_.of_edge(b, c),
           {vertex(a), source(a), vertex(b), vertex(c)});
  }

  void along_edge(int a, int b) {
    if (source(a) == source(b)) return;
    const Vec3 gap = position(b) - position(a) + fronts_.front[a].line - fronts_.front[b].line;
    const Vec3 u = unit(gap);
    if (!comes_along(a, u) || !comes_along(b, -1 * u)) return;
    report(norm(gap), u, lerp(position(a), position(b), 0.5), foot(a), foot(b), origin(a), origin(b),
           {vertex(a), vertex(b), source(a), source(b)});
  }

  // Adds the places that fronts have passed on their way from a closest point to their meeting point. Otherwise sizes
  // would grow again between these points by the gradation, and layers would be missing.
  void fill_up() {
    std::sort(found_.begin(), found_.end(),
              [](const NarrowPlace& p, const NarrowPlace& q) { return p.vertex < q.vertex; });
    const std::size_t feet = found_.size();
    for (int p = 0; p < static_cast<int>(graph_.places.size()); ++p) {
      const int v = vertex(p);
      if (on_boundary_[v] != 0 || fronts_.source[v] < 0) continue;
      const Vec3 line = fronts_.front[p].line, u = unit(line);
      auto k = std::lower_bound(found_.begin(), found_.begin() + static_cast<std::ptrdiff_t>(feet), fronts_.source[v],
                                [](const NarrowPlace& f, int foot) { return f.vertex < foot; }) -
               found_.begin();
      for (; static_cast<std::size_t>(k) < feet && found_[k].vertex == fronts_.source[v]; ++k) {
        const NarrowPlace foot = found_[k];
        if (std::abs(dot(u, foot.across)) > head_on && norm(line) < foot.gap)
          found_.push_back({v, foot.gap, foot.across});
      }
    }
  }

  // A triangle on the end of a zone has a corner outside: its part inside would get sizes that grow towards that. If
  // another boundary ends the zone, its fronts come between. Then all places within a square of the gap's size get the
  // gap's room.
  void cover_ends() {
    std::sort(found_.begin(), found_.end(), [](const NarrowPlace& p, const NarrowPlace& q) {
      return p.vertex != q.vertex ? p.vertex < q.vertex : p.gap < q.gap;
    });
    std::vector<int> narrowest(graph_.xyz.size(), -1);  // of the places found at a vertex
    for (int k = static_cast<int>(found_.size()) - 1; k >= 0; --k) narrowest[found_[k].vertex] = k;
    std::vector<int> seed(narrowest);  // of vertices: the place found that has reached it
    for (bool first = true;; first = false) {
      const std::vector<int> next = one_ring_further(seed, first);
      bool done = true;
      for (std::size_t v = 0; v < next.size(); ++v)
        if (next[v] >= 0 && seed[v] < 0) {
          seed[v] = next[v];
          done = false;
          found_.push_back({static_cast<int>(v), found_[seed[v]].gap, found_[seed[v]].across});
        }
      if (done) return;
    }
  }

  [[nodiscard]] std::vector<int> one_ring_further(const std::vector<int>& seed, bool first) const {
    std::vector<int> next(seed.size(), -1);
    for (const auto& t : graph_.triangles)
      for (const int outside : t)
        for (const int inside : t) {
          const int k = seed[vertex(inside)];
          int& known = next[vertex(outside)];
          if (k < 0 || seed[vertex(outside)] >= 0) continue;
          // Not on, beyond a boundary.
          const double way = norm(position(outside) - graph_.xyz[found_[k].vertex]);
          if (!first && (on_boundary_[vertex(inside)] != 0 || way > std::numbers::sqrt2 / 2 * found_[k].gap)) continue;
          if (known < 0 || found_[k].gap < found_[known].gap) known = k;
        }
    return next;
  }

  const GradationGraph& graph_;
  const std::vector<std::uint8_t>& sides_;
  const std::vector<double>& wanted_;
  Monitor& monitor_;
  BoundarySides boundaries_;
  std::vector<char> on_boundary_;  // by vertex
  std::vector<Vec3> inward_;       // by place
  std::vector<Corner> corners_;
  GradationFronts fronts_;
  std::vector<Report> reports_;
  std::vector<NarrowPlace> found_;
};

}  // namespace

std::vector<NarrowPlace> find_narrow_places(const GradationGraph& graph, const std::vector<std::uint8_t>& sides,
                                            const std::vector<double>& wanted, Monitor& monitor) {
  return NarrowZones(graph, sides, wanted, monitor).run();
}

}  // namespace carreau
