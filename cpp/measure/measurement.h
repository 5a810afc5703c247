// SPDX-License-Identifier: BSD-3-Clause
// Measures triangles and edges of a mesh against surface and sizes. Private to measure/.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "cad/batches.h"
#include "cad/fundamental_forms.h"
#include "measure/base/degenerate_sides.h"
#include "measure/mesh_evaluation.h"
#include "mesh/distance/triangle_distance.h"
#include "mesh/quality.h"
#include "support/gauss.h"

namespace carreau {

/// Evaluates jets and metrics at points of a face, a batch at a time, in the order in which they were added.
class PlaceSampler {
 public:
  PlaceSampler(Cad& cad, const PrescribedMetric& prescribed, Monitor& monitor)
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

  void find_neighbours();
  void measure_face();

  // Normals at the vertices, and metrics along edges that end there.
  void measure_vertices();
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
  [[nodiscard]] std::optional<std::array<double, 2>> curve_sizes(std::int32_t edge, std::int32_t from) const;

  // A side of a triangle whose points are evaluated: each edge once, edges on curves from every side.
  struct Side {
    std::size_t triangle;  // of the mesh
    std::int32_t edge, a, b;
    bool measured;  // here
    Vec2 from, to;  // of the edge in (u, v)
  };

  // The edge from a to b, straight to a pole.
  [[nodiscard]] std::array<Vec2, 2> ends(std::int32_t a, std::int32_t b) const;
  // End point of the way from vertex `a` at a pole.
  [[nodiscard]] Vec2 arrival(std::int32_t pole, std::int32_t a) const;

  // The corners of a triangle in (u, v). A corner at a pole lies between the arrivals of the ways from the other two:
  // the end of the side that represents the pole may be far away, with arbitrary normals between.
  [[nodiscard]] std::array<Vec2, 3> places(std::size_t t) const;
  [[nodiscard]] std::vector<Side> own_sides();
  void measure_edges();
  void raise_edge_angle(std::int32_t edge, std::int32_t a, std::int32_t b);

  // Adds an edge to the comparison at its end `a`.
  void note_lengths(std::size_t t, std::int32_t a, std::int32_t b);

  [[nodiscard]] const ControlSpace* governing_space() const {
    const auto f = static_cast<std::size_t>(face_index_);
    return f < options_.spaces.size() && options_.spaces[f] ? &*options_.spaces[f] : nullptr;
  }

  // The offset in (u, v) that leads along a chord, in the tangent plane of a vertex.
  [[nodiscard]] Vec2 offset_along(std::int32_t v, const Vec3& chord) const;

  // Along the chord: the image of a segment of (u, v) turns as the parametrisation does.
  void set_gradation(std::int32_t edge, std::int32_t a, std::int32_t b);
  void measure_triangles();

  // Triangles whose corners are of several charts: over their places in space.
  void measure_spread();

  // Triangles of (u, v) with edges that were measured with a spread neighbour, after them.
  void finish_beside_spread();
  void note_above(const SpreadSample& s, const Vec3& p);
  void note(const SpreadSample& s, const SurfaceJet& jet, const Metric2& metric);

  // Heron's formula.
  void finish_by_lengths(std::size_t place);

  // The image of a triangle of (u, v) may reach beyond the triangle in space, far beyond it at a pole. Such points lie
  // above a neighbour, or its neighbour: walks while the distance decreases.
  [[nodiscard]] double distance_to_mesh(const Vec3& s, std::size_t triangle) const;
  void raise_deviation(std::size_t place, Vec3 s) {
    if (distance(s, place) > of(EvaluationKind::deviation)[place])
      raise(EvaluationKind::deviation, place, distance_to_mesh(s, place));
  }

  void raise_angle(std::size_t place, const std::array<Vec3, 3>& p, const std::optional<Vec3>& normal);

  void start_triangle(std::size_t t);
  void finish_quality(std::size_t t);

  // A point above an edge belongs to both triangles beside it: its distance is the smaller one.
  void share_deviations();
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
  PlaceSampler sampler_;
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

}  // namespace carreau
