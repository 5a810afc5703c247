// SPDX-License-Identifier: BSD-3-Clause
#include "surface/refine/strips.h"

#include <algorithm>
#include <array>

#include "predicates/polygon_locator.h"
#include "support/angles.h"
#include "support/segment.h"
#include "surface/domain/domain_check.h"
#include "surface/domain/domain_graph.h"
#include "surface/domain/near_vertices.h"
#include "surface/refine/bulging_edges.h"
#include "surface/refine/thresholds.h"

namespace carreau {
namespace {

using namespace thresholds::refine;

class StripsInSpace {
 public:
  StripsInSpace(const CurveModel& model, const std::vector<DiscreteCurve>& curves, int face, const FaceDomain& domain)
      : model_(model),
        topology_(model.topology),
        curves_(curves),
        face_(face),
        domain_(domain),
        xyz_(positions_on_curves(domain, curves, model.topology)) {}

  [[nodiscard]] std::vector<Strip> find(double coef) const {
    std::vector<Strip> strips;
    if (xyz_.size() < domain_.origin.size()) return strips;  // imposed points
    const PlaneDomain& plane = domain_.plane;
    NearVertices near(xyz_);
    const PolygonLocator inside(plane.vertices, bounding_edges(plane));
    for (int e = 0; e < static_cast<int>(plane.edges.size()); ++e) {
      const PlaneEdge& edge = plane.edges[e];
      if (edge.kind == PlaneEdgeKind::degenerate) continue;
      const Vec3 a = xyz_[edge.a], b = xyz_[edge.b];
      const auto note_strip = [&](int v) {
        const double s = fraction_on_segment(xyz_[v], a, b), d = norm(xyz_[v] - lerp(a, b, s));
        if (meet(edge.curve, domain_.origin[v]) && !bulges_past(edge, v, s, d)) return true;
        const double size = std::min(domain_.size[v], model_.length(edge.curve));
        if (d >= norm(b - a) * coefficient_of_width(coef, d / size)) return true;
        const Vec2 nearest = lerp(plane.vertices[edge.a], plane.vertices[edge.b], s);
        const Vec2 middle = lerp(plane.vertices[v], nearest, 0.5);
        if (inside.contains(middle)) strips.push_back({e, v, middle});
        return true;
      };
      near.each_beside(a, b, coef * norm(b - a), note_strip);
    }
    return strips;
  }

 private:
  // Returns whether the curve of an edge passes by a vertex, and its chord does not: at distance d, fraction s of the
  // chord. At the tip of two curves that touch each other any two edges are like that, however short. A curve between
  // its chord and the vertex is nearer, but the triangle between these is the wider.
  [[nodiscard]] bool bulges_past(const PlaneEdge& edge, int v, double s, double d) const {
    const Vec3 a = xyz_[edge.a], b = xyz_[edge.b];
    const double bulge = bulge_of(model_, curves_, edge, norm(b - a));
    if (d > bulge) return false;
    const double height = 4 * s * (1 - s) * bulge, between = d + height;
    if (d > height && dot(middle_of(edge) - lerp(a, b, 0.5), xyz_[v] - lerp(a, b, s)) > 0) return false;
    const auto is_sharp_corner = [&](int end) {
      return domain_.origin[end].corner >= 0 && between < angles::touching * norm(xyz_[v] - xyz_[end]);
    };
    return !is_sharp_corner(edge.a) && !is_sharp_corner(edge.b);
  }

  [[nodiscard]] Vec3 middle_of(const PlaneEdge& edge) const {
    const std::vector<double>& r = curves_[edge.curve].r;
    const CurveSupport& support = model_.support(topology_.curves[edge.curve].uses.front());
    return support.point_at_arc((r[edge.segment] + r[edge.segment + 1]) / 2 * support.length());
  }

  // Returns whether a vertex lies on the given curve, or on a curve of the face that shares an end with it.
  [[nodiscard]] bool meet(int curve, const DomainVertexOrigin& origin) const {
    const Curve& one = topology_.curves[curve];
    const auto meets = [&](int c) {
      const Curve& other = topology_.curves[c];
      return c == curve || other.end1 == one.end1 || other.end1 == one.end2 || other.end2 == one.end1 ||
             other.end2 == one.end2;
    };
    if (origin.corner < 0) return meets(origin.curve);
    const std::vector<int>& around = topology_.curve_of[face_];
    return std::any_of(around.begin(), around.end(), [&](int c) {
      const Curve& other = topology_.curves[c];
      return (other.end1 == origin.corner || other.end2 == origin.corner) && meets(c);
    });
  }

  const CurveModel& model_;
  const Topology& topology_;
  const std::vector<DiscreteCurve>& curves_;
  int face_;
  const FaceDomain& domain_;
  std::vector<Vec3> xyz_;
};

}  // namespace

std::vector<Strip> find_strips(const CurveModel& model, const std::vector<DiscreteCurve>& curves, int face,
                               const FaceDomain& domain, double coef) {
  return StripsInSpace(model, curves, face, domain).find(coef);
}

bool lies_between(const CurveModel& model, int face, const FaceDomain& domain, const Strip& strip) {
  const std::vector<Vec2>& uv = domain.plane.vertices;
  const PlaneEdge& edge = domain.plane.edges[strip.edge];
  const std::array<Vec2, 4> points{strip.middle, uv[strip.vertex], uv[edge.a], uv[edge.b]};
  std::array<SurfaceJet, 4> at;
  model.cad.surface(model.model.faces[face].ref, want_position, points, at);
  return norm(at[0].s - at[1].s) <= norm(at[2].s - at[3].s);
}

}  // namespace carreau
