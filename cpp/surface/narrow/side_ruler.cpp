// SPDX-License-Identifier: BSD-3-Clause
#include "surface/narrow/side_ruler.h"

#include <algorithm>

#include "model/traces.h"
#include "surface/narrow/thresholds.h"

namespace carreau {

SideRuler::SideRuler(const CurveModel& model, int face, const Side& side) : start_{0} {
  for (const SidePart& part : side) {
    const CurveSupport& support = model.supports[face][part.curve];
    const int curve = model.topology.curve_of[face][part.curve];
    const auto& uses = model.topology.curves[curve].uses;
    const auto use = std::find_if(uses.begin(), uses.end(),
                                  [&](const CurveUse& u) { return u.face == face && u.curve == part.curve; });
    parts_.push_back({curve, use->reversed != part.back});
    // The last point of a part and the first of the next one stand for one corner, however far apart they are.
    for (std::size_t i = points_.empty() ? 0 : 1; i < support.xyz.size(); ++i) {
      const std::size_t k = part.back ? support.xyz.size() - 1 - i : i;
      points_.push_back(support.xyz[k]);
      arc_.push_back(start_.back() + (part.back ? support.length() - support.arc[k] : support.arc[k]));
    }
    start_.push_back(start_.back() + support.length());
  }
}

SideRuler::Place SideRuler::place_of(const Vec3& p) const {
  Place place;
  const TracePlace nearest = nearest_on_trace(points_, p);
  place.s = arc_[nearest.segment] + nearest.share * (arc_[nearest.segment + 1] - arc_[nearest.segment]);
  place.part =
      static_cast<std::size_t>(std::upper_bound(start_.begin() + 1, start_.end() - 1, place.s) - start_.begin()) - 1;
  const double length = start_[place.part + 1] - start_[place.part];
  const double along = length > 0 ? std::clamp((place.s - start_[place.part]) / length, 0.0, 1.0) : 0;
  place.r = parts_[place.part].against ? 1 - along : along;
  return place;
}

Vec3 SideRuler::point_at(double s) const {
  const auto above = std::upper_bound(arc_.begin() + 1, arc_.end() - 1, s);
  const auto k = static_cast<std::size_t>(above - arc_.begin());
  const double length = arc_[k] - arc_[k - 1];
  return length > 0 ? lerp(points_[k - 1], points_[k], std::clamp((s - arc_[k - 1]) / length, 0.0, 1.0)) : points_[k];
}

double same_place_distance(const NarrowFace& narrow, const SideRuler& side) {
  return std::max(thresholds::narrow::same_place * narrow.width, thresholds::narrow::place_accuracy * side.length());
}

}  // namespace carreau
