// SPDX-License-Identifier: BSD-3-Clause
#include "surface/narrow/side_ruler.h"

#include <algorithm>

#include "model/traces.h"

namespace carreau {

SideRuler::SideRuler(const CurveModel& model, int face, const Side& side) : start_{0} {
  for (const SidePart& part : side) {
    const CurveSupport& support = model.supports[face][part.curve];
    const int curve = model.topology.curve_of[face][part.curve];
    const auto& uses = model.topology.curves[curve].uses;
    const auto use = std::find_if(uses.begin(), uses.end(),
                                  [&](const CurveUse& u) { return u.face == face && u.curve == part.curve; });
    parts_.push_back({curve, use->reversed != part.back});
    std::vector<Vec3> points = support.xyz;
    if (part.back) std::reverse(points.begin(), points.end());
    // The last point of a part and the first of the next one stand for one corner, however far apart they are.
    points_.insert(points_.end(), points.begin() + (points_.empty() ? 0 : 1), points.end());
    start_.push_back(trace_length(points_));
  }
}

SideRuler::Place SideRuler::place_of(const Vec3& p) const {
  Place place;
  place.s = nearest_on_trace(points_, p).arc;
  place.part =
      static_cast<std::size_t>(std::upper_bound(start_.begin() + 1, start_.end() - 1, place.s) - start_.begin()) - 1;
  const double length = start_[place.part + 1] - start_[place.part];
  const double along = length > 0 ? std::clamp((place.s - start_[place.part]) / length, 0.0, 1.0) : 0;
  place.r = parts_[place.part].against ? 1 - along : along;
  return place;
}

Vec3 SideRuler::point_at(double s) const {
  const double whole = length();
  return whole > 0 ? trace_point(points_, std::clamp(s / whole, 0.0, 1.0)) : points_.front();
}

}  // namespace carreau
