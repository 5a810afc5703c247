// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/bounds/spread_places.h"

#include <algorithm>
#include <cmath>

#include "surface/remesh/bounds/thresholds.h"
#include "support/infinity.h"

namespace carreau {

using namespace thresholds::bounds;

SpreadPlaces::SpreadPlaces(const SpreadTriangle& triangle, const BoundedTriangle& flat) : flat_(flat), triangle_(triangle) {
  for (std::size_t i = 0; i < looks_.size(); ++i) looks_[i] = look(TriangleBound::lattice()[i]);
  curvature_ = curvature_of(looks_);
  known_ = true;
  for (Look& each : looks_)
    if (!(norm(each.normal) > 0) && each.length > 0) lean_on_others(each);
}

// Corners are on the surface.
SpreadPlaces::Look SpreadPlaces::look(const PlaceInTriangle& place) const {
  const std::array<double, 3> weight{1 - place.x() - place.y(), place.x(), place.y()};
  Look look{triangle_.flat(weight), {0, 0, 0}, {0, 0, 0}, true, 0};
  if (const int pole = triangle_.pole(); pole >= 0) look.length = weight[pole] == 1 ? 0 : 1 - weight[pole];
  for (std::size_t i = 0; i < 3; ++i)
    if (weight[i] == 1) {
      const SurfacePlace& corner = triangle_.corner(i);
      look.offset = corner.xyz - look.flat;
      if (corner.regular)
        look.normal = triangle_.normal(corner);
      else if (known_ && look.length > 0)
        lean_on_others(look);
      return look;
    }
  const auto nearest = std::ranges::min_element(flat_.p, {}, [&](const Vec3& p) { return norm(p - look.flat); });
  look.offset = *nearest - look.flat;
  const auto found = triangle_.over(weight);
  // A place farther than a corner belongs to another part of the surface.
  look.found = found && norm(found->xyz - look.flat) < norm(look.offset);
  if (look.found)
    look.offset = found->xyz - look.flat, look.normal = triangle_.normal(*found);
  else if (known_)
    lean_on_others(look);
  return look;
}

// The surface goes on beside the nearest place that was found.
void SpreadPlaces::lean_on_others(Look& look) const {
  double nearest = infinity;
  Vec3 normal{0, 0, 0}, offset = look.offset;
  for (const Look& other : looks_) {
    if (!other.found || other.away > 0 || !(norm(other.normal) > 0)) continue;
    const Vec3 there = other.flat + other.offset - look.flat;
    if (norm(there) < nearest) nearest = norm(there), offset = there, normal = other.normal;
  }
  if (nearest == infinity) return;
  look.normal = normal, look.away = nearest;
  if (!look.found) look.offset = offset;
}

// The curvature, by the differences of normals between places.
double SpreadPlaces::curvature_of(const std::array<Look, TriangleBound::lattice_size>& looks) const {
  double most = 0;
  for (std::size_t i = 0; i < looks.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vec2 step = TriangleBound::lattice()[i] - TriangleBound::lattice()[j];
      if (std::max({std::abs(step.x()), std::abs(step.y()), std::abs(step.x() + step.y())}) > 0.3) continue;
      if (norm(looks[i].normal) > 0 && norm(looks[j].normal) > 0)
        most = std::max(most, norm(looks[i].normal - looks[j].normal) / norm(looks[i].flat - looks[j].flat));
    }
  return 2 * most;
}

// The distance of the tangent plane, and the bend of the surface away from it beside the place that was found. Otherwise the distance of a
// corner.
BoundPlace SpreadPlaces::over(const Look& look) const {
  double nearest = norm(look.offset);
  for (const Vec3& p : flat_.p) nearest = std::min(nearest, norm(p - look.flat));
  if (look.length == 0) return {look.flat, {0, 0, 0}, 0};
  if (!(norm(look.normal) > 0)) {
    has_normals_ = false;
    return {look.flat + nearest * flat_.normal, {0, 0, 0}, 0};
  }
  const double height = dot(look.offset, look.normal), beside = norm(look.offset - height * look.normal);
  const double distance = std::min(nearest, std::abs(height) + curvature_ * beside * beside / 2);
  const double signed_distance = std::copysign(distance, height * dot(look.normal, flat_.normal));
  return {look.flat + signed_distance * flat_.normal, look.length * look.normal, curvature_ * look.away};
}

std::array<BoundPlace, TriangleBound::lattice_size> SpreadPlaces::lattice() const {
  std::array<BoundPlace, TriangleBound::lattice_size> places;
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = over(looks_[i]);
  return places;
}

}  // namespace carreau
