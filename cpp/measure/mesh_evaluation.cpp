// SPDX-License-Identifier: BSD-3-Clause
#include "measure/mesh_evaluation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>

#include "measure/curve_evaluation.h"
#include "measure/deviation_bounds.h"
#include "measure/element_evaluation.h"
#include "measure/forced.h"
#include "measure/measurement.h"
#include "metric/field_length.h"
#include "metric/unit_edge.h"
#include "support/infinity.h"

namespace carreau {

namespace {

double degrees(double radians) noexcept { return radians * 180 / std::numbers::pi; }
double angle_between(const Vec3& p, const Vec3& q) noexcept { return std::atan2(norm(cross(p, q)), dot(p, q)); }

CallCounts difference(const CallCounts& p, const CallCounts& q) {
  return {p.surf0 - q.surf0, p.surf1 - q.surf1, p.surf2 - q.surf2, p.curv0 - q.curv0,
          p.curv1 - q.curv1, p.curv2 - q.curv2, p.sizes - q.sizes};
}

}  // namespace

void Measurement::find_neighbours() {
  triangle_.reserve(edges_.of_triangle.size());
  for (const FaceMesh& face : mesh_.faces)
    for (const auto& t : face.triangles)
      triangle_.push_back({face.vertex[t[0]], face.vertex[t[1]], face.vertex[t[2]]});
  beside_.assign(edges_.vertices.size(), {-1, -1});
  for (std::size_t t = 0; t < triangle_.size(); ++t)
    for (const std::int32_t edge : edges_.of_triangle[t])
      if (edges_.segment[edge] < 0) beside_[edge][beside_[edge][0] < 0 ? 0 : 1] = static_cast<std::int32_t>(t);
}

void Measurement::measure_face() {
  degenerate_ = DegenerateSides(*face_, face_index_);
  measure_vertices();
  measure_edges();
  measure_triangles();
}

void Measurement::measure_vertices() {
  const std::vector<Vec2>& uv = face_->uv;
  normal_.assign(uv.size(), std::nullopt);
  at_vertex_.resize(uv.size());
  if (face_->uv_face.empty()) {
    sampler_.run(face_index_, face_->ref, want_first, uv,
                 [&](std::size_t v, const SurfaceJet& jet, const Metric2& metric) { set_vertex(v, jet, metric); });
    return;
  }
  // Each in the face that it is of.
  std::vector<std::int32_t> faces = face_->uv_face;
  std::ranges::sort(faces);
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  for (const std::int32_t f : faces) {
    std::vector<std::size_t> locals;
    std::vector<Vec2> here;
    for (std::size_t v = 0; v < uv.size(); ++v)
      if (face_->uv_face[v] == f) locals.push_back(v), here.push_back(uv[v]);
    sampler_.run(f, mesh_.faces[f].ref, want_first, here,
                 [&](std::size_t k, const SurfaceJet& jet, const Metric2& metric) {
                   set_vertex(locals[k], jet, metric);
                 });
  }
  for (std::size_t v = 0; v < uv.size(); ++v)
    if (normal_[v] && options_.atlas.is_turned(face_index_, options_.atlas.feet[face_index_][v])) normal_[v] = -*normal_[v];
}

std::optional<std::array<double, 2>> Measurement::curve_sizes(std::int32_t edge, std::int32_t from) const {
  if (edges_.segment[edge] < 0 || options_.curve_size.empty()) return {};
  const auto [curve, rank] = edges_.segments[edges_.segment[edge]];
  const std::vector<double>& size = options_.curve_size[curve];
  if (size.size() < static_cast<std::size_t>(rank) + 2 || !(size[rank] > 0) || !(size[rank + 1] > 0)) return {};
  if (mesh_.curves[curve].vertices[rank] == from) return std::array{size[rank], size[rank + 1]};
  return std::array{size[rank + 1], size[rank]};
}

std::array<Vec2, 2> Measurement::ends(std::int32_t a, std::int32_t b) const {
  Vec2 p = face_->uv[a], q = face_->uv[b];
  if (normal_[a] && !normal_[b]) q = arrival(b, a);
  if (normal_[b] && !normal_[a]) p = arrival(a, b);
  return {p, q};
}

Vec2 Measurement::arrival(std::int32_t pole, std::int32_t a) const {
  const AtVertex& from = at_vertex_[a];
  const Vec3 chord = position(pole) - position(a);
  const AtVertex& there = at_vertex_[pole];
  return degenerate_.arrival(pole, {there.su, there.sv}, face_->uv[a], {from.su, from.sv}, chord).value_or(face_->uv[pole]);
}

std::array<Vec2, 3> Measurement::places(std::size_t t) const {
  const auto& c = face_->triangles[t];
  std::array<Vec2, 3> place{face_->uv[c[0]], face_->uv[c[1]], face_->uv[c[2]]};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int32_t a = c[(i + 1) % 3], b = c[(i + 2) % 3];
    if (!normal_[c[i]] && normal_[a] && normal_[b]) place[i] = 0.5 * (arrival(c[i], a) + arrival(c[i], b));
  }
  return place;
}

std::vector<Measurement::Side> Measurement::own_sides() {
  std::vector<Side> own;
  for (std::size_t t = 0; t < face_->triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = face_->triangles[t][i], b = face_->triangles[t][(i + 1) % 3];
      const std::int32_t edge = edges_.of_triangle[first_ + t][i];
      const bool measured = edges_.names[first_ + t][i] != 0;
      raise_edge_angle(edge, a, b);
      note_lengths(t, a, b);
      note_lengths(t, b, a);
      if (face_->is_spread(t) || (!measured && edges_.segment[edge] < 0)) continue;
      const auto [from, to] = ends(a, b);
      own.push_back({first_ + t, edge, a, b, measured, from, to});
    }
  return own;
}

void Measurement::measure_edges() {
  const std::vector<Side> own = own_sides();
  const std::size_t n = gauss_.node.size();
  std::vector<Vec2> uv;
  uv.reserve(n * own.size());
  for (const Side& o : own)
    for (const double s : gauss_.node) uv.push_back(lerp(o.from, o.to, s));
  sampler_.run(face_index_, face_->ref, want_position | want_first, uv,
               [&](std::size_t k, const SurfaceJet& jet, const Metric2& metric) {
                 const Side& o = own[k / n];
                 const Vec2 d = o.to - o.from;
                 if (edges_.segment[o.edge] < 0)
                   above_[static_cast<std::size_t>(o.edge) * n + k % n] = jet.s;
                 else
                   raise_deviation(o.triangle, jet.s);
                 if (!o.measured) return;
                 double speed = length(metric, d);
                 if (const auto h = curve_sizes(o.edge, face_->vertex[o.a]))
                   speed = norm(d.x() * jet.su + d.y() * jet.sv) /
                           interpolate_size(options_.law, (*h)[0], (*h)[1], gauss_.node[k % n]);
                 of(EvaluationKind::length)[o.edge] += gauss_.weight[k % n] * speed;
               });
  for (const Side& o : own)
    if (o.measured) set_gradation(o.edge, o.a, o.b);
}

void Measurement::raise_edge_angle(std::int32_t edge, std::int32_t a, std::int32_t b) {
  const Vec3 d = position(b) - position(a);
  const double l = norm(d);
  double& angle = of(EvaluationKind::edge_angle)[edge];
  for (const std::int32_t v : {a, b}) {
    if (!normal_[v] || !(l > 0)) continue;
    const double here = degrees(std::asin(std::min(1.0, std::abs(dot(d, *normal_[v])) / l)));
    if (!(angle >= here)) angle = here;
  }
}

void Measurement::note_lengths(std::size_t t, std::int32_t a, std::int32_t b) {
  double l = norm(position(b) - position(a));
  // At a singular vertex, directions of (u, v) have no direction in space: the lengths are compared unscaled.
  const auto along = [&]() -> Vec2 {
    return face_->is_spread(t) ? offset_along(a, position(b) - position(a)) : Vec2(face_->uv[b] - face_->uv[a]);
  };
  const double stretch = normal_[a] ? geometric_mean_size(a) / size_along(a, along()) : 1;
  if (stretch > 0 && std::isfinite(stretch)) l *= stretch;
  const std::int32_t v = face_->vertex[a];
  shortest_[v] = std::min(shortest_[v], l);
  longest_[v] = std::max(longest_[v], l);
}

Vec2 Measurement::offset_along(std::int32_t v, const Vec3& chord) const {
  const AtVertex& at = at_vertex_[v];
  const double e = dot(at.su, at.su), f = dot(at.su, at.sv), g = dot(at.sv, at.sv), det = e * g - f * f;
  const double p = dot(at.su, chord), q = dot(at.sv, chord);
  return {(g * p - f * q) / det, (e * q - f * p) / det};
}

void Measurement::set_gradation(std::int32_t edge, std::int32_t a, std::int32_t b) {
  const Vec2 from = face_->uv[a], to = face_->uv[b];
  const Vec3 chord = position(b) - position(a);
  const Vec2 at_a = offset_along(a, chord), at_b = offset_along(b, chord);
  double p = size_along(a, at_a), q = size_along(b, at_b), l = of(EvaluationKind::length)[edge];
  if (const auto h = curve_sizes(edge, face_->vertex[a])) {
    p = (*h)[0], q = (*h)[1];
  } else if (const ControlSpace* space = governing_space()) {
    p = size_along(a, at_a, space->at(from)), q = size_along(b, at_b, space->at(to));
    l = field_length([space](Vec2 uv) { return space->at(uv); }, from, to, unit_edge::finest);
  }
  if (!(p > 0) || !(q > 0) || !(l > 0)) return;
  of(EvaluationKind::gradation)[edge] = std::pow(std::max(p / q, q / p), 1 / std::max(l, unit_edge::finest));
}

void Measurement::measure_triangles() {
  static const std::array<Barycentric, 7> rule = triangle_rule();
  std::vector<Vec2> uv;
  uv.reserve(rule.size() * face_->triangles.size());
  std::vector<std::size_t> plain;  // triangles of (u, v)
  for (std::size_t t = 0; t < face_->triangles.size(); ++t) {
    if (face_->is_spread(t)) continue;
    plain.push_back(t);
    const std::array<Vec2, 3> p = places(t);
    for (const Barycentric& w : rule) uv.push_back(w.a * p[0] + w.b * p[1] + w.c * p[2]);
  }
  for (std::size_t t = 0; t < face_->triangles.size(); ++t) start_triangle(t);
  sampler_.run(face_index_, face_->ref, want_position | want_first, uv,
               [&](std::size_t k, const SurfaceJet& jet, const Metric2& metric) {
                 const std::size_t t = plain[k / rule.size()], place = first_ + t;
                 const std::array<Vec3, 3> p = corners(t);
                 raise_deviation(place, jet.s);
                 raise_angle(place, p, unit_normal(jet));
                 // Area in the metric, in units of the triangle of (u, v).
                 of(EvaluationKind::metric_quality)[place] +=
                     rule[k % rule.size()].weight * std::sqrt(std::max(determinant(metric), 0.0));
               });
  for (const std::size_t t : plain) finish_quality(t);
}

double Measurement::distance_to_mesh(const Vec3& s, std::size_t triangle) const {
  double d = distance(s, triangle);
  for (bool nearer = true; nearer;) {
    nearer = false;
    for (const std::int32_t edge : edges_.of_triangle[triangle])
      for (const std::int32_t other : beside_[edge]) {
        const double there = other >= 0 ? distance(s, other) : d;
        if (there >= d) continue;
        d = there;
        triangle = static_cast<std::size_t>(other);
        nearer = true;
      }
  }
  return d;
}

void Measurement::start_triangle(std::size_t t) {
  const std::array<Vec3, 3> p = corners(t);
  of(EvaluationKind::q1)[first_ + t] = quality_q1(p[0], p[1], p[2]);
  of(EvaluationKind::q2)[first_ + t] = quality_q2(p[0], p[1], p[2]);
  for (const std::int32_t v : face_->triangles[t]) raise_angle(first_ + t, p, normal_[v]);
  of(EvaluationKind::vertex_angle)[first_ + t] = of(EvaluationKind::angle)[first_ + t];
}

void Measurement::finish_quality(std::size_t t) {
  const auto& c = face_->triangles[t];
  std::array<double, 3> l{};
  for (std::size_t i = 0; i < 3; ++i) l[i] = of(EvaluationKind::length)[edges_.of_triangle[first_ + t][i]];
  const double squares = l[0] * l[0] + l[1] * l[1] + l[2] * l[2];
  double area = 0.5 * cross(face_->uv[c[1]] - face_->uv[c[0]], face_->uv[c[2]] - face_->uv[c[0]]);
  double& quality = of(EvaluationKind::metric_quality)[first_ + t];
  area *= quality;
  // At a pole the triangle of (u, v) differs: a triangle with these lengths replaces it (Heron's formula).
  if (!normal_[c[0]] || !normal_[c[1]] || !normal_[c[2]]) {
    const double s = (l[0] + l[1] + l[2]) / 2;
    area = std::sqrt(std::max(0.0, s * (s - l[0]) * (s - l[1]) * (s - l[2])));
  }
  // HDR eq. 1.6 with the metric's area and lengths; in a metric that varies no flat triangle may have them.
  quality = squares > 0 ? std::min(1.0, 4 * std::numbers::sqrt3 * area / squares) : 0;
}

void Measurement::raise_angle(std::size_t place, const std::array<Vec3, 3>& p, const std::optional<Vec3>& normal) {
  if (normal) raise(EvaluationKind::angle, place, degrees(angle_between(cross(p[1] - p[0], p[2] - p[0]), *normal)));
}

void Measurement::share_deviations() {
  const std::size_t n = gauss_.node.size();
  for (std::size_t edge = 0; edge < beside_.size(); ++edge) {
    const auto [p, q] = beside_[edge];
    if (p < 0) continue;
    for (std::size_t k = edge * n; k < (edge + 1) * n; ++k) {
      double d = distance_to_mesh(above_[k], p);
      if (q >= 0 && d > 0) d = std::min(d, distance_to_mesh(above_[k], q));
      raise(EvaluationKind::deviation, p, d);
      if (q >= 0) raise(EvaluationKind::deviation, q, d);
    }
  }
}

MeshEvaluation evaluate_mesh(const SurfaceMesh& mesh, Cad& cad, const PrescribedMetric& prescribed,
                             const EvaluationOptions& options, Monitor& monitor) {
  const auto start = std::chrono::steady_clock::now();
  const CallCounts before = cad.counts();
  MeshEvaluation d = Measurement(mesh, cad, prescribed, options, monitor).run();
  evaluate_elements(mesh, cad, prescribed, options.atlas, monitor, d);
  evaluate_curves(mesh, cad, options.curve_parameters, monitor, d);
  if (options.bounds) bound_deviations(mesh, cad, options, monitor, d);
  for (const EvaluationKind kind : {EvaluationKind::edge_angle, EvaluationKind::curve_angle, EvaluationKind::vertex_angle})
    d[kind].limit = options.edge_angle_limit;
  d[EvaluationKind::curve_deviation].limit = options.deviation_limit;
  d[EvaluationKind::gradation].limit = options.gradation_limit;
  d[EvaluationKind::length_ratio].limit = options.length_ratio_limit;
  d[EvaluationKind::deviation].limit = options.deviation_limit;
  d[EvaluationKind::bound_share].limit = options.bound_share_limit;
  summarise(d);
  count_forced(mesh, options.shortest_for_angle, d);
  d.calls = difference(cad.counts(), before);
  d.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return d;
}

}  // namespace carreau
