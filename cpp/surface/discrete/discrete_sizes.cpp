// SPDX-License-Identifier: BSD-3-Clause
#include "surface/discrete/discrete_sizes.h"

#include <algorithm>
#include <cmath>

#include "gradation/gradation.h"
#include "gradation/smallest_first.h"
#include "metric/metric3_algebra.h"
#include "model/union_find.h"
#include "support/error.h"
#include "support/incidence.h"

namespace carreau {

namespace {

using discrete::RefinedMesh;

/// Tangent of the largest angle of triangles with the surface, which bounds long sizes as on patches
/// (pipeline/base/thresholds.h).
constexpr double max_lean = 0.5;
/// Ratio of sizes in two directions. Below, the sizes have no direction.
constexpr double min_ratio = 1 + 1e-6;

std::size_t index(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

/// A side of a triangle, by its edge.
struct SideOfEdge {
  discrete::Edge edge;
  std::size_t triangle;
  std::size_t side;
  friend auto operator<=>(const SideOfEdge&, const SideOfEdge&) = default;
};

Metric2 of_sizes(const TangentMetric& m, const Vec3& p, const Vec3& q) noexcept {
  const double a = dot(m.d1, p) / m.h1, b = dot(m.d1, q) / m.h1, c = dot(m.d2, p) / m.h2, d = dot(m.d2, q) / m.h2;
  return {a * a + c * c, a * b + c * d, b * b + d * d};
}

TangentMetric tangent_metric_of(Metric2 m, const Vec3& p, const Vec3& q) noexcept {
  const Eigen2 e = eigen(m);
  return {e.direction.x() * p + e.direction.y() * q, e.direction.x() * q - e.direction.y() * p, 1 / std::sqrt(e.major),
          1 / std::sqrt(e.minor)};
}

PlaneMetric plane_metric_of(const TangentMetric& m, const Vec3& normal) noexcept {
  const Metric3 both = compose({{1 / (m.h1 * m.h1), 1 / (m.h2 * m.h2), 0}, {m.d1, m.d2, normal}});
  return {both, normal};
}

double ratio_of(const TangentMetric& m) noexcept { return std::max(m.h1, m.h2) / std::min(m.h1, m.h2); }

/// Lowers sizes until they grow along edges by `slope` at most.
void grade_over_edges(const RefinedMesh& mesh, double slope, std::vector<double>& size, Monitor& monitor) {
  const Incidence around(mesh.vertices.size(), mesh.triangles);
  SmallestFirst queue;
  for (std::size_t v = 0; v < size.size(); ++v) queue.push(size[v], static_cast<int>(v));
  const auto hand_on = [&](std::int32_t v) {
    for (const std::int32_t t : around.of(v))
      for (const std::int32_t w : mesh.triangles[index(t)]) {
        const double grown = size[index(v)] + slope * norm(mesh.vertices[index(w)] - mesh.vertices[index(v)]);
        if (grown < size[index(w)]) queue.push(size[index(w)] = grown, w);
      }
  };
  queue.run([&](double h, std::int32_t v) { return h <= size[index(v)]; }, hand_on, monitor);
}

}  // namespace

/// Sides of vertices: the sets of corners that no sharp edge divides.
struct DiscreteSizes::Sides {
  std::vector<int> of_corner;      // by corner 3 t + k
  std::vector<std::size_t> first;  // of each: its first corner

  explicit Sides(const RefinedMesh& mesh) : of_corner(3 * mesh.triangles.size(), -1) {
    std::vector<discrete::Edge> sharp;
    for (const auto& line : mesh.lines)
      for (std::size_t k = 1; k < line.size(); ++k) sharp.push_back(discrete::edge_of(line[k - 1], line[k]));
    std::ranges::sort(sharp);
    std::vector<SideOfEdge> sides;
    sides.reserve(of_corner.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i)
        sides.push_back({discrete::edge_of(mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]), t, i});
    std::ranges::sort(sides);
    UnionFind sets(of_corner.size());
    for (std::size_t k = 0, n = 0; k < sides.size(); k += n) {
      for (n = 1; k + n < sides.size() && sides[k + n].edge == sides[k].edge;) ++n;
      if (n != 2 || std::ranges::binary_search(sharp, sides[k].edge)) continue;
      const SideOfEdge &p = sides[k], &q = sides[k + 1];
      for (const std::size_t i : {p.side, (p.side + 1) % 3})
        for (const std::size_t j : {q.side, (q.side + 1) % 3})
          if (mesh.triangles[p.triangle][i] == mesh.triangles[q.triangle][j])
            sets.merge(3 * p.triangle + i, 3 * q.triangle + j);
    }
    for (std::size_t c = 0; c < of_corner.size(); ++c) {
      const std::size_t root = sets.find(c);
      if (root == c) of_corner[c] = static_cast<int>(first.size()), first.push_back(c);
      of_corner[c] = of_corner[root];
    }
  }
};

double MeshSizes::length(const RefinedMesh& mesh, std::int32_t v, std::int32_t w) const {
  const Vec3 way = mesh.vertices[index(w)] - mesh.vertices[index(v)];
  return length_between(carreau::length(metric[index(v)], way), carreau::length(metric[index(w)], way));
}

double MeshSizes::over(const RefinedMesh& mesh, std::size_t triangle) const {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    sum += by_direction() ? mean_size(corner[3 * triangle + k]) : h[index(mesh.triangles[triangle][k])];
  return sum / 3;
}

// The normals of regions at the ends of an edge give the mean curvature along it: |n - m| / |p - q|. Second derivatives
// of the patches jump from one patch to the next, and give less.
DiscreteSizes::DiscreteSizes(const Model& model, Cad& cad, const discrete::DiscreteCad& surface,
                             const CompositeOptions& options)
    : model_(model), cad_(cad), surface_(surface), options_(options), rule_(geometric_rule(options.size)) {
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
  if (rule_.anisotropic) curvature_.emplace(s);
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

double DiscreteSizes::isotropic_at(std::int32_t triangle, const Vec2& uv) const {
  const double curvature = largest_curvature(triangle, uv);
  return clamped_geometric(geometric_size(rule_, curvature > 0 ? 1 / curvature : infinity));
}

// The larger curvature is the largest along edges, as for sizes without directions. The rest of the curvature, beyond
// the tensor, may have any direction.
std::optional<TangentMetric> DiscreteSizes::geometric_at(std::int32_t triangle, const Vec2& uv, const Vec3& p,
                                                         const Vec3& q) const {
  if (options_.size.geometric == GeometricSizes::ignored) return {};
  if (!curvature_) {
    const double h = isotropic_at(triangle, uv);
    return TangentMetric{p, q, h, h};
  }
  const double largest = largest_curvature(triangle, uv);
  const Eigen2 e = eigen(curvature_->at(triangle, uv, p, q));
  const bool first = std::abs(e.major) >= std::abs(e.minor);
  const Vec3 major = e.direction.x() * p + e.direction.y() * q, minor = e.direction.x() * q - e.direction.y() * p;
  const double k1 = first ? std::abs(e.major) : std::abs(e.minor), k2 = first ? std::abs(e.minor) : std::abs(e.major);
  const double other = std::min(largest, k2 + std::max(0.0, largest - k1));
  const auto radius = [](double k) { return k > 0 ? 1 / k : infinity; };
  const auto [h1, h2] = geometric_sizes(rule_, radius(largest), radius(other));
  TangentMetric sizes{first ? major : minor, first ? minor : major, clamped_geometric(h1), clamped_geometric(h2)};
  sizes.h2 = std::min(sizes.h2, options_.size.anisotropy_max * sizes.h1);
  return sizes;
}

// Triangles of long edges across a bent surface would lean against it.
void DiscreteSizes::keep_flat(std::int32_t triangle, const Vec2& uv, TangentMetric& sizes) const {
  if (!curvature_) return;
  if (sizes.h1 > sizes.h2) std::swap(sizes.h1, sizes.h2), std::swap(sizes.d1, sizes.d2);
  const Vec3 normal = cross(sizes.d1, sizes.d2);
  const PlaneCurvature k = curvature_->at(triangle, uv, sizes.d1, sizes.d2);
  SurfaceJet jet;
  jet.su = sizes.d1, jet.sv = sizes.d2;
  jet.suu = k.a * normal, jet.suv = k.b * normal, jet.svv = k.c * normal;
  bound_lean(jet, max_lean, sizes);
}

TangentMetric DiscreteSizes::wanted_at(const SizeRules& rules, int face, std::int32_t triangle, const Vec2& uv) const {
  const bool physical = options_.size.physical != PhysicalSizes::ignored;
  const Vec2 place = surface_.corner_of_tile(triangle) + uv;
  SurfaceJet jet =
      surface_at(cad_, model_.faces[index(face)].ref, want_position | want_first | rules.surface_wants(), place);
  Vec3 p, q;
  if (const auto frame = TangentFrame::of(jet.su, jet.sv)) {
    p = frame->e1, q = frame->e2;
  } else {  // the patch has a fold there: the triangle's value is better than none
    const auto& mesh = surface_.discrete().mesh();
    jet.su = mesh.at(mesh.corner(triangle, 1)) - mesh.at(mesh.corner(triangle, 0));
    jet.sv = mesh.at(mesh.corner(triangle, 2)) - mesh.at(mesh.corner(triangle, 0));
    const auto flat = TangentFrame::of(jet.su, jet.sv);
    p = flat->e1, q = flat->e2;
  }
  std::optional<Metric2> wanted;
  if (physical) {
    Metric2 metric;
    const double otherwise = options_.size.hphydef;
    rules.on_surface(face, {&place, 1}, {&jet, 1}, [&](const Vec2&) { return otherwise; }, std::span<Metric2>(&metric, 1));
    wanted = TangentFrame::of(jet.su, jet.sv)->of_parameters(metric);
  }
  if (const auto geometric = geometric_at(triangle, uv, p, q)) {
    const Metric2 bound = of_sizes(*geometric, p, q);
    wanted = wanted ? combine(*wanted, bound, options_.size.metric_combination) : bound;
  }
  TangentMetric sizes = tangent_metric_of(*wanted, p, q);
  keep_flat(triangle, uv, sizes);
  return sizes;
}

// Fast path: sizes at vertices, without evaluating the surface.
std::vector<double> DiscreteSizes::isotropic(const RefinedMesh& mesh, double prescribed) const {
  std::vector<double> h(mesh.vertices.size(), prescribed);
  if (options_.size.geometric == GeometricSizes::ignored) return h;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      double& least = h[index(mesh.triangles[t][k])];
      least = std::min(least, isotropic_at(mesh.parent[t], mesh.uv[t][k]));
    }
  return h;
}

/// `sizes`: of the sides.
MeshSizes DiscreteSizes::by_direction(const RefinedMesh& mesh, const Sides& sides, GradationGraph graph,
                                      std::vector<TangentMetric> sizes, Monitor& monitor) const {
  if (options_.gradation > 0) {
    graph.xyz = mesh.vertices;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      graph.triangles.push_back({sides.of_corner[3 * t], sides.of_corner[3 * t + 1], sides.of_corner[3 * t + 2]});
    sizes = grade_metrics(graph, std::move(sizes), {}, slope_of_gradation(options_.gradation), monitor);
  }
  MeshSizes made{std::vector<double>(mesh.vertices.size(), infinity), std::vector<Metric3>(mesh.vertices.size()), {}};
  std::vector<std::vector<PlaneMetric>> planes(mesh.vertices.size());
  std::vector<PlaneMetric> of_side;
  for (std::size_t s = 0; s < sizes.size(); ++s) {
    of_side.push_back(plane_metric_of(sizes[s], graph.places[s].normal));
    const auto v = index(graph.places[s].vertex);
    planes[v].push_back(of_side.back());
    made.h[v] = std::min(made.h[v], mean_size(of_side.back()));
  }
  for (std::size_t v = 0; v < planes.size(); ++v)
    if (!planes[v].empty()) made.metric[v] = where_planes_meet(planes[v]);
  made.corner.reserve(sides.of_corner.size());
  for (const int side : sides.of_corner) made.corner.push_back(of_side[index(side)]);
  return made;
}

MeshSizes DiscreteSizes::at_vertices(const RefinedMesh& mesh, Monitor& monitor) const {
  SizeParameters physical = options_.size;
  const bool prescribes = physical.physical != PhysicalSizes::ignored;
  if (prescribes) {  // curvatures are known here, and by no patch
    physical.geometric = GeometricSizes::ignored;
    physical.geo_anisotropic = false;
    physical.geo_rule = GeometricCriterion::angle;
  }
  const Topology none;
  const SizeRules rules(model_, none, cad_, physical);
  std::vector<double> h;
  if (!curvature_ && (!prescribes || rules.constant())) {
    h = isotropic(mesh, prescribes ? *rules.constant() : infinity);
  } else {
    const Sides sides(mesh);
    const std::vector<int> face = face_of_triangles();
    GradationGraph graph;
    std::vector<TangentMetric> sizes;
    double most = 1;
    h.assign(mesh.vertices.size(), infinity);
    for (const std::size_t c : sides.first) {
      if (sizes.size() % 256 == 0) monitor.checkpoint();
      const std::int32_t triangle = mesh.parent[c / 3], v = mesh.triangles[c / 3][c % 3];
      sizes.push_back(wanted_at(rules, face[index(triangle)], triangle, mesh.uv[c / 3][c % 3]));
      most = std::max(most, ratio_of(sizes.back()));
      h[index(v)] = std::min({h[index(v)], sizes.back().h1, sizes.back().h2});
      graph.places.push_back({v, cross(sizes.back().d1, sizes.back().d2)});
    }
    if (most > min_ratio) return by_direction(mesh, sides, std::move(graph), std::move(sizes), monitor);
  }
  if (options_.gradation > 0)
    grade_over_edges(mesh, slope_of_gradation(options_.gradation), h, monitor);
  return {std::move(h), {}, {}};
}

}  // namespace carreau
