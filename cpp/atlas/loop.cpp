// SPDX-License-Identifier: BSD-3-Clause
#include "atlas/loop.h"

#include <cmath>
#include <limits>

#include "support/error.h"

namespace carreau::atlas {

std::size_t part_of(std::span<const Part> parts, double period, double& phi) {
  const double first = parts.front().phi.front();
  phi -= period * std::floor((phi - first) / period);
  if (phi >= first + period) phi = first;
  const auto behind =
      std::upper_bound(parts.begin() + 1, parts.end(), phi, [](double x, const Part& p) { return x < p.phi.front(); });
  return static_cast<std::size_t>(behind - parts.begin()) - 1;
}

Loop::Loop(Polygon polygon, LoopSpeed speed, bool star) : polygon_(std::move(polygon)) {
  require_simple(polygon_, "the loop");
  chosen_ = choose_pivots(polygon_, nullptr, star);
  parts_ = make_parts(polygon_, chosen_.pivots, phi_by_length(polygon_, period()), period());
  if (speed == LoopSpeed::smooth) make_smooth(parts_);
}

Loop::Place Loop::at(double phi) const {
  if (!std::isfinite(phi)) throw InvalidArgument("the parameter phi of a loop is not finite");
  const Part& part = parts_[part_of(parts_, period(), phi)];
  const Jet x(phi, 1, 0);
  const Jet angle = hermite(part.angle_data(interval_of(part.phi, phi), Jet(0.0)), x);
  const Pair<Jet> u = part.direction(angle);
  const Jet rho = part.base_radius(angle);
  return {part.pivot + Vec2((rho * u[0]).f, (rho * u[1]).f), {(rho * u[0]).u, (rho * u[1]).u}};
}

double Loop::phi_of(const Vec2& p, double tolerance) const {
  double best = std::numeric_limits<double>::infinity(), phi = 0;
  for (const Part& part : parts_) {
    const Pair<double> polar = part.polar(pair_of(p));
    const double angle = std::clamp(polar[0], 0.0, part.total());
    const double distance = std::abs(polar[1] - part.base_radius(angle)) + polar[1] * std::abs(angle - polar[0]);
    if (!(distance < best)) continue;
    best = distance;
    phi = hermite_inverse(part.angle_data(interval_of(part.angle, angle), 0.0), angle);
  }
  if (!(best <= tolerance)) throw InvalidArgument(Where{.uv = p}, "the point does not lie on the loop");
  phi -= period() * std::floor(phi / period());
  return phi >= period() ? 0 : phi;
}

}  // namespace carreau::atlas
