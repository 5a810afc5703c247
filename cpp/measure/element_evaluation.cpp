// SPDX-License-Identifier: BSD-3-Clause
#include "measure/element_evaluation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "cad/batches.h"
#include "cad/fundamental_forms.h"
#include "mesh/elements/cell_quality.h"
#include "mesh/elements/jacobian.h"
#include "support/infinity.h"
#include "surface/remesh/bounds/thresholds.h"

namespace carreau {

namespace {

/// Places in an element: its middle first, then points inside and on its sides.
std::vector<Vec2> sample_places(bool quad) {
  std::vector<Vec2> places{quad ? Vec2{0.5, 0.5} : Vec2{1.0 / 3, 1.0 / 3}};
  constexpr int n = 6;
  for (int i = 0; i <= n; ++i)
    for (int k = 0; k <= (quad ? n : n - i); ++k) {
      const bool corner = (i == 0 || i == n) && (k == 0 || k == n);
      if (!corner) places.push_back({static_cast<double>(i) / n, static_cast<double>(k) / n});
    }
  return places;
}

/// An element's map and its derivatives, by differences, which are exact for degree 2.
struct ElementMap {
  CellKind kind;
  std::span<const Vec3> x;

  [[nodiscard]] Vec3 at(const Vec2& p) const { return point_of_cell(kind, x, p.x(), p.y()); }
  [[nodiscard]] std::array<Vec3, 2> slopes(const Vec2& p) const {
    constexpr double d = 0.25;
    return {(1 / (2 * d)) * (at({p.x() + d, p.y()}) - at({p.x() - d, p.y()})),
            (1 / (2 * d)) * (at({p.x(), p.y() + d}) - at({p.x(), p.y() - d}))};
  }
  /// Distance of a point from the element, by Gauss and Newton from a place nearby.
  [[nodiscard]] double distance(const Vec3& s, Vec2 p) const {
    double best = norm(s - at(p));
    for (int step = 0; step < 3; ++step) {
      const auto [a, b] = slopes(p);
      const Vec3 d = s - at(p);
      const double e = dot(a, a), f = dot(a, b), g = dot(b, b), det = e * g - f * f;
      if (!(det > 0)) break;
      const double da = dot(a, d), db = dot(b, d);
      p = clamped(p + (1 / det) * Vec2{g * da - f * db, e * db - f * da});
      best = std::min(best, norm(s - at(p)));
    }
    return best;
  }
  [[nodiscard]] Vec2 clamped(Vec2 p) const {
    p = {std::clamp(p.x(), 0.0, 1.0), std::clamp(p.y(), 0.0, 1.0)};
    const double beyond = p.x() + p.y() - 1;
    if (corner_count(kind) == 3 && beyond > 0) p -= Vec2{beyond / 2, beyond / 2};
    return p;
  }
};

class ElementEvaluation {
 public:
  ElementEvaluation(const SurfaceMesh& mesh, Cad& cad, const PrescribedMetric& prescribed, const SpreadAtlas& atlas,
                    Monitor& monitor, MeshEvaluation& delivered)
      : mesh_(mesh), cad_(cad), prescribed_(prescribed), atlas_(atlas), monitor_(monitor), delivered_(delivered) {}

  void run() {
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      face_ = &mesh_.faces[f];
      for (const bool quad : {true, false}) measure(static_cast<int>(f), quad);
      if (atlas_.charts != nullptr) measure_spread(f);
      drop_diagonals();
      first_ += face_->triangles.size();
    }
  }

 private:
  std::vector<double>& of(EvaluationKind kind) { return delivered_[kind].values; }

  struct Placed {
    Cell cell;
    std::size_t triangle;  // of the mesh, the first one
    std::array<Vec3, 8> uv, xyz;
  };

  // The quadrilaterals or triangles of (u, v), or the spread ones.
  [[nodiscard]] std::vector<Placed> elements(bool quad, bool spread) const {
    std::vector<Placed> placed;
    const auto corners = static_cast<std::int32_t>(face_->uv.size());
    std::size_t t = first_;
    for (const Cell& cell : local_cells(*face_)) {
      const int n = corner_count(cell.kind);
      if ((n == 4) == quad && cell.kind != CellKind::triangle3 && face_->is_spread(t - first_) == spread) {
        Placed& p = placed.emplace_back();
        p.cell = cell, p.triangle = t;
        for (std::size_t i = 0; i < static_cast<std::size_t>(node_count(cell.kind)); ++i) {
          const std::int32_t node = cell.nodes[i], mid = node - corners;
          const Vec2& uv = mid < 0 ? face_->uv[node] : face_->mid_uv[mid];
          p.uv[i] = {uv.x(), uv.y(), 0};
          p.xyz[i] = mid < 0 ? mesh_.vertices[face_->vertex[node]] : mesh_.mid_vertices[face_->mid_vertex[mid]];
        }
      }
      t += n == 4 ? 2 : 1;
    }
    return placed;
  }

  void measure(int f, bool quad) {
    const std::vector<Placed> all = elements(quad, false);
    if (all.empty()) return;
    const std::vector<Vec2> places = sample_places(quad);
    std::vector<Vec2> uv;
    uv.reserve(all.size() * places.size());
    for (const Placed& p : all)
      for (const Vec2& at : places) {
        const Vec3 q = map_of(p, p.uv).at(at);
        uv.push_back({q.x(), q.y()});
      }
    for (const Placed& p : all) start(p);
    std::vector<Metric2> metric(std::min(points_at_once, uv.size()));
    for_batches(cad_, face_->ref, want_position | want_first | prescribed_.wants, uv, monitor_,
                [&](std::size_t begin, std::span<const Vec2> here, std::span<const SurfaceJet> jets) {
                  if (quad) prescribed_.at(f, here, jets, std::span(metric).first(here.size()));
                  for (std::size_t k = 0; k < here.size(); ++k) {
                    const Placed& p = all[(begin + k) / places.size()];
                    const std::size_t rank = (begin + k) % places.size();
                    compare(p, places[rank], jets[k].s, unit_normal(jets[k]));
                    if (quad && rank == 0) judge_in_metric(p, metric[k]);
                  }
                });
  }

  // Elements of several charts: the surface beside their own points.
  void measure_spread(std::size_t f) {
    for (const bool quad : {true, false}) {
      const std::vector<Vec2> places = sample_places(quad);
      for (const Placed& p : elements(quad, true)) {
        monitor_.checkpoint();
        start(p);
        const std::vector<SurfacePlace> corner = corners_on_surface(f, p);
        for (std::size_t rank = 0; rank < places.size(); ++rank) {
          const auto found = surface_below(corner, map_of(p, p.xyz).at(places[rank]));
          if (!found) continue;
          const bool turned = atlas_.charts->triangles()[found->foot.triangle].turned !=
                              atlas_.is_turned(static_cast<std::int32_t>(f), found->foot.triangle);
          compare(p, places[rank], found->xyz, turned ? Vec3(-found->normal) : found->normal);
          if (quad && rank == 0) judge_in_metric_at(p, *found);
        }
      }
    }
  }

  [[nodiscard]] std::vector<SurfacePlace> corners_on_surface(std::size_t f, const Placed& p) const {
    std::vector<SurfacePlace> corner;
    for (int i = 0; i < corner_count(p.cell.kind); ++i) {
      const std::int32_t local = p.cell.nodes[i];
      const SurfacePlace at = atlas_.charts->evaluate(cad_, {atlas_.feet[f][local], face_->uv[local]});
      if (at.regular) corner.push_back(at);
    }
    return corner;
  }

  // From the nearest corner that leads there, or to a barrier beside.
  [[nodiscard]] std::optional<SurfacePlace> surface_below(std::vector<SurfacePlace> corner, const Vec3& point) const {
    std::ranges::stable_sort(corner, {}, [&](const SurfacePlace& c) { return norm(c.xyz - point); });
    for (const SurfacePlace& from : corner)
      if (const auto found = atlas_.charts->towards(cad_, from, point, true, thresholds::bounds::near_foot)) return found;
    return {};
  }

  // Its corners as the tangent plane of its middle has them in (u, v).
  void judge_in_metric_at(const Placed& p, const SurfacePlace& middle) {
    const std::int32_t face = atlas_.charts->face(middle.foot);
    const std::array<SurfaceJet, 1> jet{
        surface_at(cad_, mesh_.faces[face].ref, want_position | want_first | prescribed_.wants, middle.foot.uv)};
    std::array<Metric2, 1> metric{};
    prescribed_.at(face, {&middle.foot.uv, 1}, jet, metric);
    const double e = dot(middle.su, middle.su), f = dot(middle.su, middle.sv), g = dot(middle.sv, middle.sv);
    Placed flat = p;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 d = p.xyz[i] - middle.xyz;
      const double x = dot(middle.su, d), y = dot(middle.sv, d), det = e * g - f * f;
      flat.uv[i] = {(g * x - f * y) / det, (e * y - f * x) / det, 0};
    }
    // As the face runs in its own (u, v).
    if (dot(cross(p.xyz[2] - p.xyz[0], p.xyz[3] - p.xyz[1]), cross(middle.su, middle.sv)) < 0) std::swap(flat.uv[1], flat.uv[3]);
    judge_in_metric(flat, metric[0]);
  }

  static ElementMap map_of(const Placed& p, const std::array<Vec3, 8>& nodes) {
    return {p.cell.kind, {nodes.data(), static_cast<std::size_t>(node_count(p.cell.kind))}};
  }

  void set(const Placed& p, EvaluationKind kind, double value) {
    of(kind)[p.triangle] = value;
    if (corner_count(p.cell.kind) == 4) of(kind)[p.triangle + 1] = value;
  }

  void start(const Placed& p) {
    set(p, EvaluationKind::deviation, 0);
    set(p, EvaluationKind::angle, 0);
    set(p, EvaluationKind::vertex_angle, nan);
    if (corner_count(p.cell.kind) == 3) return;
    const CellQuality q = cell_quality(p.cell.kind, map_of(p, p.xyz).x);
    set(p, EvaluationKind::q1, q.shape);
    set(p, EvaluationKind::q2, q.scaled_jacobian);
  }

  void compare(const Placed& p, const Vec2& at, const Vec3& surface, const std::optional<Vec3>& normal) {
    const ElementMap map = map_of(p, p.xyz);
    set(p, EvaluationKind::deviation, std::max(of(EvaluationKind::deviation)[p.triangle], map.distance(surface, at)));
    if (!normal) return;
    const auto [a, b] = map.slopes(at);
    const Vec3 own = cross(a, b);
    const double angle = std::atan2(norm(cross(own, *normal)), dot(own, *normal)) * 180 / std::numbers::pi;
    set(p, EvaluationKind::angle, std::max(of(EvaluationKind::angle)[p.triangle], angle));
  }

  // Its corners in a plane in which the metric of its middle is Euclidean.
  void judge_in_metric(const Placed& p, const Metric2& m) {
    const double a = std::sqrt(m.a), b = m.b / a, c = std::sqrt(std::max(0.0, m.c - b * b));
    std::array<Vec3, 4> flat;
    for (std::size_t i = 0; i < 4; ++i) flat[i] = {a * p.uv[i].x() + b * p.uv[i].y(), c * p.uv[i].y(), 0};
    set(p, EvaluationKind::metric_quality, m.a > 0 ? cell_quality(CellKind::quad4, flat).shape : nan);
  }

  void drop_diagonals() {
    for (std::size_t k = 0; k < static_cast<std::size_t>(face_->quads); ++k) {
      const std::int32_t edge = delivered_.edges.of_triangle[first_ + 2 * k][2];
      for (const EvaluationKind kind : {EvaluationKind::length, EvaluationKind::edge_angle, EvaluationKind::gradation})
        of(kind)[edge] = nan;
    }
  }

  const SurfaceMesh& mesh_;
  Cad& cad_;
  const PrescribedMetric& prescribed_;
  const SpreadAtlas& atlas_;
  Monitor& monitor_;
  MeshEvaluation& delivered_;
  const FaceMesh* face_ = nullptr;
  std::size_t first_ = 0;  // triangle of the mesh
};

}  // namespace

void evaluate_elements(const SurfaceMesh& mesh, Cad& cad, const PrescribedMetric& prescribed, const SpreadAtlas& atlas,
                       Monitor& monitor, MeshEvaluation& delivered) {
  if (mesh.cells_are_not_triangles()) ElementEvaluation(mesh, cad, prescribed, atlas, monitor, delivered).run();
}

}  // namespace carreau
