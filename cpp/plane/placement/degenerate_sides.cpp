// SPDX-License-Identifier: BSD-3-Clause
#include "plane/placement/degenerate_sides.h"

#include <algorithm>
#include <cmath>

#include "plane/kernel/edge_recovery.h"
#include "plane/kernel/thresholds.h"
#include "predicates/predicates.h"

namespace carreau::plane {

namespace {

// Rays from the degenerate edge a - b into the domain, by the length walked on them.
struct Ring {
  std::int32_t before = -1, after = -1;  // other ends of the lateral edges at a and at b
  int triangle = -1;                     // that has the degenerate edge
  int fan = 0;                           // triangles that already surround the apex
  double room = 0;
  std::vector<std::vector<Vec2>> ray;  // ray[k][i]: at i steps
};

// Places at multiples of the ray_step along a ray, within the room. `hint`: the triangle in which the ray begins; -1:
// does not follow the triangles.
std::vector<Vec2> walk(const Placement& placement, const Vec2& from, const Vec2& direction, int hint) {
  const bool inside = hint >= 0;
  std::vector<Vec2> ray{from};
  while (ray.size() <= steps_of_room) {
    const Vec2 p = ray.back();
    const double speed = length(placement.field.at(p), direction);
    if (!(speed > 0)) break;
    const Vec2 middle = p + (0.5 * ray_step / speed) * direction;
    const Vec2 next = p + (ray_step / length(placement.field.at(middle), direction)) * direction;
    if (inside) {
      hint = is_finite(next) ? placement.mesh.locate(next, hint) : -1;
      if (hint < 0) break;
    }
    ray.push_back(next);
  }
  return ray;
}

// Turns about one end of the degenerate edge `he` to the lateral edge there, whose other end it returns. `next`: next3
// about the end of the half-edge, prev3 about its start. Counts the triangles passed.
int turn_to_lateral(const Triangulation& mesh, HalfEdge he, const int (&next)[3], int& passed) {
  for (;; ++passed) {
    const int t = he >> 2, i = he & 3;
    const HalfEdge other = mesh.triangles[t].n[next[i]];
    if (other == no_edge) return mesh.triangles[t].v[i];
    he = other;
  }
}

Ring sample_ring(const Placement& placement, const DegenerateSide& side) {
  const Triangulation& mesh = placement.mesh;
  Ring ring;
  const HalfEdge he = mesh.find_edge(side.a, side.b);
  ring.triangle = he >> 2;
  ring.after = turn_to_lateral(mesh, he, next3, ring.fan);
  ring.before = turn_to_lateral(mesh, he, prev3, ring.fan);
  const Vec2 a = mesh.at(side.a), b = mesh.at(side.b);
  const Vec2 from_a = mesh.at(ring.before) - a, from_b = mesh.at(ring.after) - b;
  const auto ray_at = [&](double s) {
    return walk(placement, lerp(a, b, s), lerp(from_a, from_b, s), s > 0 && s < 1 ? ring.triangle : -1);
  };
  std::vector<double> share;
  for (int k = 0; k < rays; ++k) {
    share.push_back(static_cast<double>(k) / (rays - 1));
    ring.ray.push_back(ray_at(share.back()));
  }
  // If sizes differ by direction, rays that are evenly spaced in the frame are not so in the metric.
  // More rays only take time.
  for (std::size_t k = 0; k + 1 < ring.ray.size() && ring.ray.size() < 512;) {
    const auto &ray = ring.ray[k], &next = ring.ray[k + 1];
    const std::size_t unit = std::min({static_cast<std::size_t>(1 / ray_step), ray.size() - 1, next.size() - 1});
    const double middle = 0.5 * (share[k] + share[k + 1]);
    if (!(placement.field.length_at_middle(ray[unit], next[unit]) > widest_ray_gap) || !(share[k] < middle)) {
      ++k;
      continue;
    }
    const auto after = static_cast<std::ptrdiff_t>(k) + 1;
    share.insert(share.begin() + after, middle);
    ring.ray.insert(ring.ray.begin() + after, ray_at(middle));
  }
  std::size_t room = steps_of_room;
  for (const auto& ray : ring.ray) room = std::min(room, ray.size() - 1);
  ring.room = static_cast<double>(room) * ray_step;
  return ring;
}

// Equally spaced along the ring, one unit apart as nearly as possible.
std::vector<Vec2> points_on(const Field& field, const Ring& ring, double height, const DegenerateSide& side,
                            double& spacing) {
  std::vector<Vec2> at;
  std::vector<double> along;
  for (const auto& ray : ring.ray) {
    const auto i = std::min(static_cast<std::size_t>(height / ray_step + 0.5), ray.size() - 1);
    along.push_back(at.empty() ? 0 : along.back() + field.length_at_middle(at.back(), ray[i]));
    at.push_back(ray[i]);
  }
  const bool wide = along.back() >= narrowest_fan * height * side.wide_fan;
  const int least = wide ? std::max(side.wide_fan, side.min_fan) : side.min_fan;
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

// fan: from the side of a to the side of b. The first half is joined to a, the other to b.
bool freeze_fan(Triangulation& mesh, const DegenerateSide& side, const std::vector<std::int32_t>& fan) {
  const int n = static_cast<int>(fan.size()), middle = n / 2;
  if (n < 2) return false;
  const auto end_of = [&](int k) { return k < middle ? side.a : side.b; };  // of the triangle on fan[k], fan[k + 1]
  for (int k = 0; k + 1 < n; ++k)
    if (orientation(mesh.at(end_of(k)), mesh.at(fan[k + 1]), mesh.at(fan[k])) <= 0) return false;
  if (orientation(mesh.at(side.a), mesh.at(side.b), mesh.at(fan[middle])) <= 0) return false;
  const auto force = [&](int u, int v) {
    const HalfEdge he = recover_edge(mesh, u, v).edge;
    if (he != no_edge) mesh.impose(he, false);
    return he != no_edge;
  };
  bool whole = true;
  for (int k = 0; k < n; ++k) {
    if (k <= middle) whole = force(side.a, fan[k]) && whole;
    if (k >= middle) whole = force(side.b, fan[k]) && whole;
    if (k > 0) whole = force(fan[k - 1], fan[k]) && whole;
  }
  if (!whole) return false;
  for (Triangle& T : mesh.triangles) {
    bool apex = false, inside = true;
    for (const std::int32_t v : T.v) {
      apex = apex || v == side.a || v == side.b;
      inside = inside && (v == side.a || v == side.b || std::find(fan.begin(), fan.end(), v) != fan.end());
    }
    if (apex && inside) T.done = Done::frozen;
  }
  return true;
}

void surround(Placement& placement, DegenerateSide& side) {
  Triangulation& mesh = placement.mesh;
  const Ring ring = sample_ring(placement, side);
  const double height = ring.room >= (static_cast<double>(steps_of_room) - 0.5) * ray_step ? 1 : 0.5 * ring.room;
  if (ring.room < min_room || (height < 1 && ring.fan >= side.min_fan)) return;
  std::vector<std::int32_t> fan;
  const auto takes_part = [&](int end, int v) {
    const double l = placement.field.length_at_middle(mesh.at(end), mesh.at(v));
    return l < longest_lateral * height && l > narrowest_fan * height;
  };
  if (takes_part(side.a, ring.before)) fan.push_back(ring.before);
  int hint = ring.triangle;
  double spacing = 0;
  for (const Vec2& p : points_on(placement.field, ring, height, side, spacing)) {
    hint = mesh.locate(p, hint);
    if (hint < 0) {
      hint = mesh.vertices[side.a].triangle;
      continue;
    }
    const Metric2 metric = placement.field.at(p);
    const double least = min_room * std::min(spacing, height);
    if (!mesh.dig(p, metric, hint, {least * least, 0, 0, placement.degenerate_ends})) continue;
    fill_cavity(placement, p, metric, Bend::none);
    fan.push_back(static_cast<std::int32_t>(mesh.vertices.size()) - 1);
    hint = mesh.vertices.back().triangle;
  }
  if (takes_part(side.b, ring.after)) fan.push_back(ring.after);
  side.surrounded = freeze_fan(mesh, side, fan);
}

}  // namespace

void surround_degenerate_sides(Placement& placement, const PlaneDomain& domain) {
  for (const PlaneEdge& edge : domain.edges) {
    if (edge.kind != PlaneEdgeKind::degenerate) continue;
    placement.degenerate.push_back({edge.a, edge.b, edge.min_fan, edge.wide_fan});
    placement.degenerate_ends.insert(placement.degenerate_ends.end(), {edge.a, edge.b});
  }
  for (DegenerateSide& side : placement.degenerate) {
    placement.monitor.checkpoint();
    surround(placement, side);
  }
  placement.forget_touched();
}

}  // namespace carreau::plane
