// SPDX-License-Identifier: BSD-3-Clause
#include "plane/kernel/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/shape_levels.h"
#include "plane/kernel/thresholds.h"
#include "predicates/predicates.h"
#include "support/shares.h"

namespace carreau::plane {

// Charts at kinks of the field, or at bends too strong for second order, are wrong: distances in six directions must
// agree between the chart and the tensors halfway.
Bend Field::bend(const MetricSlopes& slopes, const Chart& chart) const noexcept {
  const double by_shapes = bend_of_shapes(slopes);
  if (!(by_shapes > min_bend) || by_shapes > max_bend) return Bend::none;
  for (const Vec2& d : six_directions) {
    Vec2 e = chart.offset(d);
    // Along a strong bend only so far that the curve is about a unit long.
    const double aside = norm(chart.at_offset(e) - d);
    if (aside > 1) e = (1 / std::sqrt(aside)) * e;
    const double told = norm(chart.at_offset(e)), halfway = length(at(chart.origin() + 0.5 * e), e);
    if (!(std::abs(told - halfway) <= shares::notable * halfway)) return Bend::kinked;
  }
  return Bend::smooth;
}

double Lengths::quality() const noexcept { return std::sqrt(3 * area2()) / (a + b + c); }

void Shapes::set_metric(int v) const noexcept {
  Vertex& V = mesh_.vertices[v];
  V.set_metric(field_.at(V.point()));
  if (mesh_.bends.empty()) return;
  const MetricSlopes slopes = field_.slopes(V.point());
  mesh_.bends[v] = field_.bend(slopes, {V.point(), slopes});
}

double Shapes::squared_radius(int t) const noexcept {
  const Triangle& T = mesh_.triangles[t];
  return is_bent(T) ? lengths(T.v[0], T.v[1], T.v[2]).radius2() : mesh_.squared_radius(t);
}

double Shapes::change(int t) const noexcept {
  double low = 0, high = 0;
  for (int i = 0; i < 3; ++i) {
    const double det = determinant(mesh_.vertices[mesh_.triangles[t].v[i]].metric());
    low = i == 0 ? det : std::min(low, det), high = std::max(high, det);
  }
  return high / std::max(low, 1e-300);
}

Sizes Shapes::classify(std::size_t whole) const noexcept {
  const std::size_t n = mesh_.triangles.size(), step = std::max<std::size_t>(1, n / classified_sample);
  std::size_t looked = 0, graded = 0, rough = 0;
  for (std::size_t t = 0; t < n; t += step, ++looked) {
    const double by = change(static_cast<int>(t));
    graded += by > graded_change ? 1 : 0;
    rough += by > rough_change ? 1 : 0;
  }
  const auto all = static_cast<double>(looked);
  if (std::max(n, whole) < fewest_for_lattice || static_cast<double>(rough) > rough_share * all) return Sizes::rough;
  return static_cast<double>(graded) > graded_share * all ? Sizes::graded : Sizes::even;
}

double Shapes::quality(int p, int q, int r) const noexcept {
  if (!mesh_.is_bent(p, q, r)) return mesh_.quality(p, q, r);
  return orientation(mesh_.at(p), mesh_.at(q), mesh_.at(r)) > 0 ? lengths(p, q, r).quality() : 0;
}

// Lengths by two points of Gauss on each edge.
Lengths Shapes::integrated_lengths(int p, int q, int r) const {
  constexpr double first = 0.2113248654051871;
  const auto squared = [&](int a, int b) {
    const Vec2 A = mesh_.at(a), B = mesh_.at(b);
    const double one = carreau::squared_length(field_.at(lerp(A, B, first)), B - A);
    const double two = carreau::squared_length(field_.at(lerp(B, A, first)), B - A);
    return 0.25 * (one + two) + 0.5 * std::sqrt(one * two);
  };
  return {squared(q, r), squared(r, p), squared(p, q)};
}

double Shapes::quality_at_centroid(int p, int q, int r) const {
  const Vec2 P = mesh_.at(p), Q = mesh_.at(q), R = mesh_.at(r);
  if (orientation(P, Q, R) <= 0) return 0;
  const Metric2 m = field_.at((1.0 / 3) * (P + Q + R));
  const Vec2 u = Q - P, v = R - P;
  const double area = cross(u, v) * std::sqrt(std::max(determinant(m), 0.0));
  if (mesh_.is_bent(p, q, r)) {
    const auto shape_of = [&](const Lengths& l) {
      return std::min(l.quality(), 2 * std::numbers::sqrt3 / straight_area * area / (l.a + l.b + l.c));
    };
    const double roughly = shape_of(lengths(p, q, r));
    // The tensor halfway is inaccurate for long edges that leave a thin layer and come back, or cross it.
    return roughly < shape_level::fair ? shape_of(integrated_lengths(p, q, r)) : roughly;
  }
  return 2 * std::numbers::sqrt3 * area /
         (carreau::squared_length(m, u) + carreau::squared_length(m, v) + carreau::squared_length(m, u - v));
}

}  // namespace carreau::plane
