// SPDX-License-Identifier: BSD-3-Clause
#include "projection/restricted_step.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "projection/thresholds.h"

namespace carreau::projection {

namespace {

namespace limit = thresholds::projection;

/// A border that holds the place: directions d with d . outward > 0 leave the region.
struct Wall {
  Vec2 outward, along;
};

struct Walls {
  std::array<Wall, 5> wall;
  std::size_t count = 0;
  void add(const Vec2& outward) { wall[count++] = {outward, Vec2{-outward.y(), outward.x()}}; }
  [[nodiscard]] bool allow(const Vec2& d) const {
    for (std::size_t i = 0; i < count; ++i)
      if (dot(wall[i].outward, d) > 1e-14 * norm(wall[i].outward) * norm(d)) return false;
    return true;
  }
};

constexpr double on_diagonal = 1e-14;

double share_of_diagonal(const Region& region, const Vec2& p) {
  const Vec2 size = region.size();
  return (p.x() - region.low.x()) / size.x() + (p.y() - region.low.y()) / size.y();
}

Vec2 normal_of_diagonal(const Region& region) { return {1 / region.size().x(), 1 / region.size().y()}; }

Walls walls_at(const Region& region, const Vec2& p) {
  Walls walls;
  if (p.x() <= region.low.x()) walls.add({-1, 0});
  if (p.y() <= region.low.y()) walls.add({0, -1});
  if (p.x() >= region.high.x()) walls.add({1, 0});
  if (p.y() >= region.high.y()) walls.add({0, 1});
  if (region.triangle && share_of_diagonal(region, p) >= 1 - on_diagonal) walls.add(normal_of_diagonal(region));
  return walls;
}

/// Minimises the model over the plane. Works in units of the first fundamental form, so that the result does not depend on the
/// parametrisation.
Vec2 descent_direction(const Vec2& g, const Symmetric2& h, const Symmetric2& form, bool& regular) {
  const double sx = form.xx > 0 ? 1 / std::sqrt(form.xx) : 0, sy = form.yy > 0 ? 1 / std::sqrt(form.yy) : 0;
  const double a = h.xx * sx * sx, b = h.xy * sx * sy, c = h.yy * sy * sy, gx = g.x() * sx, gy = g.y() * sy;
  if (sx == 0 || sy == 0) {  // a singular point, or a curve: one direction is left
    const double one = sx == 0 ? c : a, floor = std::max(std::abs(one), limit::smallest_eigenvalue);
    regular = one > limit::regular_hessian;
    return {-gx * sx / floor, -gy * sy / floor};
  }
  const double mean = (a + c) / 2, half = (a - c) / 2, root = std::sqrt(half * half + b * b);
  const double large = std::max(std::abs(mean + root), std::abs(mean - root)), small = std::min(std::abs(mean + root), std::abs(mean - root));
  if (mean - root > 0 && small > limit::regular_hessian * large) {
    const double det = a * c - b * b;
    regular = true;
    return {-(c * gx - b * gy) / det * sx, -(a * gy - b * gx) / det * sy};
  }
  regular = false;
  double ex = half >= 0 ? half + root : b, ey = half >= 0 ? b : root - half;  // of the eigenvalue mean + root
  const double length = std::sqrt(ex * ex + ey * ey);
  if (length > 0)
    ex /= length, ey /= length;
  else
    ex = 1;
  const double floor = std::max(limit::smallest_eigenvalue * large, 1e-300);
  const double first = -(gx * ex + gy * ey) / std::max(std::abs(mean + root), floor),
               second = -(gy * ex - gx * ey) / std::max(std::abs(mean - root), floor);
  return {(first * ex - second * ey) * sx, (first * ey + second * ex) * sy};
}

/// The best direction along one of the walls; zero when none descends.
Vec2 direction_along(const Walls& walls, const Vec2& g, const Symmetric2& h, const Symmetric2& form, bool& regular) {
  Vec2 best{0, 0};
  double gain = 0;
  for (std::size_t i = 0; i < walls.count; ++i) {
    const Vec2& e = walls.wall[i].along;
    const double slope = dot(g, e), bend = dot(e, h.times(e)), length = dot(e, form.times(e));
    if (!(length > 0)) continue;
    const bool good = bend > limit::regular_hessian * length;
    const Vec2 d = -slope / std::max(std::abs(bend), limit::smallest_eigenvalue * length) * e;
    if (!walls.allow(d) || !(-dot(g, d) > gain)) continue;
    gain = -dot(g, d), best = d, regular = good;
  }
  return best;
}

/// The share of d after which the region ends, at most 1.
double share_inside(const Region& region, const Vec2& p, const Vec2& d) {
  double share = 1;
  const auto bound = [&](double from, double step, double low, double high) {
    if (from + step > high && step > 0) share = std::min(share, std::max(0.0, (high - from) / step));
    if (from + step < low && step < 0) share = std::min(share, std::max(0.0, (low - from) / step));
  };
  bound(p.x(), d.x(), region.low.x(), region.high.x());
  bound(p.y(), d.y(), region.low.y(), region.high.y());
  if (region.triangle) {
    const double here = share_of_diagonal(region, p), step = dot(normal_of_diagonal(region), d);
    if (step > on_diagonal && here + step > 1) share = std::min(share, std::max(0.0, (1 - here) / step));
  }
  return share;
}

}  // namespace

RestrictedStep restricted_step(const Region& region, const Vec2& p, const Vec2& gradient, const Symmetric2& hessian, const Symmetric2& form) {
  RestrictedStep step;
  // Most steps are regular and stay inside: the determinant is large enough that both eigenvalues are.
  if (const double squares = form.xx * form.yy, a = hessian.xx * form.yy, c = hessian.yy * form.xx, det = hessian.xx * hessian.yy - hessian.xy * hessian.xy;
      !region.triangle && hessian.xx > 0 && squares > 0 && det * squares > limit::regular_hessian * (a + c) * (a + c)) {
    const Vec2 d{-(hessian.yy * gradient.x() - hessian.xy * gradient.y()) / det, -(hessian.xx * gradient.y() - hessian.xy * gradient.x()) / det};
    const Vec2 to = p + d;
    if (to.x() > region.low.x() && to.x() < region.high.x() && to.y() > region.low.y() && to.y() < region.high.y()) {
      step.to = to, step.d = d;
      step.gain = -0.5 * dot(gradient, d);
      return step;
    }
  }
  const Walls walls = walls_at(region, p);
  Vec2 d = descent_direction(gradient, hessian, form, step.full);
  if (!walls.allow(d)) d = direction_along(walls, gradient, hessian, form, step.full);
  for (std::size_t i = 0; i < walls.count; ++i) {  // removes the rounding of a direction along a wall
    const Vec2& outward = walls.wall[i].outward;
    if (const double leaves = dot(outward, d); leaves > 0) d -= leaves / dot(outward, outward) * outward;
  }
  const double share = share_inside(region, p, d);
  if (share < 1) step.full = false;
  step.d = share * d;
  step.to = (p + step.d).cwiseMax(region.low).cwiseMin(region.high);
  if (share < 1) {  // rounding must not leave the place beside the wall that stopped it
    const Vec2 near = 1e-12 * region.size();
    for (int k = 0; k < 2; ++k) {
      if (d[k] > 0 && region.high[k] - step.to[k] <= near[k]) step.to[k] = region.high[k];
      if (d[k] < 0 && step.to[k] - region.low[k] <= near[k]) step.to[k] = region.low[k];
    }
    step.d = step.to - p;
  }
  step.gain = -dot(gradient, step.d) - 0.5 * dot(step.d, hessian.times(step.d));
  return step;
}

}  // namespace carreau::projection
