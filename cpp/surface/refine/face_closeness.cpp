// SPDX-License-Identifier: BSD-3-Clause
#include "surface/refine/face_closeness.h"

#include <algorithm>

#include "surface/refine/thresholds.h"

namespace carreau {
namespace {

using namespace thresholds::refine;

bool is_alone(const Topology& topology, int face) {
  const std::vector<int>& curves = topology.curve_of[face];
  return std::all_of(curves.begin(), curves.end(), [&](int c) {
    const std::vector<CurveUse>& uses = topology.curves[c].uses;
    return std::all_of(uses.begin(), uses.end(), [&](const CurveUse& use) { return use.face == face; });
  });
}

/// Length of a segment in sizes.
double relative_length(const CurveModel& model, const DiscreteCurve& curve, int segment) {
  const double length = (curve.r[segment + 1] - curve.r[segment]) * model.length(curve.curve);
  return length / std::min(curve.size[segment], curve.size[segment + 1]);
}

/// Length of the curves of a face in sizes.
double relative_perimeter(const CurveModel& model, const std::vector<DiscreteCurve>& curves, int face) {
  double around = 0;
  for (const int c : model.topology.curve_of[face])
    for (int k = 0; k < curves[c].segments(); ++k) around += relative_length(model, curves[c], k);
  return around;
}

/// Area over half the perimeter, by the area in (u, v) and the stretch of the surface at places of the boundary. Right
/// for strips, where these are all near.
double mean_width(const CurveModel& model, int face, const PlaneDomain& plane) {
  const int ref = model.model.faces[face].ref;
  double area = 0, perimeter = 0, stretch = 0;
  for (const PlaneEdge& e : plane.edges)
    if (bounds(e)) area += cross(plane.vertices[e.a] - plane.vertices[0], plane.vertices[e.b] - plane.vertices[0]) / 2;
  for (const int c : model.topology.curve_of[face]) perimeter += model.length(c);
  const std::size_t n = std::min(std::size_t{16}, plane.edges.size());
  for (std::size_t i = 0; i < n; ++i) {
    const PlaneEdge& e = plane.edges[i * plane.edges.size() / n];
    const SurfaceJet jet = surface_at(model.cad, ref, want_first, lerp(plane.vertices[e.a], plane.vertices[e.b], 0.5));
    stretch += norm(cross(jet.su, jet.sv)) / static_cast<double>(n);
  }
  return perimeter > 0 ? 2 * std::abs(area) * stretch / perimeter : 0;
}

}  // namespace

FaceCloseness::FaceCloseness(const CurveModel& model, const std::vector<DiscreteCurve>& curves,
                             std::span<const std::optional<FaceDomain>> domains, const CompositeOptions& options)
    : model_(model), faces_(model.model.faces.size(), {.coefficient = options.coef_rectangle}) {
  if (options.narrow_faces != NarrowFaces::collapse || options.coef_rectangle >= coefficient_alone) return;
  for (int f = 0; f < static_cast<int>(faces_.size()); ++f) {
    if (!domains[f] || !is_alone(model.topology, f)) continue;
    const std::vector<double>& size = domains[f]->size;
    const double widest = coefficient_alone * *std::min_element(size.begin(), size.end());
    if (!(mean_width(model, f, domains[f]->plane) < widest)) continue;
    const double length = relative_perimeter(model, curves, f) / 2;
    faces_[f] = {.coefficient = coefficient_alone, .finest = 1 / std::max(1.0, length)};
  }
}

bool FaceCloseness::is_fine(int face, const DiscreteCurve& curve, int segment) const {
  return relative_length(model_, curve, segment) <= faces_[face].finest;
}

}  // namespace carreau
