// SPDX-License-Identifier: BSD-3-Clause
#include "plane/division/arrival.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <tuple>

#include "support/incidence.h"
#include "support/infinity.h"

namespace carreau::plane {

namespace {

/// Time in units walked, and starting place.
struct Arrival {
  double time = infinity, place = 0;
};

// Farther apart, places are not on the same stretch of the border. [places]
constexpr double same_stretch = 4;

class March {
 public:
  March(const CoarseMesh& coarse, const CoarseDomain& domain)
      : triangles_(coarse.mesh.triangles),
        points_(coarse.mesh.vertices),
        domain_(domain.domain),
        metric_(coarse.metric),
        at_(points_.size()),
        around_(points_.size(), triangles_),
        settled_(points_.size(), 0) {}

  std::vector<double> run() {
    start_at_edges();
    while (!queue_.empty()) {
      const std::int32_t v = std::get<1>(queue_.top());
      queue_.pop();
      if (settled_[v] != 0) continue;
      settled_[v] = 1;
      for (const std::int32_t t : around_.of(v)) pass(t);
    }
    std::vector<double> places;
    places.reserve(triangles_.size());
    for (std::size_t t = 0; t < triangles_.size(); ++t) places.push_back(at_centroid(t).place);
    return places;
  }

 private:
  // Walks from edge to edge, and counts.
  void start_at_edges() {
    const auto& edges = domain_.edges;
    std::vector<std::array<std::int32_t, 2>> ends;
    ends.reserve(edges.size());
    for (const PlaneEdge& edge : edges) ends.push_back({edge.a, edge.b});
    const Incidence at(domain_.vertices.size(), ends);
    std::vector<char> passed(edges.size(), 0);
    double place = 0;
    for (std::size_t first = 0; first < edges.size(); ++first) {
      auto e = static_cast<std::int32_t>(first);
      for (int v = edges[first].a; e >= 0 && passed[e] == 0;) {
        passed[e] = 1;
        const int w = edges[e].a == v ? edges[e].b : edges[e].a;
        if (edges[e].kind != PlaneEdgeKind::degenerate) {
          reach(v, {0, place});
          reach(w, {0, place + 1});
        }
        place += 1;
        v = w;
        const auto here = at.of(v);
        const auto open = std::find_if(here.begin(), here.end(), [&](std::int32_t o) { return passed[o] == 0; });
        e = open == here.end() ? -1 : *open;
      }
      place += same_stretch;
    }
  }

  void reach(std::int32_t v, Arrival arrival) {
    if (!(arrival.time < at_[v].time)) return;
    at_[v] = arrival;
    queue_.emplace(arrival.time, v);
  }

  void pass(std::int32_t t) {
    const auto& corners = triangles_[t];
    const Metric2 m = metric_[t];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = corners[(i + 1) % 3], b = corners[(i + 2) % 3], c = corners[i];
      if (settled_[c] != 0) continue;
      if (settled_[a] != 0) reach(c, along(m, a, points_[c]));
      if (settled_[b] != 0) reach(c, along(m, b, points_[c]));
      if (settled_[a] != 0 && settled_[b] != 0) reach(c, across(m, a, b, points_[c]));
    }
  }
  [[nodiscard]] Arrival at_centroid(std::size_t of) const {
    const auto& t = triangles_[of];
    const Vec2 p = centroid(t);
    const Metric2 m = metric_[of];
    Arrival best = along(m, t[0], p);
    for (std::size_t i = 0; i < 3; ++i)
      for (const Arrival& other : {along(m, t[i], p), across(m, t[i], t[(i + 1) % 3], p)})
        if (other.time < best.time) best = other;
    return best;
  }

  [[nodiscard]] Arrival along(Metric2 m, std::int32_t a, Vec2 p) const {
    return {at_[a].time + length(m, p - points_[a]), at_[a].place};
  }
  // A straight front that has passed a and b, if it comes to p between them.
  [[nodiscard]] Arrival across(Metric2 m, std::int32_t a, std::int32_t b, Vec2 p) const {
    const Vec2 e = points_[b] - points_[a], d = p - points_[a];
    const double base = length(m, e);
    if (!(base > 0) || !(at_[a].time < infinity) || !(at_[b].time < infinity)) return {};
    const double x = dot(m, e, d) / base, y2 = squared_length(m, d) - x * x;
    const double slope = (at_[b].time - at_[a].time) / base;
    if (!(std::abs(slope) < 1) || !(y2 > 0)) return {};
    const double rise = std::sqrt(1 - slope * slope), y = std::sqrt(y2), s = (x - slope / rise * y) / base;
    if (!(s >= 0 && s <= 1)) return {};
    const double from = at_[a].place, to = at_[b].place;
    const double place = std::abs(to - from) < same_stretch ? from + s * (to - from) : s < 0.5 ? from : to;
    return {at_[a].time + slope * x + rise * y, place};
  }

  [[nodiscard]] Vec2 centroid(const std::array<std::int32_t, 3>& t) const {
    return (1.0 / 3) * (points_[t[0]] + points_[t[1]] + points_[t[2]]);
  }

  const std::vector<std::array<std::int32_t, 3>>& triangles_;
  const std::vector<Vec2>& points_;
  const PlaneDomain& domain_;
  const std::vector<Metric2>& metric_;  // by triangle
  std::vector<Arrival> at_;
  Incidence around_;  // triangles by vertex
  std::vector<char> settled_;
  using Entry = std::tuple<double, std::int32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

std::vector<double> arrivals(const CoarseMesh& coarse, const CoarseDomain& domain) {
  return March(coarse, domain).run();
}

}  // namespace carreau::plane
