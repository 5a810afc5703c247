// SPDX-License-Identifier: BSD-3-Clause
#include "projection/descent.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "projection/thresholds.h"
#include "support/infinity.h"
#include "support/rounding_of.h"
#include "support/work_bounds.h"

namespace carreau::projection {

namespace {

namespace limit = thresholds::projection;
constexpr int max_halvings = 20;
constexpr double halved = 0.35;

}  // namespace

void Descent::finish(const Vec2& step) {
  const double du = step.x(), dv = step.y();
  result_ = (at_ + step).cwiseMax(region_.low).cwiseMin(region_.high);
  xyz_ = jet_.s + du * jet_.su + dv * jet_.sv + (0.5 * du * du) * jet_.suu + (du * dv) * jet_.suv + (0.5 * dv * dv) * jet_.svv;
}

// A side of the region is one point of space: the derivative along it vanishes, and the surface leaves it in different directions. Turns to
// the place of the side where the distance falls most, by the derivative of these directions along the side, and leaves it there.
bool Descent::turn_at_pole(const Vec3& r) {
  if (turns_ >= work_bounds::rounds) return false;
  for (int along = 0; along < 2; ++along) {
    const int across = 1 - along;
    const bool at_low = at_[across] <= region_.low[across];
    if (!at_low && at_[across] < region_.high[across]) continue;
    const Vec3& side = along == 0 ? jet_.su : jet_.sv;
    const double width = region_.high[along] - region_.low[along], sign = at_low ? 1 : -1;
    if (norm(side) * width > rounding_of::places * diagonal_) continue;
    const Vec3 inwards = sign * (along == 0 ? jet_.sv : jet_.su), turning = sign * jet_.suv;
    const double speed = norm(inwards), rate = norm(turning);
    if (!(speed > 0 && rate > 0)) continue;
    const double best = std::atan2(-dot(r, turning) / rate, -dot(r, inwards) / speed);
    const auto slope_at = [&](double turn) { return speed * (std::cos(turn) * dot(r, inwards) / speed + std::sin(turn) * dot(r, turning) / rate); };
    // In units of the parameter; a whole turn more or less leads to the same place.
    const double unit = speed / rate, from = (region_.low[along] - at_[along]) / unit, to = (region_.high[along] - at_[along]) / unit;
    double turn = best;
    for (const double other : {best - 2 * std::numbers::pi, best + 2 * std::numbers::pi})
      if ((turn < from || turn > to) && other >= from && other <= to) turn = other;
    if (turn < from || turn > to) turn = slope_at(from) < slope_at(to) ? from : to;
    const double slope = slope_at(turn);
    if (!(slope < -1e-13 * speed * diagonal_)) return false;
    at_[along] = std::clamp(at_[along] + turn * unit, region_.low[along], region_.high[along]);
    const double bend = speed * speed + dot(r, along == 0 ? jet_.svv : jet_.suu);
    const double way = std::min(-slope / std::max(bend, 0.1 * speed * speed), (region_.high - region_.low)[across] / 2);
    step_ = {0, 0};
    step_[across] = sign * way;
    move_ = way * speed;
    trial_ = at_ + step_;
    ++turns_;
    return true;
  }
  return false;
}

bool Descent::take(const SurfaceJet& jet) {
  ++steps_;
  const Vec3 r = jet.s - x_;
  const double square = dot(r, r);
  if (!is_finite(jet.s) && !found_) return false;
  const bool worse = found_ && !(square <= square_ * (1 + 1e-13)) && move_ > 1e-9 * size_;
  if (worse || !is_finite(jet.s)) {
    if (++halvings_ > max_halvings || steps_ >= rounding_of::max_steps) return finish({0, 0}), false;
    step_ *= halved, move_ *= halved;
    trial_ = at_ + step_;
    return true;
  }
  const double move_before = found_ ? move_ : 2 * diagonal_;
  found_ = true, halvings_ = 0;
  at_ = trial_, jet_ = jet, square_ = square;
  const Symmetric2 form{dot(jet.su, jet.su), dot(jet.su, jet.sv), dot(jet.sv, jet.sv)};
  const Symmetric2 hessian{form.xx + dot(r, jet.suu), form.xy + dot(r, jet.suv), form.yy + dot(r, jet.svv)};
  const RestrictedStep step = restricted_step(region_, at_, {dot(r, jet.su), dot(r, jet.sv)}, hessian, form);
  step_ = step.d;
  move_ = norm(step_.x() * jet.su + step_.y() * jet.sv);
  const Vec3 second = (0.5 * step_.x() * step_.x()) * jet.suu + (step_.x() * step_.y()) * jet.suv + (0.5 * step_.y() * step_.y()) * jet.svv;
  const bool straight = norm(second) <= limit::bend_of_last_step * move_;  // the expansion holds over the step
  // Newton's method converges quadratically: the next step would be so short.
  const double next = steps_ > 1 ? move_ * (move_ / move_before) * (move_ / move_before) : infinity;
  const bool last = step.full && straight && (move_ <= limit::last_step * size_ || next <= limit::next_step * diagonal_);
  const bool still = move_ <= rounding_of::digits * diagonal_ || (move_ <= 1e-10 * diagonal_ && move_ >= 0.5 * move_before) ||
                     (!step.full && step.gain <= 1e-17 * square_ && step.gain <= 1e-28 * diagonal_ * diagonal_);
  if (still && turn_at_pole(r)) return true;
  if (last || still || steps_ >= rounding_of::max_steps) return finish((last || still) && straight ? step_ : Vec2(0, 0)), false;
  trial_ = step.to;
  return true;
}

}  // namespace carreau::projection
