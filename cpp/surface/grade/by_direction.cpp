// SPDX-License-Identifier: BSD-3-Clause
// The part of the gradation that is about sizes that differ by direction.
#include <algorithm>
#include <cmath>

#include "support/infinity.h"
#include "surface/grade/kinds.h"
#include "surface/grade/thresholds.h"

namespace carreau::detail {

namespace {

using namespace thresholds::grade;

// The unit tangent of a curve at a vertex, in the tangent plane of a place.
Vec3 tangent(const GradingWork& work, std::size_t c, std::size_t node, int place) {
  const std::vector<Vec3>& xyz = work.curves[c].xyz;
  const std::size_t last = xyz.size() - 1;
  const Vec3 chord = xyz[std::min(node + 1, last)] - xyz[node > 0 ? node - 1 : 0], n = work.graph.places[place].normal;
  return unit(chord - dot(chord, n) * n);
}

// In faces that the curve bounds or crosses: from others at its ends it may point anywhere.
std::vector<int> places_on(const GradingWork& work, std::size_t c, std::size_t node) {
  const std::vector<CurveUse>& uses = work.model.topology.curves[c].uses;
  std::vector<int> places;
  for (const int p : work.places_of[work.node_of[c][node]])
    if (std::any_of(uses.begin(), uses.end(), [f = face_of(work, p)](const CurveUse& use) { return use.face == f; }))
      places.push_back(p);
  return places;
}

// Sizes of curves are sizes along them.
void bound_by_curve(GradingWork& work, std::size_t c, const SizeSamples& raw) {
  if (work.curves[c].indivisible) return;
  for (std::size_t k = 0; k < work.curves[c].r.size(); ++k) {
    const double h = raw.size_at(work.curves[c].r[k]);
    for (const int p : places_on(work, c, k)) {
      const Vec3 t = tangent(work, c, k, p);
      // What is interpolated between samples differs a little from what holds at vertices.
      if (work.metric[p].along(t) > (1 + interpolation_error) * h) work.metric[p].bound_along(t, h);
    }
  }
}

// A point that is smaller than its curves has a size of its own.
void bound_by_points(GradingWork& work, const std::vector<SizeSamples>& raw) {
  const Topology& topology = work.model.topology;
  std::vector<double> of_curves(topology.points.size(), infinity);
  for (std::size_t c = 0; c < raw.size(); ++c) {
    if (work.curves[c].indivisible) continue;
    const Curve& curve = topology.curves[c];
    of_curves[curve.end1] = std::min(of_curves[curve.end1], raw[c].h.front());
    of_curves[curve.end2] = std::min(of_curves[curve.end2], raw[c].h.back());
  }
  for (std::size_t v = 0; v < of_curves.size(); ++v) {
    const double h = work.rules.at_point(static_cast<int>(v));
    if (h > (1 - interpolation_error) * of_curves[v]) continue;
    for (const int p : work.places_of[v]) {
      work.metric[p].h1 = std::min(work.metric[p].h1, h);
      work.metric[p].h2 = std::min(work.metric[p].h2, h);
    }
  }
}

// Where some size is smaller than the vertex's own, or some sample than what corners promise.
void find_rough(GradedFace& face, const TangentMetric* prescribed, const std::vector<GradingWork::Sample>& samples) {
  const auto less = [](double p, double q) { return p < (1 - roughness) * q; };
  for (std::size_t t = 0; t < face.triangles.size(); ++t)
    for (const std::int32_t v : face.triangles[t])
      if (less(face.metric[v].h1, prescribed[v].h1) || less(face.metric[v].h2, prescribed[v].h2)) face.smooth[t] = 0;
  for (const GradingWork::Sample& s : samples) {
    double h1 = 0, h2 = 0;
    for (int i = 0; i < 3; ++i) {
      const TangentMetric& corner = face.metric[face.triangles[s.triangle][i]];
      h1 += s.promised[i] * corner.matched(s.sizes.d1);
      h2 += s.promised[i] * corner.matched(s.sizes.d2);
    }
    if (less(s.sizes.h1, (1 - rough_metric) * h1) || less(s.sizes.h2, (1 - rough_metric) * h2))
      face.smooth[s.triangle] = 0;
  }
  widen_rough(face);
}

}  // namespace

void DirectionalGrading::run(const std::vector<SizeSamples>& raw, double slope) {
  for (std::size_t c = 0; c < raw.size(); ++c) bound_by_curve(work_, c, raw[c]);
  bound_by_points(work_, raw);
  work_.metric = grade_metrics(work_.graph, std::move(work_.metric), work_.metric_sources, slope, work_.monitor);
}

double DirectionalGrading::along(int place, const Vec3& direction) const noexcept {
  return work_.metric[place].along(direction);
}

void DirectionalGrading::give_to_face(std::size_t f) {
  GradedFace& face = work_.faces[f];
  const auto first = work_.metric.begin() + static_cast<std::ptrdiff_t>(work_.place_of[f]);
  face.metric.assign(first, first + static_cast<std::ptrdiff_t>(face.uv.size()));
  find_rough(face, work_.prescribed.data() + work_.place_of[f], work_.samples[f]);
}

double DirectionalGrading::at_node(std::size_t c, std::size_t node, const SizeSamples& raw) const {
  double h = raw.size_at(work_.curves[c].r[node]);
  if (work_.curves[c].indivisible) return h;
  for (const int p : places_on(work_, c, node)) h = std::min(h, work_.metric[p].along(tangent(work_, c, node, p)));
  return h;
}

double DirectionalGrading::between_nodes(std::size_t /*curve*/, std::size_t /*node*/, double /*w*/, double h,
                                         double known, const GradedField& /*field*/) const {
  return std::min(h, known);
}

}  // namespace carreau::detail
