// SPDX-License-Identifier: BSD-3-Clause
#include "surface/elements/quads/space_quads.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "surface/elements/quads/quad_shape.h"

namespace carreau {

namespace {

constexpr double min_turned = 1e-9;  // below 0, even if planes disagree

// Any unit vector at right angles.
Vec3 across(const Vec3& normal) noexcept {
  const Vec3 axis = std::abs(normal.x()) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 e = cross(normal, axis);
  return (1 / norm(e)) * e;
}

}  // namespace

std::int32_t SpaceQuads::add_vertex(const SurfacePlace& place, const WantedSize& wanted, bool fixed) {
  place_.push_back(place);
  wanted_.push_back(wanted);
  fixed_.push_back(static_cast<char>(fixed));
  return static_cast<std::int32_t>(place_.size()) - 1;
}

void SpaceQuads::scale_sizes(double factor) {
  for (WantedSize& w : wanted_) w = scaled(w, factor);
}

Vec3 SpaceQuads::area_normal(const MixedCell& cell) const noexcept {
  const auto at = [&](int k) -> const Vec3& { return place_[cell[k]].xyz; };
  const bool quad = corners_of(cell) == 4;
  const Vec3 d = at(2) - at(0), e = quad ? Vec3(at(3) - at(1)) : Vec3(at(0) - at(1));
  return cross(d, e);
}

Vec3 SpaceQuads::surface_normal(const MixedCell& cell) const noexcept {
  Vec3 sum{0, 0, 0};
  for (int k = 0; k < corners_of(cell); ++k) sum += place_[cell[k]].normal;
  const double size = norm(sum);
  if (size > 0) return (1 / size) * sum;
  const Vec3 own = area_normal(cell);
  return norm(own) > 0 ? Vec3((1 / norm(own)) * own) : Vec3{0, 0, 1};
}

bool SpaceQuads::is_convex(const MixedCell& cell) const noexcept {
  const int n = corners_of(cell);
  const Vec3 own = area_normal(cell);
  for (int k = 0; k < n; ++k) {
    const SurfacePlace& corner = place_[cell[k]];
    if (corner.regular && !(dot(own, corner.normal) > 0)) return false;
    const Vec3 to = place_[cell[(k + 1) % n]].xyz - corner.xyz, from = place_[cell[(k + n - 1) % n]].xyz - corner.xyz;
    if (!(dot(own, cross(to, from)) > 0)) return false;
  }
  return true;
}

bool SpaceQuads::has_flat_corner(const MixedCell& cell) const noexcept {
  return carreau::has_flat_corner(fixed_, flat_, cell);
}

SpaceQuads::Frame SpaceQuads::frame(const Vec3& origin, const Vec3& normal, const WantedSize* const* wanted,
                                    int n) const noexcept {
  const Vec3 e1 = across(normal), e2 = cross(normal, e1);
  Metric2 metric{0, 0, 0};
  double h = 0;
  for (int k = 0; k < n; ++k) {
    if (surface_.by_direction()) metric = metric + (1.0 / n) * induced_metric(e1, e2, wanted[k]->metric);
    h += wanted[k]->h / n;
  }
  if (!surface_.by_direction()) metric = {1 / (h * h), 0, 1 / (h * h)};
  constexpr Metric2 none{0, 0, 0};
  return {origin, e1, e2, Chart({0, 0}, {metric, none, none})};
}

SpaceQuads::Frame SpaceQuads::about(const MixedCell& cell) const noexcept {
  const int n = corners_of(cell);
  std::array<const WantedSize*, 4> wanted{};
  Vec3 sum{0, 0, 0};
  for (int k = 0; k < n; ++k) wanted[k] = &wanted_[cell[k]], sum += place_[cell[k]].xyz;
  return frame((1.0 / n) * sum, surface_normal(cell), wanted.data(), n);
}

SpaceQuads::Frame SpaceQuads::about(std::int32_t v) const noexcept {
  const WantedSize* wanted = &wanted_[v];
  const SurfacePlace& at = place_[v];
  return frame(at.xyz, at.regular ? at.normal : Vec3{0, 0, 1}, &wanted, 1);
}

SpaceQuads::Frame SpaceQuads::plane_at(const SurfacePlace& place) noexcept {
  const Vec3 normal = place.regular ? place.normal : Vec3{0, 0, 1}, e1 = across(normal);
  constexpr Metric2 none{0, 0, 0};
  return {place.xyz, e1, cross(normal, e1), Chart({0, 0}, {Metric2{}, none, none})};
}

Vec2 SpaceQuads::at(const Frame& frame, std::int32_t v) const noexcept {
  const Vec3 d = place_[v].xyz - frame.origin;
  return frame.chart.at({dot(d, frame.e1), dot(d, frame.e2)});
}

double SpaceQuads::quality(const Frame& frame, const MixedCell& cell) const noexcept {
  std::array<Vec2, 4> y;
  const int n = corners_of(cell);
  for (int k = 0; k < n; ++k) y[k] = at(frame, cell[k]);
  if (n == 4) return quad_quality(y);
  const Vec2 a = y[1] - y[0], b = y[2] - y[0], c = b - a;
  return std::max(0.0, 2 * std::numbers::sqrt3 * cross(a, b) / (dot(a, a) + dot(b, b) + dot(c, c)));
}

double SpaceQuads::untangling_quality(const Frame& frame, const MixedCell& cell) const noexcept {
  if (is_convex(cell)) return quality(frame, cell);
  const int n = corners_of(cell);
  double least = 1;
  for (int k = 0; k < n; ++k) {
    const Vec2 p = at(frame, cell[k]);
    const Vec2 to = at(frame, cell[(k + 1) % n]) - p, from = at(frame, cell[(k + n - 1) % n]) - p;
    const double sides = norm(to) * norm(from);
    least = std::min(least, sides > 0 ? cross(to, from) / sides : -1);
  }
  return std::min(least, -min_turned);
}

double SpaceQuads::length(std::int32_t a, std::int32_t b) const noexcept {
  const Vec3 d = place_[b].xyz - place_[a].xyz;
  if (!surface_.by_direction()) return 2 * norm(d) / (wanted_[a].h + wanted_[b].h);
  return 0.5 * (carreau::length(wanted_[a].metric, d) + carreau::length(wanted_[b].metric, d));
}

void SpaceQuads::put(std::size_t v, const Place& place) {
  place_[v] = place;
  wanted_[v] = surface_.wanted(place);
}

bool SpaceQuads::settle(std::size_t v, const Place& from) {
  if (!from.regular) return false;
  const std::optional<SurfacePlace> there = surface_.towards(from, place_[v].xyz);
  if (!there) return false;
  put(v, *there);
  return true;
}

void SpaceQuads::move(std::size_t v, const Way& way) {
  const SurfacePlace& from = place_[v];
  if (!from.regular || fixed_[v] != 0) return;
  if (const std::optional<SurfacePlace> there = surface_.towards(from, from.xyz + way)) put(v, *there);
}

}  // namespace carreau
