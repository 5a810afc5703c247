// SPDX-License-Identifier: BSD-3-Clause
#include "measure/mesh_evaluation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>

#include "cad/batches.h"
#include "cad/fundamental_forms.h"
#include "measure/base/degenerate_sides.h"
#include "measure/base/thresholds.h"
#include "measure/curve_evaluation.h"
#include "measure/deviation_bounds.h"
#include "measure/element_evaluation.h"
#include "measure/forced.h"
#include "mesh/distance/triangle_distance.h"
#include "mesh/quality.h"
#include "metric/field_length.h"
#include "metric/unit_edge.h"
#include "support/gauss.h"
#include "support/infinity.h"

namespace carreau {

namespace {

using namespace thresholds::measure;


double degrees(double radians) noexcept { return radians * 180 / std::numbers::pi; }
double angle_between(const Vec3& p, const Vec3& q) noexcept { return std::atan2(norm(cross(p, q)), dot(p, q)); }

/// Evaluates jets and metrics at points of a face, a batch at a time, in the order in which they were added.
class Sampler {
 public:
  Sampler(Cad& cad, const PrescribedMetric& prescribed, Monitor& monitor)
      : cad_(cad), prescribed_(prescribed), monitor_(monitor) {}

  /// use(rank, jet, metric) for each point.
  template <typename Use>
  void run(int face, int ref, unsigned want, std::span<const Vec2> uv, const Use& use) {
    const auto prescribe = [&](std::size_t first, std::span<const Vec2> here, std::span<const SurfaceJet> jets) {
      metrics_.resize(here.size());
      prescribed_.at(face, here, jets, metrics_);
      for (std::size_t k = 0; k < here.size(); ++k) use(first + k, jets[k], metrics_[k]);
    };
    for_batches(cad_, ref, want | prescribed_.wants | want_first, uv, monitor_, prescribe);
  }

 private:
  Cad& cad_;
  const PrescribedMetric& prescribed_;
  Monitor& monitor_;
  std::vector<Metric2> metrics_;
};

class Measurement {
 public:
  Measurement(const SurfaceMesh& mesh, Cad& cad, const PrescribedMetric& prescribed, const EvaluationOptions& options,
              Monitor& monitor)
      : mesh_(mesh),
        options_(options),
        monitor_(monitor),
        gauss_(gauss_rule(options.gauss_points)),
        cad_(cad),
        sampler_(cad, prescribed, monitor),
        edges_(result_.edges) {}

  MeshEvaluation run() {
    edges_ = edges_of(mesh_);
    const std::size_t n = edges_.vertices.size(), m = edges_.of_triangle.size();
    of(EvaluationKind::length).assign(n, 0);
    of(EvaluationKind::edge_angle).assign(n, nan);
    of(EvaluationKind::gradation).assign(n, nan);
    for (const EvaluationKind kind : {EvaluationKind::q1, EvaluationKind::q2, EvaluationKind::metric_quality,
                                      EvaluationKind::deviation, EvaluationKind::angle, EvaluationKind::vertex_angle})
      of(kind).assign(m, 0);
    for (const EvaluationKind kind : {EvaluationKind::deviation_bound, EvaluationKind::angle_bound, EvaluationKind::bound_share,
                                      EvaluationKind::input_bound})
      of(kind).assign(m, nan);
    find_neighbours();
    above_.resize(n * gauss_.node.size());
    shortest_.assign(mesh_.vertices.size(), infinity);
    longest_.assign(mesh_.vertices.size(), 0);
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      face_index_ = static_cast<int>(f);
      face_ = &mesh_.faces[f];
      monitor_.progress(Phase::measure, face_->ref, m > 0 ? static_cast<double>(first_) / static_cast<double>(m) : 0);
      if (!face_->triangles.empty()) measure_face();
      first_ += face_->triangles.size();
    }
    measure_spread();
    share_deviations();
    compare_lengths();
    return std::move(result_);
  }

 private:
  std::vector<double>& of(EvaluationKind kind) { return result_[kind].values; }
  void raise(EvaluationKind kind, std::size_t place, double value) {
    double& known = of(kind)[place];
    known = std::max(known, value);
  }
  [[nodiscard]] double distance(const Vec3& p, std::size_t triangle) const {
    const auto& c = triangle_[triangle];
    return distance_to_triangle(p, mesh_.vertices[c[0]], mesh_.vertices[c[1]], mesh_.vertices[c[2]]);
  }
  [[nodiscard]] Vec3 position(std::int32_t local) const { return mesh_.vertices[face_->vertex[local]]; }
  [[nodiscard]] std::array<Vec3, 3> corners(std::size_t t) const {
    const auto& c = face_->triangles[t];
    return {position(c[0]), position(c[1]), position(c[2])};
  }

  void find_neighbours() {
    triangle_.reserve(edges_.of_triangle.size());
    for (const FaceMesh& face : mesh_.faces)
      for (const auto& t : face.triangles)
        triangle_.push_back({face.vertex[t[0]], face.vertex[t[1]], face.vertex[t[2]]});
    beside_.assign(edges_.vertices.size(), {-1, -1});
    for (std::size_t t = 0; t < triangle_.size(); ++t)
      for (const std::int32_t edge : edges_.of_triangle[t])
        if (edges_.segment[edge] < 0) beside_[edge][beside_[edge][0] < 0 ? 0 : 1] = static_cast<std::int32_t>(t);
  }

  void measure_face() {
    degenerate_ = DegenerateSides(*face_, face_index_);
    measure_vertices();
    measure_edges();
    measure_triangles();
  }

  // Normals at the vertices, and metrics along edges that end there.
  void measure_vertices() {
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

  void set_vertex(std::size_t v, const SurfaceJet& jet, const Metric2& metric) {
    normal_[v] = unit_normal(jet);
    at_vertex_[v] = {jet.su, jet.sv, metric};
  }

  // The size that is prescribed along d at a vertex; NaN at a singular one.
  [[nodiscard]] double size_along(std::int32_t v, const Vec2& d) const {
    return size_along(v, d, at_vertex_[v].metric);
  }
  [[nodiscard]] double size_along(std::int32_t v, const Vec2& d, Metric2 metric) const {
    return normal_[v] ? norm(d.x() * at_vertex_[v].su + d.y() * at_vertex_[v].sv) / length(metric, d) : nan;
  }

  // The size of the circle of the same area as the unit ellipse of the tangent plane at a vertex.
  [[nodiscard]] double geometric_mean_size(std::int32_t v) const {
    const AtVertex& place = at_vertex_[v];
    return std::sqrt(norm(cross(place.su, place.sv)) / std::sqrt(determinant(place.metric)));
  }

  // Sizes at the ends of an edge that lies on a curve, when they are known.
  [[nodiscard]] std::optional<std::array<double, 2>> curve_sizes(std::int32_t edge, std::int32_t from) const {
    if (edges_.segment[edge] < 0 || options_.curve_size.empty()) return {};
    const auto [curve, rank] = edges_.segments[edges_.segment[edge]];
    const std::vector<double>& size = options_.curve_size[curve];
    if (size.size() < static_cast<std::size_t>(rank) + 2 || !(size[rank] > 0) || !(size[rank + 1] > 0)) return {};
    if (mesh_.curves[curve].vertices[rank] == from) return std::array{size[rank], size[rank + 1]};
    return std::array{size[rank + 1], size[rank]};
  }

  // A side of a triangle whose points are evaluated: each edge once, edges on curves from every side.
  struct Side {
    std::size_t triangle;  // of the mesh
    std::int32_t edge, a, b;
    bool measured;  // here
    Vec2 from, to;  // of the edge in (u, v)
  };

  // The edge from a to b, straight to a pole.
  [[nodiscard]] std::array<Vec2, 2> ends(std::int32_t a, std::int32_t b) const {
    Vec2 p = face_->uv[a], q = face_->uv[b];
    if (normal_[a] && !normal_[b]) q = arrival(b, a);
    if (normal_[b] && !normal_[a]) p = arrival(a, b);
    return {p, q};
  }
  // End point of the way from vertex `a` at a pole.
  [[nodiscard]] Vec2 arrival(std::int32_t pole, std::int32_t a) const {
    const AtVertex& from = at_vertex_[a];
    const Vec3 chord = position(pole) - position(a);
    const AtVertex& there = at_vertex_[pole];
    return degenerate_.arrival(pole, {there.su, there.sv}, face_->uv[a], {from.su, from.sv}, chord).value_or(face_->uv[pole]);
  }

  // The corners of a triangle in (u, v). A corner at a pole lies between the arrivals of the ways from the other two:
  // the end of the side that represents the pole may be far away, with arbitrary normals between.
  [[nodiscard]] std::array<Vec2, 3> places(std::size_t t) const {
    const auto& c = face_->triangles[t];
    std::array<Vec2, 3> place{face_->uv[c[0]], face_->uv[c[1]], face_->uv[c[2]]};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = c[(i + 1) % 3], b = c[(i + 2) % 3];
      if (!normal_[c[i]] && normal_[a] && normal_[b]) place[i] = 0.5 * (arrival(c[i], a) + arrival(c[i], b));
    }
    return place;
  }

  [[nodiscard]] std::vector<Side> own_sides() {
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

  void measure_edges() {
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

  void raise_edge_angle(std::int32_t edge, std::int32_t a, std::int32_t b) {
    const Vec3 d = position(b) - position(a);
    const double l = norm(d);
    double& angle = of(EvaluationKind::edge_angle)[edge];
    for (const std::int32_t v : {a, b}) {
      if (!normal_[v] || !(l > 0)) continue;
      const double here = degrees(std::asin(std::min(1.0, std::abs(dot(d, *normal_[v])) / l)));
      if (!(angle >= here)) angle = here;
    }
  }

  // Adds an edge to the comparison at its end `a`.
  void note_lengths(std::size_t t, std::int32_t a, std::int32_t b) {
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

  [[nodiscard]] const ControlSpace* governing_space() const {
    const auto f = static_cast<std::size_t>(face_index_);
    return f < options_.spaces.size() && options_.spaces[f] ? &*options_.spaces[f] : nullptr;
  }

  // The offset in (u, v) that leads along a chord, in the tangent plane of a vertex.
  [[nodiscard]] Vec2 offset_along(std::int32_t v, const Vec3& chord) const {
    const AtVertex& at = at_vertex_[v];
    const double e = dot(at.su, at.su), f = dot(at.su, at.sv), g = dot(at.sv, at.sv), det = e * g - f * f;
    const double p = dot(at.su, chord), q = dot(at.sv, chord);
    return {(g * p - f * q) / det, (e * q - f * p) / det};
  }

  // Along the chord: the image of a segment of (u, v) turns as the parametrisation does.
  void set_gradation(std::int32_t edge, std::int32_t a, std::int32_t b) {
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

  void measure_triangles() {
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

  // Triangles whose corners are of several charts: over their places in space.
  void measure_spread() {
    if (options_.atlas.charts == nullptr) return;
    static const std::array<Barycentric, 7> rule = triangle_rule();
    std::vector<std::array<double, 3>> weights;
    for (const Barycentric& w : rule) weights.push_back({w.a, w.b, w.c});
    const std::vector<SpreadSample> samples =
        spread_samples(mesh_, options_.atlas, cad_, gauss_.node, weights, monitor_);
    for (std::size_t k = 0, n = 0; k < samples.size(); k += n) {
      for (n = 1; k + n < samples.size() && samples[k + n].face == samples[k].face;) ++n;
      const std::span<const SpreadSample> here = std::span(samples).subspan(k, n);
      if (here.front().face < 0) {
        for (const SpreadSample& s : here) note_above(s, s.flat);
        continue;
      }
      std::vector<Vec2> uv;
      for (const SpreadSample& s : here) uv.push_back(s.uv);
      sampler_.run(here.front().face, mesh_.faces[here.front().face].ref, want_position | want_first, uv,
                   [&](std::size_t i, const SurfaceJet& jet, const Metric2& metric) { note(here[i], jet, metric); });
    }
    std::size_t last = samples.size();
    for (const SpreadSample& s : samples)
      if (s.triangle != last) finish_by_lengths(last = s.triangle);
    finish_beside_spread();
  }

  // Triangles of (u, v) with edges that were measured with a spread neighbour, after them.
  void finish_beside_spread() {
    std::vector<char> late(edges_.segment.size(), 0);
    std::vector<std::size_t> plain;
    std::size_t place = 0;
    for (const FaceMesh& face : mesh_.faces)
      for (std::size_t t = 0; t < face.triangles.size(); ++t, ++place) {
        if (!face.is_spread(t)) plain.push_back(place);
        for (std::size_t i = 0; i < 3 && face.is_spread(t); ++i)
          if (edges_.names[place][i] != 0) late[static_cast<std::size_t>(edges_.of_triangle[place][i])] = 1;
      }
    for (const std::size_t t : plain)
      for (const std::int32_t edge : edges_.of_triangle[t])
        if (late[static_cast<std::size_t>(edge)] != 0) {
          finish_by_lengths(t);
          break;
        }
  }

  void note_above(const SpreadSample& s, const Vec3& p) {
    if (s.side < 0) return raise_deviation(s.triangle, p);
    const std::int32_t edge = edges_.of_triangle[s.triangle][s.side];
    if (edges_.segment[edge] >= 0) return raise_deviation(s.triangle, p);
    if (edges_.names[s.triangle][s.side] != 0)
      above_[static_cast<std::size_t>(edge) * gauss_.node.size() + static_cast<std::size_t>(s.rank)] = p;
  }

  void note(const SpreadSample& s, const SurfaceJet& jet, const Metric2& metric) {
    note_above(s, jet.s);
    const auto& c = triangle_[s.triangle];
    const std::array<Vec3, 3> p{mesh_.vertices[c[0]], mesh_.vertices[c[1]], mesh_.vertices[c[2]]};
    if (s.side < 0) {
      auto normal = unit_normal(jet);
      if (normal && s.turned) normal = -*normal;
      return raise_angle(s.triangle, p, normal);
    }
    if (edges_.names[s.triangle][s.side] == 0) return;
    const Vec3 chord = p[(s.side + 1) % 3] - p[s.side];
    const double l = norm(chord);
    double size = 0;
    const std::int32_t edge = edges_.of_triangle[s.triangle][s.side];
    if (const auto h = curve_sizes(edge, c[s.side])) {
      size = interpolate_size(options_.law, (*h)[0], (*h)[1], gauss_.node[s.rank]);
    } else {
      const double e = dot(jet.su, jet.su), f = dot(jet.su, jet.sv), g = dot(jet.sv, jet.sv);
      const double x = dot(jet.su, chord), y = dot(jet.sv, chord);
      const Vec2 way{g * x - f * y, e * y - f * x};
      size = norm(way.x() * jet.su + way.y() * jet.sv) / length(metric, way);
    }
    of(EvaluationKind::length)[edge] += gauss_.weight[s.rank] * l / size;
  }

  // Heron's formula.
  void finish_by_lengths(std::size_t place) {
    std::array<double, 3> l{};
    for (std::size_t i = 0; i < 3; ++i) l[i] = of(EvaluationKind::length)[edges_.of_triangle[place][i]];
    const double s = (l[0] + l[1] + l[2]) / 2, squares = l[0] * l[0] + l[1] * l[1] + l[2] * l[2];
    const double area = std::sqrt(std::max(0.0, s * (s - l[0]) * (s - l[1]) * (s - l[2])));
    of(EvaluationKind::metric_quality)[place] =
        squares > 0 ? std::min(1.0, 4 * std::numbers::sqrt3 * area / squares) : 0;
  }

  // The image of a triangle of (u, v) may reach beyond the triangle in space, far beyond it at a pole. Such points lie
  // above a neighbour, or its neighbour: walks while the distance decreases.
  [[nodiscard]] double distance_to_mesh(const Vec3& s, std::size_t triangle) const {
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

  void raise_deviation(std::size_t place, Vec3 s) {
    if (distance(s, place) > of(EvaluationKind::deviation)[place])
      raise(EvaluationKind::deviation, place, distance_to_mesh(s, place));
  }

  void raise_angle(std::size_t place, const std::array<Vec3, 3>& p, const std::optional<Vec3>& normal) {
    if (normal) raise(EvaluationKind::angle, place, degrees(angle_between(cross(p[1] - p[0], p[2] - p[0]), *normal)));
  }

  void start_triangle(std::size_t t) {
    const std::array<Vec3, 3> p = corners(t);
    of(EvaluationKind::q1)[first_ + t] = quality_q1(p[0], p[1], p[2]);
    of(EvaluationKind::q2)[first_ + t] = quality_q2(p[0], p[1], p[2]);
    for (const std::int32_t v : face_->triangles[t]) raise_angle(first_ + t, p, normal_[v]);
    of(EvaluationKind::vertex_angle)[first_ + t] = of(EvaluationKind::angle)[first_ + t];
  }

  void finish_quality(std::size_t t) {
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

  // A point above an edge belongs to both triangles beside it: its distance is the smaller one.
  void share_deviations() {
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

  void compare_lengths() {
    std::vector<double>& ratio = of(EvaluationKind::length_ratio);
    ratio.resize(mesh_.vertices.size());
    for (std::size_t v = 0; v < ratio.size(); ++v) ratio[v] = longest_[v] > 0 ? longest_[v] / shortest_[v] : nan;
  }

  struct AtVertex {
    Vec3 su, sv;
    Metric2 metric;
  };

  const SurfaceMesh& mesh_;
  const EvaluationOptions& options_;
  Monitor& monitor_;
  GaussRule gauss_;
  Cad& cad_;
  Sampler sampler_;
  MeshEvaluation result_;
  MeshEdges& edges_;
  std::vector<std::array<std::int32_t, 3>> triangle_;  // vertices of the mesh
  std::vector<std::array<std::int32_t, 2>> beside_;    // by edge inside a face: its triangles, or -1
  std::vector<Vec3> above_;                            // by edge and Gauss point
  std::vector<double> shortest_, longest_;             // edges, by vertex
  // The current face.
  int face_index_ = 0;
  const FaceMesh* face_ = nullptr;
  std::size_t first_ = 0;  // triangle of the mesh
  DegenerateSides degenerate_;
  std::vector<std::optional<Vec3>> normal_;
  std::vector<AtVertex> at_vertex_;
};

CallCounts difference(const CallCounts& p, const CallCounts& q) {
  return {p.surf0 - q.surf0, p.surf1 - q.surf1, p.surf2 - q.surf2, p.curv0 - q.curv0,
          p.curv1 - q.curv1, p.curv2 - q.curv2, p.sizes - q.sizes};
}

}  // namespace

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
