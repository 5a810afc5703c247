// SPDX-License-Identifier: BSD-3-Clause
// Bounds by the distance of boundaries and faces from each other.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "gradation/facing.h"
#include "gradation/proximity.h"
#include "surface/grade/graph_sizes.h"
#include "surface/grade/thresholds.h"

namespace carreau::detail {

using thresholds::grade::graph_share;

// Makes n = options.proximity layers between two boundaries; if sizes differ by direction, across the gap only. Edges
// of a unit mesh are up to sqrt(2) sizes long. A way of n - 1 edges does not cross the gap if (n - 1) sqrt(2) h is less
// than the gap. Up to three layers a size of gap / n is enough.
void bound_narrow_zones(GradingWork& work) {
  const double layers = work.options.proximity, share = 1 / std::max(layers, (layers - 1) * std::numbers::sqrt2);
  std::vector<double> wanted = work.h;  // diag if no size is known
  for (double& h : wanted) h = std::min(h, work.largest / graph_share);
  for (const NarrowPlace& n : find_narrow_places(work.graph, work.sides, wanted, work.monitor))
    work.sizes->bound_across(n.vertex, n.across, n.gap * share);
}

namespace {

double smallest_size(const GradingWork& work) {
  const SizeParameters& size = work.options.size;
  if (size.physical == PhysicalSizes::ignored) return size.hgeomin;
  return size.geometric == GeometricSizes::ignored ? size.hphymin : std::min(size.hphymin, size.hgeomin);
}

}  // namespace

// Bounds sizes between two faces that face each other by the gap over the number of layers, in all directions of both
// faces.
void bound_facing_faces(GradingWork& work) {
  std::vector<std::vector<int>> points(work.model.model.faces.size());
  for (const Curve& c : work.model.topology.curves)
    for (const CurveUse& use : c.uses) points[use.face].insert(points[use.face].end(), {c.end1, c.end2});
  const auto apart = [&](int p, int q) {
    const int f = face_of(work, p), g = face_of(work, q);
    if (f == g) return false;
    return std::find_first_of(points[f].begin(), points[f].end(), points[g].begin(), points[g].end()) ==
           points[f].end();
  };
  const double layers = work.options.proximity;
  const auto reach = [&](int p) {
    return layers * std::min(work.sizes->largest_at(p), work.largest / graph_share);  // diag if no size is known
  };
  for (const FacingPlace& f : find_facing_places(work.graph, reach, apart, work.monitor))
    // A gap that no allowed size resolves is contact.
    if (const double h = f.gap / layers; h >= smallest_size(work)) work.sizes->bound_facing(f, h);
}

// Places of a face are numbered together; a face without any has the first of the next one.
int face_of(const GradingWork& work, int place) {
  const auto after = std::upper_bound(work.place_of.begin(), work.place_of.end(), static_cast<std::size_t>(place));
  return static_cast<int>(after - work.place_of.begin()) - 1;
}

}  // namespace carreau::detail
