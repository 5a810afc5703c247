#include "size/proximity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace carreau {

namespace {

// Fronts that meet within this angle of head on (cosine).
constexpr double head_on = 0.8;
// Angle of a corner whose sides are near each other because it is a corner; its reach in gaps.
constexpr double sharp_corner = 100 * std::numbers::pi / 180, reach_of_corner = 2;
// Below this the reach in gaps does not hold the tip: there the gap is 2 tan(angle / 2) of the distance from it.
constexpr double wedge = 28 * std::numbers::pi / 180;
constexpr std::size_t triangles_between_checks = 1 << 14;

Vec3 unit(Vec3 v) noexcept {
  const double l = norm(v);
  return l > 0 ? (1 / l) * v : Vec3{};
}

class NarrowZones {
 public:
  NarrowZones(const GradationGraph& graph, const std::vector<std::uint8_t>& sides, const std::vector<double>& wanted,
              Monitor& monitor)
      : graph_(graph), sides_(sides), wanted_(wanted), monitor_(monitor), on_boundary_(graph.xyz.size(), 0) {}

  std::vector<NarrowPlace> run() {
    mark_boundaries();
    send_fronts();
    for (std::size_t t = 0; t < graph_.triangles.size(); ++t) {
      if (t % triangles_between_checks == 0) monitor_.checkpoint();
      for (int i = 0; i < 3; ++i) {
        const int a = graph_.triangles[t][i], b = graph_.triangles[t][(i + 1) % 3],
                  c = graph_.triangles[t][(i + 2) % 3];
        if ((sides_[t] >> ((i + 1) % 3) & 1) != 0) from_side(a, b, c);
        if ((sides_[t] >> i & 1) == 0) along_edge(a, b);
      }
    }
    fill_up();
    cover_ends();
    return std::move(found_);
  }

 private:
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
        corners_.push_back({position(p), angle[p] < wedge ? wanted_[vertex(p)] : 0});
    }
  }

  // Sizes that grow by one for each unit of length are distances.
  void send_fronts() {
    std::vector<double> start(graph_.xyz.size(), std::numeric_limits<double>::infinity());
    for (std::size_t v = 0; v < start.size(); ++v)
      if (on_boundary_[v] != 0) start[v] = std::numeric_limits<double>::min();
    fronts_ = grade_fronts(graph_, start, {}, 1, monitor_);
  }

  /// Whether what is at a place comes from its boundary along the unit vector u.
  [[nodiscard]] bool comes_along(int place, Vec3 u) const noexcept {
    const Vec3 line = fronts_.front[place].line;
    return dot(dot(line, line) > 0 ? unit(line) : inward_[place], u) > head_on;
  }

  void report(double gap, Vec3 across, Vec3 middle, std::initializer_list<int> vertices) {
    for (const Corner& corner : corners_)
      if (norm(corner.xyz - middle) < std::max(reach_of_corner * gap, corner.wanted)) return;
    for (const int v : vertices)
      if (v >= 0) found_.push_back({v, gap, across});
  }
  [[nodiscard]] int source(int place) const noexcept { return fronts_.source[vertex(place)]; }

  // A side on the boundary, and what comes to the opposite corner from another one.
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
    report(gap, u, position(a) + 0.5 * way, {vertex(a), source(a), vertex(b), vertex(c)});
  }

  void along_edge(int a, int b) {
    if (source(a) == source(b)) return;
    const Vec3 gap = position(b) - position(a) + fronts_.front[a].line - fronts_.front[b].line;
    const Vec3 u = unit(gap);
    if (!comes_along(a, u) || !comes_along(b, -1 * u)) return;
    report(norm(gap), u, lerp(position(a), position(b), 0.5), {vertex(a), vertex(b), source(a), source(b)});
  }

  // What the fronts have passed on their way from a foot to where they meet: between the feet and there sizes would
  // grow again as the gradation lets them, and layers be missing.
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

  // A triangle on the end of a zone has a corner outside: its part inside would get sizes that grow towards that.
  void cover_ends() {
    std::sort(found_.begin(), found_.end(), [](const NarrowPlace& p, const NarrowPlace& q) {
      return p.vertex != q.vertex ? p.vertex < q.vertex : p.gap < q.gap;
    });
    std::vector<int> narrowest(graph_.xyz.size(), -1);  // of the places found at a vertex
    for (int k = static_cast<int>(found_.size()) - 1; k >= 0; --k) narrowest[found_[k].vertex] = k;
    for (const auto& t : graph_.triangles)
      for (const int outside : t)
        for (const int inside : t)
          if (const int k = narrowest[vertex(inside)]; k >= 0 && narrowest[vertex(outside)] < 0)
            found_.push_back({vertex(outside), found_[k].gap, found_[k].across});
  }

  const GradationGraph& graph_;
  const std::vector<std::uint8_t>& sides_;
  const std::vector<double>& wanted_;
  Monitor& monitor_;
  std::vector<char> on_boundary_;  // by vertex
  std::vector<Vec3> inward_;       // by place
  struct Corner {
    Vec3 xyz;
    double wanted;
  };
  std::vector<Corner> corners_;
  GradationFronts fronts_;
  std::vector<NarrowPlace> found_;
};

}  // namespace

std::vector<NarrowPlace> find_narrow_places(const GradationGraph& graph, const std::vector<std::uint8_t>& sides,
                                            const std::vector<double>& wanted, Monitor& monitor) {
  return NarrowZones(graph, sides, wanted, monitor).run();
}

}  // namespace carreau
