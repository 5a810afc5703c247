// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/planes/chart_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "plane/plane_mesher.h"
#include "support/infinity.h"
#include "support/rounding_of.h"
#include "surface/remesh/planes/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::planes;

struct Domain {
  PlaneDomain plane;
  std::vector<std::int32_t> vertex;  // of the mesh to come
};

// Edges run so that the chart lies on their left.
Domain domain_of(const ChartInput& input) {
  Domain domain;
  std::map<std::int32_t, int> number;
  const auto local = [&](std::int32_t v) {
    const auto [known, fresh] = number.try_emplace(v, static_cast<int>(domain.vertex.size()));
    if (fresh) domain.vertex.push_back(v), domain.plane.vertices.push_back(input.plane.project(input.xyz[v]));
    return known->second;
  };
  for (const BorderChain* chain : input.chains)
    for (std::size_t k = 1; k < chain->vertices.size(); ++k) {
      const int a = local(chain->vertices[k - 1]), b = local(chain->vertices[k]);
      const bool left = chain->left == input.chart, right = chain->right == input.chart;
      PlaneEdge edge{left ? a : b, left ? b : a};
      if (left && right) edge.kind = PlaneEdgeKind::internal;
      domain.plane.edges.push_back(edge);
    }
  return domain;
}

/// The one size that all triangles of the chart have.
std::optional<double> one_size(const ChartInput& input) {
  double least = infinity, most = 0;
  for (const std::int32_t t : input.triangles)
    for (const std::int32_t v : input.atlas.at(t).vertex)
      least = std::min(least, input.size[v]), most = std::max(most, input.size[v]);
  return most <= (1 + rounding_of::sizes) * least ? std::optional(least) : std::nullopt;
}

ControlSpace space_of(const ChartInput& input, const Domain& domain, Monitor& monitor) {
  const std::optional<double> size = one_size(input);
  if (size && input.plane.min_cosine() >= flat_cosine) {
    const double k = 1 / (*size * *size);
    return ControlSpace::constant({k, 0, k});
  }
  SampledDomain sampled{domain.plane.vertices, {}};
  for (const PlaneEdge& e : domain.plane.edges)
    if (e.kind == PlaneEdgeKind::boundary) sampled.edges.emplace_back(e.a, e.b);
  const auto sampler = [&](std::span<const Vec2> uv, std::span<Metric2> metric) {
    for (std::size_t k = 0; k < uv.size(); ++k) {
      const auto foot = input.plane.find(uv[k], true);
      if (!foot) throw DomainError("a chart is folded");
      const double h = input.atlas.charts.size(*foot);
      metric[k] = (1 / (h * h)) * input.plane.metric(*foot);
    }
  };
  ControlSpaceOptions options;
  if (size)
    options.tolerance = length_tolerance, options.samples_per_vertex = samples_per_vertex,
    options.min_samples = least_samples;
  return ControlSpace::build(sampled, sampler, options, monitor);
}

}  // namespace

void check_borders(const ChartInput& input, Monitor& monitor) {
  (void)triangulate_domain(domain_of(input).plane, monitor);
}

std::optional<ChartMesh> mesh_chart(const ChartInput& input, Monitor& monitor) {
  Domain domain = domain_of(input);
  const ControlSpace space = space_of(input, domain, monitor);
  PlaneMesherOptions how;
  if (input.max_triangles > 0) how.max_triangles = input.max_triangles;
  PlaneMesh mesh = mesh_plane(domain.plane, space, how, monitor);
  ChartMesh made;
  made.border = std::move(domain.vertex);
  made.triangles = std::move(mesh.triangles);
  for (std::size_t v = made.border.size(); v < mesh.vertices.size(); ++v) {
    const auto foot = input.plane.find(mesh.vertices[v]);
    if (!foot) return {};
    made.inner.push_back(mesh.vertices[v]);
    made.feet.push_back(*foot);
  }
  return made;
}

}  // namespace carreau
