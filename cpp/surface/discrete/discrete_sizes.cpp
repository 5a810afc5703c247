// SPDX-License-Identifier: BSD-3-Clause
#include "surface/discrete/discrete_sizes.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "gradation/gradation.h"
#include "size/thresholds.h"
#include "support/incidence.h"

namespace carreau {

namespace {

std::size_t index(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

/// The least size of a metric of (u, v): 1 / h^2 is the larger eigenvalue of I^-1 M, I the first fundamental form.
double least_size(const Metric2& m, const SurfaceJet& jet) noexcept {
  const Metric2 i = induced_metric(jet.su, jet.sv, 1);
  const double det = determinant(i);
  const double trace = (i.c * m.a - 2 * i.b * m.b + i.a * m.c) / det, product = determinant(m) / det;
  const double root = std::sqrt(std::max(0.0, trace * trace / 4 - product));
  return 1 / std::sqrt(trace / 2 + root);
}

}  // namespace

// Normals of regions at the ends of an edge tell how it bends along it: |n - m| / |p - q| is the mean curvature of that
// way. Second derivatives of the patches jump from one to the next, and say less.
DiscreteSizes::DiscreteSizes(const Model& model, Cad& cad, const discrete::DiscreteCad& surface,
                             const CompositeOptions& options)
    : model_(model), cad_(cad), surface_(surface), options_(options) {
  if (options.size.geometric == GeometricSizes::ignored) return;
  const discrete::DiscreteSurface& s = surface.discrete();
  const discrete::Triangulation& mesh = s.mesh();
  UnionFind sectors = discrete::sectors_of(mesh, s.lines().sharp);
  std::vector<double> curvature(3 * s.triangles(), 0);
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(s.triangles()); ++t)
    for (int i = 0; i < 3; ++i) {
      const Vec3 d = mesh.at(mesh.corner(t, i + 1)) - mesh.at(mesh.corner(t, i));
      const double k = norm(s.normal(t, i + 1) - s.normal(t, i)) / norm(d);
      for (const int c : {i, (i + 1) % 3}) {
        double& most = curvature[sectors.find(3 * index(t) + static_cast<std::size_t>(c))];
        most = std::max(most, k);
      }
    }
  for (std::size_t c = 0; c < curvature.size(); ++c) radius_.push_back(1 / curvature[sectors.find(c)]);
  if (options.size.geo_anisotropic) curvature_.emplace(s);
}

GeometricRule DiscreteSizes::geometric_rule() const {
  const SizeParameters& size = options_.size;
  GeometricRule rule{
      .criterion = size.geo_rule, .anisotropic = false, .angle_deg = size.angle_mesh, .eps0 = size.eps_chord};
  if (size.geo_guarantee) {
    rule.angle_factor = thresholds::size::guaranteed_angle_factor;
    rule.chord_factor = thresholds::size::guaranteed_chord_factor;
  }
  return rule;
}

double DiscreteSizes::clamped_geometric(double h) const {
  return std::clamp(h, options_.size.hgeomin, options_.size.hgeomax);
}

double DiscreteSizes::largest_curvature(std::int32_t triangle, const Vec2& uv) const {
  const std::size_t first = 3 * index(triangle);
  return (1 - uv.x() - uv.y()) / radius_[first] + uv.x() / radius_[first + 1] + uv.y() / radius_[first + 2];
}

// Index in Model::faces of the face of each triangle of the surface.
std::vector<int> DiscreteSizes::face_of_triangles() const {
  std::vector<int> rank(1 + index(model_.faces.back().ref), 0);
  for (std::size_t f = 0; f < model_.faces.size(); ++f) {
    rank.resize(std::max(rank.size(), index(model_.faces[f].ref) + 1), 0);
    rank[index(model_.faces[f].ref)] = static_cast<int>(f);
  }
  std::vector<int> face;
  for (const std::int32_t ref : discrete::face_refs(surface_.discrete())) face.push_back(rank[index(ref)]);
  return face;
}

void DiscreteSizes::prescribe(const discrete::RefinedMesh& mesh, std::vector<double>& size, Monitor& monitor) const {
  SizeParameters physical = options_.size;
  if (physical.physical == PhysicalSizes::ignored) return;
  physical.geometric = GeometricSizes::ignored;
  const Topology none;
  const SizeRules rules(model_, none, cad_, physical);
  if (const auto constant = rules.constant()) {
    for (double& h : size) h = std::min(h, *constant);
    return;
  }
  const std::vector<int> faces = face_of_triangles();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (t % 256 == 0) monitor.checkpoint();
    const int face = faces[index(mesh.parent[t])];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 uv = surface_.corner_of_tile(mesh.parent[t]) + mesh.uv[t][k];
      const SurfaceJet jet =
          surface_at(cad_, model_.faces[index(face)].ref, want_position | want_first | rules.surface_wants(), uv);
      Metric2 metric;
      const double otherwise = physical.hphydef;
      rules.metrics_on_surface(face, {&uv, 1}, {&jet, 1}, [&](const Vec2&) { return otherwise; }, {&metric, 1});
      double& h = size[index(mesh.triangles[t][k])];
      h = std::min(h, least_size(metric, jet));
    }
  }
}

void DiscreteSizes::bend(const discrete::RefinedMesh& mesh, std::vector<double>& size) const {
  const GeometricRule rule = geometric_rule();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2& p = mesh.uv[t][k];
      const double curvature = largest_curvature(mesh.parent[t], p);
      const double h = geometric_size(rule, curvature > 0 ? 1 / curvature : infinity);
      double& least = size[index(mesh.triangles[t][k])];
      least = std::min(least, clamped_geometric(h));
    }
  }
}

/// A size grows by so much a length from the place that it is refined at; near the place it is that of the place.
constexpr double growth_from_fine_places = 0.5;

MeshSizes DiscreteSizes::at_vertices(const discrete::RefinedMesh& mesh, Monitor& monitor) const {
  const bool told = options_.size.physical != PhysicalSizes::ignored && !options_.size.sources.empty();
  if (curvature_ || told)
    if (MeshSizes directed = by_direction(mesh, monitor); directed.by_direction()) return directed;
  std::vector<double> size(mesh.vertices.size(), infinity);
  prescribe(mesh, size, monitor);
  if (options_.size.geometric != GeometricSizes::ignored) bend(mesh, size);
  for (std::size_t v = 0; v < size.size(); ++v)
    for (const FinePlace& place : fine_)
      size[v] = std::min(size[v], std::max(place.size, growth_from_fine_places * norm(mesh.vertices[v] - place.at)));
  if (options_.gradation > 0)
    grade_over_edges(mesh.vertices, mesh.triangles, slope_of_gradation(options_.gradation), size);
  return {std::move(size), {}, {}};
}

void grade_over_edges(const std::vector<Vec3>& vertices, const std::vector<std::array<std::int32_t, 3>>& triangles,
                      double slope, std::vector<double>& size) {
  const Incidence around(vertices.size(), triangles);
  using Entry = std::pair<double, std::int32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::size_t v = 0; v < size.size(); ++v) queue.emplace(size[v], static_cast<std::int32_t>(v));
  while (!queue.empty()) {
    const auto [h, v] = queue.top();
    queue.pop();
    if (h > size[index(v)]) continue;
    for (const std::int32_t t : around.of(v))
      for (const std::int32_t w : triangles[index(t)]) {
        const double grown = h + slope * norm(vertices[index(w)] - vertices[index(v)]);
        if (grown < size[index(w)]) queue.emplace(size[index(w)] = grown, w);
      }
  }
}

}  // namespace carreau
