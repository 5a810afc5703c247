// SPDX-License-Identifier: BSD-3-Clause
#include "curve/exact_arc.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "support/vec.h"

namespace carreau {

namespace {

/// Points of the rule: exact to degree 9; between two samples of a support a curve turns by about a degree.
constexpr int points = 5;
/// Halvings of an interval: at a kink the rest is below 1e-3 of it.
constexpr int max_halvings = 10;
/// Newton's steps; a step that would leave the bracket is replaced by halving.
constexpr int max_steps = 60;
// Halves that differ by less are equal: rounding, and the remaining error of finite differences.
constexpr double exact_tolerance = 1e-14, difference_tolerance = 1e-8;
/// Share of the length below which an error is rounding.
constexpr double rounding = 1e-15;

}  // namespace

ExactArc::ExactArc(Cad& cad, int face, int ic, std::vector<double> t)
    : cad_(cad),
      face_(face),
      ic_(ic),
      rule_(gauss_rule(points)),
      tolerance_((cad.surface_gives() & cad.curve_gives() & want_first) != 0 ? exact_tolerance : difference_tolerance),
      t_(std::move(t)),
      arc_{0} {
  for (std::size_t k = 0; k + 1 < t_.size(); ++k) arc_.push_back(arc_[k] + length_between(t_[k], t_[k + 1]));
}

double ExactArc::speed(double t) const {
  const CurveJet curve = cad_.curve(face_, ic_, want_position | want_first, t);
  const SurfaceJet jet = surface_at(cad_, face_, want_first, curve.c);
  return norm(Vec3(curve.ct.x() * jet.su + curve.ct.y() * jet.sv));
}

double ExactArc::once(double a, double b) const {
  double sum = 0;
  for (std::size_t i = 0; i < rule_.node.size(); ++i) sum += rule_.weight[i] * speed(std::lerp(a, b, rule_.node[i]));
  return sum * (b - a);
}

double ExactArc::integral(double a, double b, double whole, int depth) const {
  const double middle = a + (b - a) / 2;
  const double left = once(a, middle), right = once(middle, b);
  if (depth == 0 || !(a < middle && middle < b) || std::abs(left + right - whole) <= tolerance_ * (left + right))
    return left + right;
  return integral(a, middle, left, depth - 1) + integral(middle, b, right, depth - 1);
}

double ExactArc::length_between(double a, double b) const { return integral(a, b, once(a, b), max_halvings); }

double ExactArc::t_at(double s) const {
  if (!(s > 0)) return t_.front();
  if (s >= length()) return t_.back();
  const auto k = static_cast<std::size_t>(std::upper_bound(arc_.begin(), arc_.end(), s) - arc_.begin()) - 1;
  const double wanted = s - arc_[k];
  double low = t_[k], high = t_[k + 1], t = std::lerp(low, high, wanted / (arc_[k + 1] - arc_[k]));
  for (int step = 0; step < max_steps; ++step) {
    const double missing = wanted - length_between(t_[k], t);
    if (std::abs(missing) <= rounding * length()) break;
    (missing > 0 ? low : high) = t;
    double next = t + missing / speed(t);
    if (!(low < next && next < high)) next = low + (high - low) / 2;
    if (!(low < next && next < high)) break;  // there is no number between
    t = next;
  }
  return t;
}

}  // namespace carreau
