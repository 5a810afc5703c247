#include "surface/sample/edge_growth.h"

#include <algorithm>

namespace carreau {

namespace {

// Triangles. Smaller meshes are made as they are: whether they are right is not worth sampling again.
constexpr double few_triangles = 10'000;
// Times. Straight distances and rounding of a sound control space leave 1.3 at most (tests/cpp/surface/sample).
constexpr double most_excess = 2;
// Times. Of one try to the next.
constexpr double raise = 8;

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
  EdgeSizes edges = *input.limits.edges;
  const double extent = extent_of(input.curve_xyz);
  if (space.measure() <= few_triangles + edges.triangles_within(extent)) return {};
  PatchInput tried = input;
  tried.limits.edges = nullptr;
  ControlSpace without = sample_face(tried, cad, rules, probe_points, monitor);
  const auto bearable = [&](const ControlSpace& s) {
    return s.measure() <= most_excess * (without.measure() + edges.triangles_within(extent));
  };
  if (bearable(space)) return {};
  for (double least = raise * edges.smallest(); least < extent; least *= raise) {
    edges = edges.bounded_below(least);
    tried.limits.edges = &edges;
    space = sample_face(tried, cad, rules, probe_points, monitor);
    if (bearable(space)) return edges;
  }
  space = std::move(without);
  return EdgeSizes();
}

}  // namespace carreau
