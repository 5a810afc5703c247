// SPDX-License-Identifier: BSD-3-Clause
#include "projection/descent.h"

#include "projection/thresholds.h"

namespace carreau::projection {

namespace {

namespace limit = thresholds::projection;
constexpr int most_halvings = 20;
constexpr double halved = 0.35;

}  // namespace

void Descent::finish(const Vec2& step) {
  const double du = step.x(), dv = step.y();
  result_ = (at_ + step).cwiseMax(region_.low).cwiseMin(region_.high), beyond_ = step;
  xyz_ = jet_.s + du * jet_.su + dv * jet_.sv + (0.5 * du * du) * jet_.suu + (du * dv) * jet_.suv + (0.5 * dv * dv) * jet_.svv;
}

bool Descent::take(const SurfaceJet& jet) {
  ++steps_;
  const Vec3 r = jet.s - x_;
  const double square = dot(r, r);
  if (!is_finite(jet.s) && !found_) return false;
  const bool worse = found_ && !(square <= square_ * (1 + 1e-13)) && move_ > 1e-9 * size_;
  if (worse || !is_finite(jet.s)) {
    if (++halvings_ > most_halvings || steps_ >= limit::most_steps) return finish({0, 0}), false;
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
  const bool last = step.full && move_ <= limit::last_step * size_;
  const bool still = move_ <= limit::shortest_step * diagonal_ || (move_ <= 1e-10 * diagonal_ && move_ >= 0.5 * move_before) ||
                     (!step.full && step.gain <= 1e-17 * square_ && step.gain <= 1e-28 * diagonal_ * diagonal_);
  if (last || still || steps_ >= limit::most_steps) return finish(last || still ? step_ : Vec2(0, 0)), false;
  trial_ = step.to;
  return true;
}

}  // namespace carreau::projection
