// SPDX-License-Identifier: BSD-3-Clause
// A loop in pieces, each described in the polar basis of a pivot (Atlas sec. 5.2.3), and the annulus on it
// (sec. 5.3.3, 5.4).
#pragma once

#include <algorithm>
#include <numbers>
#include <span>
#include <vector>

#include "atlas/hermite.h"
#include "atlas/pivots.h"
#include "atlas/polygon.h"

namespace carreau::atlas {

/// An arc of a circle that replaces the border around a vertex (Atlas sec. 5.4.2).
struct Rounding {
  double first = 0, at = 0, last = 0;  ///< angles; first == last: none
  double radius = 0;
};

/// The part of a loop that one pivot describes. Angles are 0 at the first joint and increase along the loop, for pivots
/// on both sides: the vartheta of Atlas sec. 5.2.3.2 up to a constant. Straight lines are g with 1 / rho = g . (cos,
/// sin): d and o of Atlas eq. 5.8 without their singularities.
struct Part {
  Vec2 pivot{0, 0};
  double side = 1;  ///< +1: inside, -1: outside
  Vec2 start{1, 0};
  std::vector<double> angle = {};  ///< knots: joint, vertices of the loop, joint
  std::vector<double> phi = {};    ///< of knots, increasing
  std::vector<double> slope = {};  ///< d angle / d phi at knots between (Atlas eq. 5.7); of joints, without meaning
  double first_speed = 0, last_speed = 0;  ///< lambda of Atlas eq. 5.12, one a joint; both 0: angles are linear in phi
  std::vector<Vec2> line = {};             ///< of each edge
  std::vector<Rounding> rounding = {};     ///< of each knot; empty: none
  std::vector<double> ratio_angle = {};    ///< knots of b, which is outer radius by inner radius; empty: a loop only
  std::vector<double> ratio = {};          ///< its values: cubics with zero slopes between them
  bool outer_first = false;                ///< lines and roundings are the outer border, and b is inner radius by outer radius
  std::vector<Vec2> outer_line = {};  ///< in place of the values, the outer border is straight pieces; empty: it is not

  [[nodiscard]] double total() const { return angle.back(); }
  template <typename Number>
  [[nodiscard]] Pair<Number> direction(const Number& at) const;
  /// Angle and distance of a point.
  template <typename Number>
  [[nodiscard]] Pair<Number> polar(const Pair<Number>& p) const;
  /// Radius of the border that lines and roundings describe: of the inner one, unless outer_first.
  template <typename Number>
  [[nodiscard]] Number base_radius(const Number& at) const;
  template <typename Number>
  [[nodiscard]] Number ratio_at(const Number& at) const;
  /// Radius in the stratum tau, and the stratum of a radius.
  template <typename Number>
  [[nodiscard]] Number radius(const Number& tau, const Number& at) const;
  template <typename Number>
  [[nodiscard]] Number stratum(const Number& radius, const Number& at) const;
  /// +1: from the base the other border lies away from the pivot; -1: towards it.
  [[nodiscard]] double sense() const { return outer_first ? -side : side; }
  /// Angle as a function of phi on the knots from k to k + 1, in the stratum tau.
  template <typename Number>
  [[nodiscard]] HermiteData<Number> angle_data(std::size_t k, const Number& tau) const;
};

/// Index of the interval of ascending knots that holds x; outside, the first or last interval.
inline std::size_t interval_of(std::span<const double> knots, double x) {
  const auto inside = knots.subspan(1, knots.size() - 2);
  return static_cast<std::size_t>(std::upper_bound(inside.begin(), inside.end(), x) - inside.begin());
}

/// Parts of a loop with phi at its vertices: phi[v] increasing, the first one again after `period`.
std::vector<Part> make_parts(const Polygon& loop, const Pivots& pivots, std::span<const double> phi, double period);
/// Lengths along the loop, scaled to the period.
std::vector<double> phi_by_length(const Polygon& loop, double period);

/// The largest speeds at joints, and slopes at vertices, for which angles increase with phi (Atlas eq. 5.6, 5.7, 5.13):
/// C1 across joints.
void make_smooth(std::vector<Part>& parts);

/// 1 / rho of a line through two points in the frame of a part.
Vec2 line_through(const Part& part, const Vec2& a, const Vec2& b);
inline double radius_on(const Vec2& line, double angle) {
  return 1 / (line.x() * std::cos(angle) + line.y() * std::sin(angle));
}

template <typename Number>
Pair<Number> Part::direction(const Number& at) const {
  using std::cos, std::sin;
  const Number c = cos(at), s = side * sin(at);
  return {start.x() * c - start.y() * s, start.y() * c + start.x() * s};
}

template <typename Number>
Pair<Number> Part::polar(const Pair<Number>& p) const {
  using std::atan2, std::sqrt;
  const Number dx = p[0] - pivot.x(), dy = p[1] - pivot.y();
  Number at = atan2(side * (start.x() * dy - start.y() * dx), start.x() * dx + start.y() * dy);
  // The part leaves a remainder of the circle: half of it belongs to each end.
  if (value_of(at) < total() / 2 - std::numbers::pi) at = at + 2 * std::numbers::pi;
  return {at, sqrt(dx * dx + dy * dy)};
}

template <typename Number>
Number Part::base_radius(const Number& at) const {
  using std::cos, std::sin;
  const double x = value_of(at);
  const std::size_t k = interval_of(angle, x);
  const Number straight = 1.0 / (line[k].x() * cos(at) + line[k].y() * sin(at));
  if (rounding.empty()) return straight;
  for (const std::size_t knot : {k, k + 1}) {
    const Rounding& r = rounding[knot];
    if (x <= r.first || x >= r.last) continue;
    const Number weight = x < r.at ? beta((r.at - at) / (r.at - r.first)) : beta((at - r.at) / (r.last - r.at));
    return weight * r.radius + (1.0 - weight) * straight;
  }
  return straight;
}

template <typename Number>
Number Part::ratio_at(const Number& at) const {
  using std::cos, std::sin;
  const std::size_t k = interval_of(ratio_angle, value_of(at));
  if (!outer_line.empty()) {
    const Vec2 inner = line[interval_of(angle, value_of(at))], outer = outer_line[k];
    return (inner.x() * cos(at) + inner.y() * sin(at)) / (outer.x() * cos(at) + outer.y() * sin(at));
  }
  const double width = ratio_angle[k + 1] - ratio_angle[k];
  const Number share = (at - ratio_angle[k]) / width;
  if (value_of(share) <= 0) return ratio[k];
  if (value_of(share) >= 1) return ratio[k + 1];
  return ratio[k + 1] + (ratio[k] - ratio[k + 1]) * beta(share);
}

template <typename Number>
Number Part::radius(const Number& tau, const Number& at) const {
  const Number share = outer_first ? 1.0 - tau : tau;
  return ((1.0 - share) + share * ratio_at(at)) * base_radius(at);
}

template <typename Number>
Number Part::stratum(const Number& radius, const Number& at) const {
  const Number rho = base_radius(at);
  const Number share = (radius - rho) / ((ratio_at(at) - 1.0) * rho);  // Atlas eq. 5.9
  return outer_first ? 1.0 - share : share;
}

template <typename Number>
HermiteData<Number> Part::angle_data(std::size_t k, const Number& tau) const {
  const Number share = outer_first ? 1.0 - tau : tau;
  const auto at_joint = [&](double speed, std::size_t edge, double at, double b) {
    return speed / (radius_on(line[edge], at) * ((1.0 - share) + share * b));
  };
  const std::size_t last = angle.size() - 2;
  const double even = (angle[k + 1] - angle[k]) / (phi[k + 1] - phi[k]);
  HermiteData<Number> data{phi[k], phi[k + 1], angle[k], angle[k + 1], even, even};
  if (first_speed == 0 && last_speed == 0) return data;
  const double b_first = ratio_angle.empty() ? 1 : ratio.front(), b_last = ratio_angle.empty() ? 1 : ratio.back();
  data.slope1 = k == 0 ? at_joint(first_speed, 0, 0, b_first) : Number(slope[k]);
  data.slope2 = k == last ? at_joint(last_speed, last, total(), b_last) : Number(slope[k + 1]);
  return data;
}

}  // namespace carreau::atlas
