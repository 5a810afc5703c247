// SPDX-License-Identifier: BSD-3-Clause
#include "plane/placement/insertion.h"

#include <algorithm>
#include <string>

#include "plane/kernel/thresholds.h"

namespace carreau::plane {

Placement::Placement(PlaneWork& work, std::int64_t triangle_limit)
    : mesh(work.mesh), field(work.field), shapes(work.shapes), monitor(work.monitor),
      max_triangles(std::min(triangle_limit, max_triangles_of_a_piece)) {
  if (field.bends()) mesh.bends.resize(mesh.vertices.size());
  for (int v = 0; v < static_cast<int>(mesh.vertices.size()); ++v) shapes.set_metric(v);
  const double expected = std::min(1.1 * std::max(field.measure(), 0.0) + static_cast<double>(mesh.triangles.size()),
                                   static_cast<double>(max_triangles));
  mesh.triangles.reserve(static_cast<std::size_t>(expected) + 1000);
  mesh.vertices.reserve(static_cast<std::size_t>(expected / 2) + 1000);
}

void judge(Placement& placement, int t) {
  Triangle& T = placement.mesh.triangles[t];
  if (T.done == Done::frozen) return;
  T.done = placement.shapes.squared_radius(t) < small_radius * small_radius ? Done::yes : Done::no;
}

void judge_all(Placement& placement) {
  for (int t = 0; t < static_cast<int>(placement.mesh.triangles.size()); ++t) judge(placement, t);
}

namespace {

bool near_degenerate_side(const Placement& placement, const Vec2& p, Metric2 metric) {
  const Triangulation& mesh = placement.mesh;
  for (const DegenerateSide& side : placement.degenerate) {
    if (side.surrounded) continue;
    const Vec2 a = mesh.at(side.a) - p, d = mesh.at(side.b) - mesh.at(side.a);
    const double l2 = squared_length(metric, d);
    const double s = l2 > 0 ? std::clamp(-dot(metric, a, d) / l2, 0.0, 1.0) : 0;
    if (squared_length(metric, a + s * d) < point_distance * point_distance) return true;
  }
  return false;
}

// Judges triangles by their circumradius in the metric of the point, whose lengths are at hand, and, if small enough,
// in the mean of their vertices. Uses charts if the field bends.
void judge_star(Placement& placement, int v, Metric2 metric) {
  constexpr double r2 = small_radius * small_radius;
  Triangulation& mesh = placement.mesh;
  const double four_det = 4 * determinant(metric);
  const RimEdge* const rim = mesh.rim().data();
  const auto star = mesh.star();
  const RimPoint* const points = &mesh.rim_point(0);
  const Vertex* const V = mesh.vertices.data();
  Triangle* const all = mesh.triangles.data();
  const bool bends = !mesh.bends.empty();
  const auto small = [](double a2, double b2, Vec2 a, Vec2 b, Metric2 m, double four_det_area2) {
    return a2 * b2 * squared_length(m, b - a) < r2 * four_det_area2;
  };
  for (std::size_t i = 0; i < star.size(); ++i) {
    const RimEdge& e = rim[i];
    const RimPoint &A = points[e.a], &B = points[e.b];
    Triangle& T = all[star[i]];
    placement.touch(star[i]);
    if (std::max(A.d2, B.d2) > 4 * r2) continue;
    if (bends && mesh.is_bent(v, A.v, B.v)) {
      judge(placement, star[i]);
      continue;
    }
    const Vec2 a{A.x, A.y}, b{B.x, B.y};
    if (!small(A.d2, B.d2, a, b, metric, four_det * e.area * e.area)) continue;
    const Metric2 m = (1.0 / 3) * (metric + V[A.v].metric() + V[B.v].metric());
    if (small(squared_length(m, a), squared_length(m, b), a, b, m, 4 * determinant(m) * e.area * e.area))
      T.done = Done::yes;
  }
}

}  // namespace

void fill_cavity(Placement& placement, Vec2 p, Metric2 metric, Bend bend) {
  Triangulation& mesh = placement.mesh;
  const auto v = static_cast<int>(mesh.vertices.size());
  mesh.vertices.emplace_back();
  mesh.vertices.back().x = p.x(), mesh.vertices.back().y = p.y();
  mesh.vertices.back().set_metric(metric);
  if (placement.field.bends()) mesh.bends.push_back(bend);
  mesh.fill(v);
  if (static_cast<std::int64_t>(mesh.triangles.size()) > placement.max_triangles)
    throw LimitError("the mesh of the plane domain has reached the limit of " +
                     std::to_string(placement.max_triangles) + " triangles");
  judge_star(placement, v, metric);
}

bool try_insert(Placement& placement, Vec2 p, int start, double distance) {
  placement.tick();
  const Metric2 metric = placement.field.at(p);
  if (near_degenerate_side(placement, p, metric)) return false;
  const InsertRules rules{distance * distance, imposed_height, point_distance, placement.degenerate_ends};
  Bend bend = Bend::none;
  if (placement.field.bends()) {
    const MetricSlopes slopes = placement.field.slopes(p);
    const Chart chart(p, slopes);
    bend = placement.field.bend(slopes, chart);
    if (!placement.mesh.dig(p, metric, start, rules, bend == Bend::smooth ? &chart : nullptr)) return false;
  } else if (!placement.mesh.dig(p, metric, start, rules)) {
    return false;
  }
  fill_cavity(placement, p, metric, bend);
  return true;
}

bool try_insert(Placement& placement, const Candidate& candidate, double distance) {
  const Triangulation& mesh = placement.mesh;
  const int t = candidate.edge >> 2, i = candidate.edge & 3;
  const bool is_edge = mesh.triangles[t].v[next3[i]] == candidate.a;
  const int start = mesh.locate(candidate.p, is_edge ? t : mesh.vertices[candidate.a].triangle);
  return start >= 0 && try_insert(placement, candidate.p, start, distance);
}

}  // namespace carreau::plane
