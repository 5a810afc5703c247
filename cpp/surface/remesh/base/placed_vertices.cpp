// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/base/placed_vertices.h"

#include <utility>

#include "support/infinity.h"

namespace carreau {

const SurfacePlace& PlacedVertices::kept_place_towards(std::int32_t v, const Vec3& normal) const {
  const SurfacePlace* best = &place_[v];
  double most = -infinity;
  for (const SurfacePlace& p : places(v))
    if (const double here = dot(p.normal, normal); p.regular && here > most) most = here, best = &p;
  return *best;
}

double PlacedVertices::size_along(std::int32_t v, std::int32_t w) const {
  if (!by_direction_) return size_[v];
  const Vec3 d = position(w) - position(v);
  const double l = length(metric_[v], d);
  return l > 0 ? norm(d) / l : size_[v];
}

std::int32_t PlacedVertices::add(const SurfacePlace& place, const WantedSize& wanted) {
  place_.push_back(place);
  size_.push_back(wanted.h);
  if (by_direction_) metric_.push_back(wanted.metric);
  several_.push_back(-1);
  return static_cast<std::int32_t>(place_.size()) - 1;
}

std::int32_t PlacedVertices::add_kept(std::vector<SurfacePlace> places, const WantedSize& wanted) {
  const std::int32_t v = add(places.front(), wanted);
  several_[v] = static_cast<std::int32_t>(kept_places_.size());
  kept_places_.push_back(std::move(places));
  return v;
}

void PlacedVertices::remove_last() {
  place_.pop_back(), size_.pop_back(), several_.pop_back();
  if (by_direction_) metric_.pop_back();
}

void PlacedVertices::move(std::int32_t v, const SurfacePlace& place, const WantedSize& wanted) {
  place_[v] = place;
  size_[v] = wanted.h;
  if (by_direction_) metric_[v] = wanted.metric;
}

void PlacedVertices::scale_sizes(double factor) {
  for (std::size_t v = 0; v < place_.size(); ++v) {
    const auto here = static_cast<std::int32_t>(v);
    move(here, place_[v], scaled(wanted(here), factor));
  }
}

}  // namespace carreau
