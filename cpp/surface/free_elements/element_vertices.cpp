// SPDX-License-Identifier: BSD-3-Clause
#include "surface/free_elements/element_vertices.h"

#include <utility>

#include "support/infinity.h"

namespace carreau {

WantedSize FreeSurface::wanted_at(std::span<const SurfacePlace> places) const {
  return scaled(charts_.wanted(places), factor_);
}

ElementVertices::ElementVertices(const FreeMesh& mesh) : by_direction_(mesh.by_direction()) {
  for (std::size_t k = 0; k < mesh.vertices(); ++k) {
    const auto v = static_cast<std::int32_t>(k);
    place_.push_back(mesh.place(v));
    wanted_.push_back(mesh.wanted(v));
    several_.push_back(mesh.is_free(v) ? -1 : static_cast<std::int32_t>(kept_.size()));
    if (!mesh.is_free(v)) kept_.emplace_back(mesh.places(v).begin(), mesh.places(v).end());
  }
}

std::span<const SurfacePlace> ElementVertices::places(std::int32_t v) const {
  if (several_[v] < 0) return {&place_[v], 1};
  return kept_[several_[v]];
}

const SurfacePlace& ElementVertices::place_towards(std::int32_t v, const Vec3& normal) const {
  const SurfacePlace* best = &place_[v];
  double most = -infinity;
  for (const SurfacePlace& p : places(v))
    if (const double here = dot(p.normal, normal); p.regular && here > most) most = here, best = &p;
  return *best;
}

double ElementVertices::size_along(std::int32_t v, std::int32_t w) const {
  if (!by_direction_) return wanted_[v].h;
  const Vec3 d = position(w) - position(v);
  const double l = carreau::length(wanted_[v].metric, d);
  return l > 0 ? norm(d) / l : wanted_[v].h;
}

std::int32_t ElementVertices::add(const SurfacePlace& place, const WantedSize& wanted) {
  place_.push_back(place);
  wanted_.push_back(wanted);
  several_.push_back(-1);
  return static_cast<std::int32_t>(place_.size()) - 1;
}

std::int32_t ElementVertices::add_kept(KeptPlaces places, const WantedSize& wanted) {
  const std::int32_t v = add(places.front(), wanted);
  several_[v] = static_cast<std::int32_t>(kept_.size());
  kept_.push_back(std::move(places));
  return v;
}

void ElementVertices::scale_sizes(double factor) {
  for (WantedSize& w : wanted_) w = scaled(w, factor);
}

}  // namespace carreau
