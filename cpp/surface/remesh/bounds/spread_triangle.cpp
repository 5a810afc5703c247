// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/bounds/spread_triangle.h"

#include <algorithm>
#include <utility>

#include "surface/remesh/bounds/pole.h"
#include "surface/remesh/bounds/thresholds.h"

namespace carreau {

Vec3 SpreadTriangle::flat(const std::array<double, 3>& weight) const {
  return weight[0] * corner_[0] + weight[1] * corner_[1] + weight[2] * corner_[2];
}

void SpreadTriangle::set_pole(std::vector<SurfacePlace> ends) {
  int pole = -1, regular = 0;
  for (int i = 0; i < 3; ++i) place_[i].regular ? ++regular : pole = i;
  if (regular == 2) pole_ = pole, ends_ = std::move(ends);
}

std::optional<SurfacePlace> SpreadTriangle::over(const std::array<double, 3>& weight) const {
  if (pole_ >= 0)
    if (const auto found = below_pole(weight)) return found;
  return near(weight);
}

std::optional<SurfacePlace> SpreadTriangle::below_pole(const std::array<double, 3>& weight) const {
  std::array<double, 3> across = weight;
  across[pole_] = 0;
  const double rest = across[(pole_ + 1) % 3] + across[(pole_ + 2) % 3];
  if (!(rest > 0)) return {};
  for (double& w : across) w /= rest;
  const auto below = near(across);
  if (!below || !below->regular || weight[pole_] == 0) return below;
  const SurfacePlace* end = nullptr;
  std::array<Vec2, 2> box{below->foot.uv, below->foot.uv};
  for (const SurfacePlace& p : ends_) {
    if (charts_.face(p.foot) != charts_.face(below->foot)) continue;
    end = &p;
    for (int i = 0; i < 2; ++i) box[0][i] = std::min(box[0][i], p.foot.uv[i]), box[1][i] = std::max(box[1][i], p.foot.uv[i]);
  }
  if (end == nullptr) return {};
  const Vec2 to = arrival_at_pole(end->foot.uv, {end->su, end->sv}, below->foot.uv, {below->su, below->sv}, corner_[pole_] - below->xyz, box);
  const SurfacePlace found = charts_.evaluate(cad_, {below->foot.triangle, lerp(below->foot.uv, to, weight[pole_])});
  return found.regular ? std::optional(found) : std::nullopt;
}

std::optional<SurfacePlace> SpreadTriangle::near(const std::array<double, 3>& weight) const {
  const Vec3 target = flat(weight);
  std::array<int, 3> order{0, 1, 2};
  const auto put_in_order = [&](int i, int j) {
    if (weight[order[i]] < weight[order[j]]) std::swap(order[i], order[j]);
  };
  put_in_order(0, 1), put_in_order(1, 2), put_in_order(0, 1);
  for (const int i : order)
    if (place_[i].regular)
      if (const auto found = charts_.towards(cad_, place_[i], target, true, thresholds::bounds::near_foot)) return found;
  return {};
}

// Normals of places have the side of the atlas.
Vec3 SpreadTriangle::normal(const SurfacePlace& place) const { return turned_ ? Vec3(-place.normal) : place.normal; }

}  // namespace carreau
