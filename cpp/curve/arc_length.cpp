// SPDX-License-Identifier: BSD-3-Clause
#include "curve/arc_length.h"

#include <algorithm>
#include <cmath>

#include "support/infinity.h"

namespace carreau {
namespace {

/// Turning of an edge beyond which its samples belong to no smooth arc.
constexpr double smooth_turning = 0.2;

/// Length of the arc over edge i. An arc of circle that turns by phi is longer than its chord by the factor (phi / 2) /
/// sin(phi / 2) = 1 + phi^2 / 24 + O(phi^4). This removes the polyline's error of second order.
double arc_over(const CurveSupport& support, std::size_t i) {
  const Vec3 chord = support.xyz[i + 1] - support.xyz[i];
  const double c = norm(chord);
  if (!(c > 0)) return 0;
  const double w = support.t[i + 1] - support.t[i];
  Vec3 bend;
  int ends = 0;
  for (const std::size_t k : {i, i + 1}) {
    if (k == 0 || k + 1 == support.t.size()) continue;
    bend = bend + bend_at(support.t, support.xyz, k);
    ++ends;
  }
  if (ends == 0) return c;
  bend = (w * w / ends) * bend;
  const Vec3 across = bend - (dot(bend, chord) / (c * c)) * chord;
  const double turning = norm(across) / c;  // curvature times chord
  return turning < smooth_turning ? c * (1 + turning * turning / 24) : c;
}

/// Derivative at s[i] of the polynomial through samples [first, last], abscissae distinct (Lagrange's form).
double derivative_at(const std::vector<double>& t, const std::vector<double>& s, std::size_t first, std::size_t last,
                     std::size_t i) {
  double derivative = 0;
  for (std::size_t k = first; k <= last; ++k) {
    if (k == i) continue;
    double weight = 1 / (s[k] - s[i]);
    for (std::size_t m = first; m <= last; ++m) {
      if (m != k && m != i) weight *= (s[i] - s[m]) / (s[k] - s[m]);
    }
    derivative += weight * (t[k] - t[i]);
  }
  return derivative;
}

/// dt/ds at sample i from five samples about it, or fewer where edges of zero length separate them. The slope is
/// bounded so that the cubic is monotone (Fritsch and Carlson 1980: at most three times either secant).
double slope_at(const std::vector<double>& t, const std::vector<double>& s, std::size_t i) {
  std::size_t first = i, last = i;
  while (first > 0 && i - first < 2 && s[first - 1] < s[first]) --first;
  while (last + 1 < s.size() && last - i < 2 && s[last] < s[last + 1]) ++last;
  while (last + 1 < s.size() && last - first < 4 && s[last] < s[last + 1]) ++last;
  while (first > 0 && last - first < 4 && s[first - 1] < s[first]) --first;
  if (first == last) return 0;
  double least = infinity;
  if (first < i) least = std::min(least, (t[i] - t[i - 1]) / (s[i] - s[i - 1]));
  if (i < last) least = std::min(least, (t[i + 1] - t[i]) / (s[i + 1] - s[i]));
  const double slope = derivative_at(t, s, first, last, i);
  return std::isfinite(slope) ? std::clamp(slope, 0., 3 * least) : least;
}

/// Index i of the edge with values[i] <= x <= values[i + 1].
std::size_t edge_of(const std::vector<double>& values, double x) noexcept {
  const auto above = std::upper_bound(values.begin() + 1, values.end() - 1, x);
  return static_cast<std::size_t>(above - values.begin()) - 1;
}

/// t at fraction x of edge i.
double t_within(const CurveSupport& support, std::size_t i, double x) noexcept {
  const double t0 = support.t[i];
  const double t1 = support.t[i + 1];
  double t = (1 - x) * t0 + x * t1;
  if (!support.slope.empty()) {
    const double ds = support.arc[i + 1] - support.arc[i];
    const double rise = t1 - t0;
    const double y = 1 - x;
    t += x * y * (y * (support.slope[i] * ds - rise) - x * (support.slope[i + 1] * ds - rise));
  }
  return std::clamp(t, t0, t1);
}

}  // namespace

void fill_arc(CurveSupport& support) {
  const std::size_t m = support.t.size();
  support.arc.assign(m, 0);
  for (std::size_t i = 0; i + 1 < m; ++i) support.arc[i + 1] = support.arc[i] + arc_over(support, i);
  support.slope.resize(m);
  for (std::size_t i = 0; i < m; ++i) support.slope[i] = slope_at(support.t, support.arc, i);
}

double CurveSupport::t_at_arc(double s) const noexcept {
  if (s <= 0) return t.front();
  if (s >= arc.back()) return t.back();
  const std::size_t i = edge_of(arc, s);
  const double ds = arc[i + 1] - arc[i];
  return ds > 0 ? t_within(*this, i, (s - arc[i]) / ds) : t[i];
}

double CurveSupport::arc_at_t(double at) const noexcept {
  if (at <= t.front()) return 0;
  if (at >= t.back()) return arc.back();
  const std::size_t i = edge_of(t, at);
  double low = 0;
  double high = 1;
  for (int k = 0; k < 60; ++k) {  // t_within is monotone: bisection cannot fail
    const double x = (low + high) / 2;
    (t_within(*this, i, x) < at ? low : high) = x;
  }
  return arc[i] + (low + high) / 2 * (arc[i + 1] - arc[i]);
}

Vec3 CurveSupport::point_at_arc(double s) const noexcept {
  if (s <= 0) return xyz.front();
  if (s >= arc.back()) return xyz.back();
  const std::size_t i = edge_of(arc, s);
  const double ds = arc[i + 1] - arc[i];
  return ds > 0 ? lerp(xyz[i], xyz[i + 1], (s - arc[i]) / ds) : xyz[i];
}

}  // namespace carreau
