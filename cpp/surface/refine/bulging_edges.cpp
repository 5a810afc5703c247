// SPDX-License-Identifier: BSD-3-Clause
#include "surface/refine/bulging_edges.h"

#include <algorithm>
#include <cmath>

#include "cad/fundamental_forms.h"
#include "predicates/polygon_locator.h"
#include "predicates/predicates.h"
#include "surface/domain/domain_graph.h"
#include "surface/domain/near_vertices.h"

namespace carreau {

double bulge_of(const CurveModel& model, const std::vector<DiscreteCurve>& curves, const PlaneEdge& edge,
                double chord) {
  const std::vector<double>& r = curves[edge.curve].r;
  const double length = (r[edge.segment + 1] - r[edge.segment]) * model.length(edge.curve);
  return std::sqrt(std::max(0.0, 0.375 * chord * (length - chord)));
}

std::vector<int> edges_to_split_for_bulges(const CurveModel& model, const std::vector<DiscreteCurve>& curves, int face,
                                           const FaceDomain& domain, double coef) {
  struct Bulging {
    int edge;
    double height;
  };
  const PlaneDomain& plane = domain.plane;
  const std::vector<Vec3> xyz = positions_on_curves(domain, curves, model.topology);
  if (xyz.size() < domain.origin.size()) return {};  // imposed points
  std::vector<Bulging> bulging;
  for (int e = 0; e < static_cast<int>(plane.edges.size()); ++e) {
    const PlaneEdge& edge = plane.edges[e];
    if (edge.kind == PlaneEdgeKind::degenerate) continue;
    const double chord = norm(xyz[edge.b] - xyz[edge.a]), bulge = bulge_of(model, curves, edge, chord);
    if (bulge > coef * chord) bulging.push_back({e, bulge});
  }
  std::vector<int> passed;
  if (bulging.empty()) return passed;
  NearVertices near(xyz);
  const PolygonLocator inside(plane.vertices, bounding_edges(plane));
  const auto normal_at = [&](Vec2 uv) {
    return unit_normal(surface_at(model.cad, model.model.faces[face].ref, want_first, uv)).value_or(Vec3{});
  };
  for (const Bulging& one : bulging) {
    const PlaneEdge& edge = plane.edges[one.edge];
    const Vec2 a = plane.vertices[edge.a], b = plane.vertices[edge.b];
    // In space the triangle of the edge and a vertex is turned against the surface at the vertex or beside the edge.
    const auto is_turned = [&](int v) {
      const Vec2 p = plane.vertices[v], middle = lerp(a, b, 0.5);
      const int side = orientation(a, b, p);
      if (side == 0 || !inside.contains(lerp(middle, p, 0.5))) return false;
      const Vec3 n = side * cross(xyz[edge.b] - xyz[edge.a], xyz[v] - xyz[edge.a]);
      return dot(n, normal_at(p)) < 0 || dot(n, normal_at(middle)) < 0;
    };
    bool any = false;
    // Beside the chord, nearer than the curve is there.
    const auto is_passed = [&](int v) {
      const double s = fraction_on_segment(xyz[v], xyz[edge.a], xyz[edge.b]);
      return norm(xyz[v] - lerp(xyz[edge.a], xyz[edge.b], s)) <= 4 * s * (1 - s) * one.height;
    };
    near.each_beside(xyz[edge.a], xyz[edge.b], one.height, [&](int v) {
      any = domain.origin[v].curve != edge.curve && is_passed(v) && is_turned(v);
      return !any;
    });
    if (any) passed.push_back(one.edge);
  }
  return passed;
}

}  // namespace carreau
