// SPDX-License-Identifier: BSD-3-Clause
#include "surface/refine/staggering.h"

#include <algorithm>
#include <map>
#include <utility>

#include "mesh/quality.h"
#include "predicates/polygon_locator.h"
#include "support/segment.h"
#include "support/stepped_tasks.h"
#include "support/work_bounds.h"
#include "surface/domain/domain_graph.h"
#include "surface/domain/near_vertices.h"
#include "surface/refine/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::refine;

using Pair = std::pair<int, int>;  // curves, the lower index first

/// Curves of a face that face each other over half of the shorter one or more.
class FacingCurves {
 public:
  FacingCurves(const FaceDomain& domain, const std::vector<DiscreteCurve>& curves, const Topology& topology)
      : domain_(domain), xyz_(positions_on_curves(domain, curves, topology)) {}

  std::vector<Pair> find(const std::vector<DiscreteCurve>& curves) {
    NearVertices near(xyz_);
    std::map<Pair, int> edges;
    for (const PlaneEdge& e : domain_.plane.edges) {
      if (e.kind == PlaneEdgeKind::degenerate || static_cast<std::size_t>(std::max(e.a, e.b)) >= xyz_.size()) continue;
      const Vec3 a = xyz_[e.a], b = xyz_[e.b];
      std::vector<Pair> seen;
      near.each_beside(a, b, widest * norm(b - a), [&](int v) {
        const Pair pair = std::minmax(e.curve, domain_.origin[v].curve);
        if (domain_.origin[v].corner < 0 && pair.first != pair.second &&
            std::find(seen.begin(), seen.end(), pair) == seen.end() && sees(e, v))
          seen.push_back(pair);
        return true;
      });
      for (const Pair& pair : seen) ++edges[pair];
    }
    std::vector<Pair> facing;
    for (const auto& [pair, count] : edges)
      if (count >= std::min(curves[pair.first].segments(), curves[pair.second].segments())) facing.push_back(pair);
    return facing;
  }

 private:
  // Returns whether the domain lies between an edge and a vertex.
  [[nodiscard]] bool sees(const PlaneEdge& e, int v) {
    if (!inside_) inside_.emplace(domain_.plane.vertices, bounding_edges(domain_.plane));
    const double s = fraction_on_segment(xyz_[v], xyz_[e.a], xyz_[e.b]);
    const std::vector<Vec2>& uv = domain_.plane.vertices;
    return inside_->contains(lerp(uv[v], lerp(uv[e.a], uv[e.b], s), 0.5));
  }

  const FaceDomain& domain_;
  std::vector<Vec3> xyz_;
  std::optional<PolygonLocator> inside_;
};

/// The defect 1 - Q2 of Delaunay's triangles over the edges of a polyline, summed up over the triangles that face
/// `near`.
struct Lack {
  double sum = 0, worst = 1;
  int edges = 0;

  void add(const std::vector<Vec3>& line, NearVertices near, const std::vector<Vec3>& points) {
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const Vec3 a = line[k], b = line[k + 1];
      double min_cosine = 1, quality = -1;  // none
      near.each_beside(a, b, widest * norm(b - a), [&](int v) {
        const Vec3 to_a = a - points[v], to_b = b - points[v];
        const double cosine = dot(to_a, to_b) / (norm(to_a) * norm(to_b));
        if (cosine < min_cosine) min_cosine = cosine, quality = quality_q2(a, b, points[v]);
        return true;
      });
      if (quality >= 0) sum += 1 - quality, worst = std::min(worst, quality), ++edges;
    }
  }
  [[nodiscard]] double mean() const { return edges > 0 ? sum / edges : 0; }
};

Lack lack_between(const std::vector<Vec3>& p, const std::vector<Vec3>& q) {
  Lack lack;
  lack.add(p, NearVertices(q), q);
  lack.add(q, NearVertices(p), p);
  return lack;
}

// Vertices on the curve: on a chord, an arc would seem farther from the side towards which it bulges.
std::vector<Vec3> staggered(DiscreteCurve curve, const CurveModel& model) {
  stagger(curve, model);
  return curve.xyz;
}

/// Curves that may be moved: no curve that ends at a sharp corner of a face.
std::vector<char> movable_curves(const CurveModel& model, const std::vector<DiscreteCurve>& curves,
                                 std::span<const std::optional<FaceDomain>> domains) {
  std::vector<char> may;
  for (const DiscreteCurve& c : curves)
    may.push_back(
        !c.indivisible && !c.prescribed && !model.curve(c.curve).degenerate && c.segments() >= fewest_segments ? 1 : 0);
  for (const auto& domain : domains) {
    if (!domain) continue;
    const std::vector<Vec3> xyz = positions_on_curves(*domain, curves, model.topology);
    std::vector<std::vector<int>> at(xyz.size());  // edges at corners
    for (std::size_t e = 0; e < domain->plane.edges.size(); ++e)
      for (const int v : {domain->plane.edges[e].a, domain->plane.edges[e].b})
        if (static_cast<std::size_t>(v) < xyz.size() && domain->origin[v].corner >= 0)
          at[v].push_back(static_cast<int>(e));
    for (std::size_t v = 0; v < at.size(); ++v)
      for (std::size_t i = 0; i < at[v].size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
          const PlaneEdge &p = domain->plane.edges[at[v][i]], &q = domain->plane.edges[at[v][j]];
          const auto away = [&](const PlaneEdge& e) -> Vec3 {
            return xyz[static_cast<std::size_t>(e.a) == v ? e.b : e.a] - xyz[v];
          };
          if (dot(away(p), away(q)) > sharp_cosine * norm(away(p)) * norm(away(q))) may[p.curve] = may[q.curve] = 0;
        }
  }
  return may;
}

}  // namespace

std::vector<int> curves_to_stagger(const CurveModel& model, const std::vector<DiscreteCurve>& curves,
                                   std::span<const std::optional<FaceDomain>> domains, int threads, Monitor& monitor) {
  const std::vector<char> may_move = movable_curves(model, curves, domains);
  std::vector<std::vector<std::pair<Pair, double>>> in_face(domains.size());
  const auto look = [&](std::size_t f, Monitor& of_task) {
    of_task.checkpoint();
    if (!domains[f]) return;
    for (const Pair& pair : FacingCurves(*domains[f], curves, model.topology).find(curves)) {
      const int c = pair.first, d = pair.second;
      const bool first = may_move[c] != 0;
      if (!first && may_move[d] == 0) continue;
      const DiscreteCurve& moved = curves[first ? c : d];
      const std::vector<Vec3>& other = curves[first ? d : c].xyz;
      const Lack now = lack_between(moved.xyz, other);
      const Lack then = lack_between(staggered(moved, model), other);
      in_face[f].emplace_back(pair,
                              then.worst < largest_fall * now.worst ? -1e9  // no sum outweighs it
                                                                    : now.edges * (now.mean() - then.mean()));
    }
  };
  run_each(domains.size(), !model.cad.reentrant(), threads, look, monitor);
  std::map<Pair, double> gain;  // when one of the two is moved, or both are, no matter which
  for (const auto& found : in_face)
    for (const auto& [pair, g] : found) gain[pair] += g;
  std::map<int, std::vector<std::pair<int, double>>> beside;
  for (const auto& [pair, g] : gain) {
    beside[pair.first].emplace_back(pair.second, g);
    beside[pair.second].emplace_back(pair.first, g);
  }
  std::vector<char> moved(curves.size(), 0);
  for (int pass = 0; pass < work_bounds::rounds; ++pass) {
    bool any = false;
    for (const auto& [c, others] : beside) {
      if (may_move[c] == 0) continue;
      double sum = 0;  // of a change of this one
      for (const auto& [d, g] : others) sum += moved[c] == moved[d] ? g : -g;
      if (moved[c] != 0 ? sum + min_curve_gain <= 0 : sum <= min_curve_gain) continue;
      moved[c] = moved[c] == 0 ? 1 : 0;
      any = true;
    }
    if (!any) break;
  }
  std::vector<int> result;
  for (std::size_t c = 0; c < moved.size(); ++c)
    if (moved[c] != 0) result.push_back(static_cast<int>(c));
  return result;
}

void stagger(DiscreteCurve& curve, const CurveModel& model) {
  std::vector<double> inside;
  for (int k = 0; k < curve.segments(); ++k) inside.push_back((curve.r[k] + curve.r[k + 1]) / 2);
  place_vertices(curve, inside, model);
}

}  // namespace carreau
