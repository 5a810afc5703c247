// SPDX-License-Identifier: BSD-3-Clause
#include "surface/sample/edge_growth.h"

#include <algorithm>

#include "surface/sample/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::sample;

double extent_of(const std::vector<Vec3>& points) {
  if (points.empty()) return 0;
  Vec3 low = points.front(), high = low;
  for (const Vec3& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return norm(high - low);
}

}  // namespace

std::optional<EdgeSizes> bound_growth(const PatchInput& input, Cad& cad, const SizeRules& rules,
                                      std::span<const Vec2> probe_points, Monitor& monitor, ControlSpace& space) {
  if (input.limits.edges == nullptr) return {};
  const double extent = extent_of(input.curve_xyz);
  if (space.measure() <= few_triangles + input.limits.edges->triangles_within(extent)) return {};
  EdgeSizes edges = *input.limits.edges;
  PatchInput tried = input;
  tried.limits.edges = nullptr;
  ControlSpace without = sample_face(tried, cad, rules, probe_points, monitor, nullptr);
  const auto bearable = [&](const ControlSpace& s) {
    return s.measure() <= max_growth_excess * (without.measure() + edges.triangles_within(extent));
  };
  if (bearable(space)) return {};
  for (double least = growth_raise * edges.smallest(); least < extent; least *= growth_raise) {
    edges = edges.bounded_below(least);
    tried.limits.edges = &edges;
    space = sample_face(tried, cad, rules, probe_points, monitor, nullptr);
    if (bearable(space)) return edges;
  }
  space = std::move(without);
  return EdgeSizes();
}

}  // namespace carreau
