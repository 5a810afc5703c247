// SPDX-License-Identifier: BSD-3-Clause
#include "surface/refine/seam_loops.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <utility>

#include "support/shares.h"
#include "surface/domain/domain_check.h"
#include "surface/domain/thresholds.h"
#include "surface/refine/thresholds.h"

namespace carreau {
namespace {

using namespace thresholds::refine;

// The first two uses of a curve in a face; -1, -1 if the curve is not a seam.
std::pair<int, int> sides_of(const Curve& shape, int face) {
  int first = -1;
  for (int u = 0; u < static_cast<int>(shape.uses.size()); ++u) {
    if (shape.uses[u].face != face) continue;
    if (first >= 0) return {first, u};
    first = u;
  }
  return {-1, -1};
}

/// A place on a seam: at a vertex (even ranks) or halfway between two.
struct Place {
  double s = 0;       // arc length
  double around = 0;  // pi times the thickness
  bool looked_at = true;
};

std::vector<Place> places_on(const CurveModel& model, const DiscreteCurve& seam, int face, int one, int other) {
  const auto at = [&](Vec2 uv) { return surface_at(model.cad, model.model.faces[face].ref, want_position, uv).s; };
  std::vector<Place> places;
  const double length = model.length(seam.curve);
  for (int i = 0; i <= 2 * seam.segments(); ++i) {
    const int k = i / 2, next = (i + 1) / 2;
    const Vec2 p = lerp(seam.uv_of_use[one][k], seam.uv_of_use[one][next], 0.5);
    const Vec2 q = lerp(seam.uv_of_use[other][k], seam.uv_of_use[other][next], 0.5);
    places.push_back({.s = length * 0.5 * (seam.r[k] + seam.r[next]),
                      .around = std::numbers::pi * norm(at(lerp(p, q, 0.5)) - at(p))});
    // Left to long triangles, or a pole.
    places.back().looked_at =
        places.back().around >= thresholds::domain::narrowest_share * std::min(seam.size[k], length);
  }
  return places;
}

/// Thickness in proportion to the distance from a pole does not make a waist.
template <typename Iterator>
void leave_to_pole(Iterator pole, Iterator end) {
  if (pole->looked_at) return;
  double steepest = 0;
  for (Iterator it = std::next(pole); it != end; ++it) {
    const double s = std::abs(it->s - pole->s);
    if (!(s > 0)) continue;
    steepest = std::max(steepest, it->around / s);
    if (it->around >= shares::reserve * s * steepest) it->looked_at = false;
  }
}

}  // namespace

std::vector<int> edges_to_split_for_waists(const CurveModel& model, const std::vector<DiscreteCurve>& curves, int face,
                                           const PlaneDomain& domain, double coef) {
  std::map<int, std::vector<char>> long_segments;  // by curve
  for (const int c : model.topology.curve_of[face]) {
    const auto [one, other] = sides_of(model.topology.curves[c], face);
    if (other < 0 || model.topology.curves[c].degenerate || long_segments.contains(c)) continue;
    const DiscreteCurve& seam = curves[c];
    std::vector<Place> places = places_on(model, seam, face, one, other);
    leave_to_pole(places.begin(), places.end());
    leave_to_pole(places.rbegin(), places.rend());
    std::vector<char>& segments = long_segments[c];
    for (int k = 0; k < seam.segments(); ++k) {
      const double reach = coef * norm(seam.xyz[k + 1] - seam.xyz[k]);
      segments.push_back(std::any_of(places.begin() + 2 * k, places.begin() + 2 * k + 3,
                                     [&](const Place& p) { return p.looked_at && p.around < reach; }));
    }
  }
  std::vector<int> split;
  if (long_segments.empty()) return split;
  for (int e = 0; e < static_cast<int>(domain.edges.size()); ++e)
    if (const auto seam = long_segments.find(domain.edges[e].curve);
        seam != long_segments.end() && seam->second[domain.edges[e].segment] != 0)
      split.push_back(e);
  return split;
}

}  // namespace carreau
