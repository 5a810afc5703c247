// Degenerate sides (HDR sec. 4.5.4): an edge of the parameter plane that is one point in space, the apex. The metric
// near it is clamped, so that neither fronts nor the kernel can be trusted there: the fan of triangles that surrounds
// the apex is built first, and never touched again.
#include <algorithm>
#include <cmath>

#include "plane/kernel/edge_recovery.h"
#include "plane/placement/filler.h"
#include "predicates/predicates.h"

namespace carreau::plane {

namespace {

constexpr int rays = 33;            // 0.2 units apart round a pole, if all are alike
constexpr double widest_gap = 0.4;  // between rays; else there are more of them
constexpr std::size_t most_rays = 512;
constexpr double step = 0.05;                                    // unit lengths
constexpr double enough_room = 1.5;                              // a row fits between the ring and what is beyond it
constexpr std::size_t steps_of_room = 30;                        // enough_room / step
constexpr double least_room = 0.5;                               // below, no ring
constexpr double narrowest = 0.5;                                // of a triangle of a wide fan, over its height
constexpr double ring_distance = 0.5;                            // least distance of a ring point to other vertices
constexpr double longest_lateral = 1.6, shortest_lateral = 0.5;  // of a lateral edge that takes part in the fan

}  // namespace

// Rays from the degenerate edge a - b into the domain, by the length walked on them.
struct Filler::Ring {
  std::int32_t before = -1, after = -1;  // other ends of the lateral edges at a and at b
  int triangle = -1;                     // that has the degenerate edge
  int fan = 0;                           // triangles that already surround the apex
  double room = 0;
  std::vector<std::vector<Vec2>> ray;  // ray[k][i]: at i steps
};

int Filler::surround_degenerate_edges(const PlaneDomain& domain) {
  for (const PlaneEdge& edge : domain.edges) {
    if (edge.kind != PlaneEdgeKind::degenerate) continue;
    degenerate_.push_back({edge.a, edge.b, edge.least_fan, edge.wide_fan});
    degenerate_ends_.insert(degenerate_ends_.end(), {edge.a, edge.b});
  }
  for (DegenerateEdge& edge : degenerate_) {
    monitor_.checkpoint();
    surround(edge);
  }
  touched_.clear();
  return static_cast<int>(mesh_.vertices.size());
}

Filler::Ring Filler::sample_ring(const DegenerateEdge& edge) const {
  Ring ring;
  const HalfEdge he = mesh_.find_edge(edge.a, edge.b);
  ring.triangle = he >> 2;
  // Round b and round a to the lateral edges.
  int t = he >> 2, i = he & 3;
  for (;;) {
    const int j = next3[i];
    ring.after = mesh_.triangles[t].v[i];
    const HalfEdge other = mesh_.triangles[t].n[j];
    if (other == no_edge) break;
    t = other >> 2, i = other & 3;
    ++ring.fan;
  }
  t = he >> 2, i = he & 3;
  for (;;) {
    const int j = prev3[i];
    ring.before = mesh_.triangles[t].v[i];
    const HalfEdge other = mesh_.triangles[t].n[j];
    if (other == no_edge) break;
    t = other >> 2, i = other & 3;
    ++ring.fan;
  }
  const Vec2 a = mesh_.at(edge.a), b = mesh_.at(edge.b);
  const Vec2 from_a = mesh_.at(ring.before) - a, from_b = mesh_.at(ring.after) - b;
  const auto ray_at = [&](double s) {
    return walk(lerp(a, b, s), lerp(from_a, from_b, s), s > 0 && s < 1 ? ring.triangle : -1);
  };
  std::vector<double> share;
  for (int k = 0; k < rays; ++k) {
    share.push_back(static_cast<double>(k) / (rays - 1));
    ring.ray.push_back(ray_at(share.back()));
  }
  // Where sizes differ by direction rays that are evenly spaced in the frame are not in the metric.
  for (std::size_t k = 0; k + 1 < ring.ray.size() && ring.ray.size() < most_rays;) {
    const std::size_t row =
        std::min({static_cast<std::size_t>(1 / step), ring.ray[k].size() - 1, ring.ray[k + 1].size() - 1});
    const double middle = 0.5 * (share[k] + share[k + 1]);
    if (!(distance_at_middle(ring.ray[k][row], ring.ray[k + 1][row]) > widest_gap) || !(share[k] < middle)) {
      ++k;
      continue;
    }
    const auto after = static_cast<std::ptrdiff_t>(k) + 1;
    share.insert(share.begin() + after, middle);
    ring.ray.insert(ring.ray.begin() + after, ray_at(middle));
  }
  std::size_t room = steps_of_room;
  for (const auto& ray : ring.ray) room = std::min(room, ray.size() - 1);
  ring.room = static_cast<double>(room) * step;
  return ring;
}

// Places at multiples of the step along a ray, as far as there is room. `hint`: the triangle that it begins in; -1:
// it is not looked where it goes.
std::vector<Vec2> Filler::walk(Vec2 from, Vec2 direction, int hint) const {
  const bool inside = hint >= 0;
  std::vector<Vec2> ray{from};
  while (ray.size() <= steps_of_room) {
    const Vec2 p = ray.back();
    const double speed = length(field_.at(p), direction);
    if (!(speed > 0)) break;
    const Vec2 middle = p + (0.5 * step / speed) * direction;
    const Vec2 next = p + (step / length(field_.at(middle), direction)) * direction;
    if (inside) {
      hint = is_finite(next) ? mesh_.locate(next, hint) : -1;
      if (hint < 0) break;
    }
    ray.push_back(next);
  }
  return ray;
}

// Equally spaced along the ring, one unit apart as nearly as possible.
std::vector<Vec2> Filler::points_on(const Ring& ring, double height, const DegenerateEdge& edge,
                                    double& spacing) const {
  std::vector<Vec2> at;
  std::vector<double> along;
  for (const auto& ray : ring.ray) {
    const auto i = std::min(static_cast<std::size_t>(height / step + 0.5), ray.size() - 1);
    along.push_back(at.empty() ? 0 : along.back() + distance_at_middle(at.back(), ray[i]));
    at.push_back(ray[i]);
  }
  const bool wide = along.back() >= narrowest * height * edge.wide_fan;
  const int least = wide ? std::max(edge.wide_fan, edge.least_fan) : edge.least_fan;
  const int pieces = std::max(least, static_cast<int>(std::min(along.back() + 0.5, 1e6)));
  spacing = along.back() / pieces;
  std::vector<Vec2> points;
  std::size_t k = 0;
  for (int q = 1; q < pieces; ++q) {
    const double target = along.back() * q / pieces;
    while (k + 2 < at.size() && along[k + 1] < target) ++k;
    const double gap = along[k + 1] - along[k];
    points.push_back(gap > 0 ? lerp(at[k], at[k + 1], std::min((target - along[k]) / gap, 1.0)) : at[k]);
  }
  return points;
}

void Filler::surround(DegenerateEdge& edge) {
  const Ring ring = sample_ring(edge);
  const double height = ring.room >= enough_room - 0.5 * step ? 1 : 0.5 * ring.room;
  if (ring.room < least_room || (height < 1 && ring.fan >= edge.least_fan)) return;
  std::vector<std::int32_t> fan;
  const auto takes_part = [&](int end, int v) {
    const double l = length(field_.at(0.5 * (mesh_.at(end) + mesh_.at(v))), mesh_.at(v) - mesh_.at(end));
    return l < longest_lateral * height && l > shortest_lateral * height;
  };
  if (takes_part(edge.a, ring.before)) fan.push_back(ring.before);
  int hint = ring.triangle;
  double spacing = 0;
  for (const Vec2& p : points_on(ring, height, edge, spacing)) {
    hint = mesh_.locate(p, hint);
    if (hint < 0) {
      hint = mesh_.vertices[edge.a].triangle;
      continue;
    }
    const Metric2 metric = field_.at(p);
    const double least = ring_distance * std::min(spacing, height);
    if (!mesh_.dig(p, metric, hint, {least * least, 0, 0, degenerate_ends_})) continue;
    insert_at(p, metric, Bend::none);
    fan.push_back(static_cast<std::int32_t>(mesh_.vertices.size()) - 1);
    hint = mesh_.vertices.back().triangle;
  }
  if (takes_part(edge.b, ring.after)) fan.push_back(ring.after);
  edge.surrounded = freeze_fan(edge, fan);
}

// fan: from the side of a to that of b. The first half is joined to a, the other to b.
bool Filler::freeze_fan(const DegenerateEdge& edge, const std::vector<std::int32_t>& fan) {
  const int n = static_cast<int>(fan.size()), middle = n / 2;
  if (n < 2) return false;
  const auto end_of = [&](int k) { return k < middle ? edge.a : edge.b; };  // of the triangle on fan[k], fan[k + 1]
  for (int k = 0; k + 1 < n; ++k)
    if (orientation(mesh_.at(end_of(k)), mesh_.at(fan[k + 1]), mesh_.at(fan[k])) <= 0) return false;
  if (orientation(mesh_.at(edge.a), mesh_.at(edge.b), mesh_.at(fan[middle])) <= 0) return false;
  const auto force = [&](int u, int v) {
    const HalfEdge he = recover_edge(mesh_, u, v).edge;
    if (he != no_edge) mesh_.impose(he, false);
    return he != no_edge;
  };
  bool whole = true;
  for (int k = 0; k < n; ++k) {
    if (k <= middle) whole = force(edge.a, fan[k]) && whole;
    if (k >= middle) whole = force(edge.b, fan[k]) && whole;
    if (k > 0) whole = force(fan[k - 1], fan[k]) && whole;
  }
  if (!whole) return false;
  for (Triangle& T : mesh_.triangles) {
    bool apex = false, inside = true;
    for (const std::int32_t v : T.v) {
      apex = apex || v == edge.a || v == edge.b;
      inside = inside && (v == edge.a || v == edge.b || std::find(fan.begin(), fan.end(), v) != fan.end());
    }
    if (apex && inside) T.done = Done::frozen;
  }
  return true;
}

}  // namespace carreau::plane
