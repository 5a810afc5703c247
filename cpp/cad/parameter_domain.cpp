// SPDX-License-Identifier: BSD-3-Clause
#include "cad/parameter_domain.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace carreau {

namespace {

/// Largest distance of a curve from its chord, in lengths of the chord: samples keep angles of a few degrees.
constexpr double bulge = 0.25;
/// Share of the largest coordinate; positions on the boundary are rounded.
constexpr double rounding = 1e-14;
/// Share of the largest coordinate. Ends of curves that are closer become one point, so that no ray passes between them.
constexpr double joint = 1e-7;
constexpr int bisections = 60;

Vec3 in_plane(Vec2 p) { return {p.x(), p.y(), 0}; }
double cross2(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// A box around the curve of a chord.
BoxTree::Box box_around(const Vec2& a, const Vec2& b) {
  const double margin = bulge * norm(b - a);
  BoxTree::Box box;
  box.add(in_plane(a)), box.add(in_plane(b));
  box.low -= Vec3{margin, margin, 0}, box.high += Vec3{margin, margin, 0};
  return box;
}

void join_ends(std::vector<BoundaryCurve>& boundary, double gap) {
  std::vector<Vec2> known;
  for (BoundaryCurve& curve : boundary)
    for (Vec2* end : {&curve.uv.front(), &curve.uv.back()}) {
      const auto same = std::find_if(known.begin(), known.end(), [&](const Vec2& p) { return norm(p - *end) <= gap; });
      if (same == known.end())
        known.push_back(*end);
      else
        *end = *same;
    }
}

}  // namespace

ParameterDomain::ParameterDomain(std::vector<BoundaryCurve> boundary) {
  double largest = 0;
  for (const BoundaryCurve& curve : boundary)
    for (const Vec2& p : curve.uv) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  tolerance_ = rounding * largest;
  join_ends(boundary, joint * largest);
  std::vector<BoxTree::Box> boxes;
  std::vector<Vec3> centres;
  for (const BoundaryCurve& curve : boundary)
    for (std::size_t i = 0; i + 1 < curve.t.size(); ++i) {
      const Edge edge{curve.ic, curve.t[i], curve.t[i + 1], curve.uv[i], curve.uv[i + 1]};
      edges_.push_back(edge);
      boxes.push_back(box_around(edge.a, edge.b));
      centres.push_back(in_plane(0.5 * (edge.a + edge.b)));
    }
  tree_ = BoxTree(boxes, centres);
}

bool ParameterDomain::may_cross(Vec2 low, Vec2 high) const {
  BoxTree::Box box;
  box.add(in_plane(low)), box.add(in_plane(high));
  bool found = false;
  tree_.all_that_meet([&](const BoxTree::Box& b) { return !found && !b.is_apart(box); },
                      [&](const BoxTree::Node& leaf) {
                        for (const std::int32_t k : tree_.things(leaf)) {
                          const Edge& edge = edges_[static_cast<std::size_t>(k)];
                          found = found || !box_around(edge.a, edge.b).is_apart(box);
                        }
                      });
  return found;
}

// In the frame of the chord the curve is y = f(x): the abscissa of p determines t.
ParameterDomain::Side ParameterDomain::side_of(const Edge& edge, Vec2 p, const Curve& curve) const {
  const Vec2 chord = edge.b - edge.a;
  const double length = norm(chord);
  if (!(length > 0)) return norm(p - edge.a) <= tolerance_ ? Side::on : Side::same;
  const Vec2 along = (1 / length) * chord;
  const double x = dot(p - edge.a, along), y = cross2(along, p - edge.a);
  if (x < -tolerance_ || x > length + tolerance_ || std::abs(y) > bulge * length + tolerance_) return Side::same;
  if (norm(p - edge.a) <= tolerance_ || norm(p - edge.b) <= tolerance_) return Side::on;
  double low = edge.t0, high = edge.t1, x_low = 0, x_high = length;
  Vec2 at = edge.a;
  for (int i = 0; i < bisections; ++i) {
    // False position, alternating with bisection.
    const double share = i % 2 == 0 && x_high > x_low ? std::clamp((x - x_low) / (x_high - x_low), 0.0, 1.0) : 0.5;
    const double t = low + share * (high - low);
    at = curve(edge.ic, t);
    const double x_at = dot(at - edge.a, along);
    if (std::abs(x_at - x) <= tolerance_ || !(high > low)) break;
    if (x_at < x)
      low = t, x_low = x_at;
    else
      high = t, x_high = x_at;
  }
  const double f = cross2(along, at - edge.a);
  if (std::abs(y - f) <= tolerance_) return Side::on;
  // The side of a point on its chord as the ray below sees it.
  const double y_seen = y != 0 ? y : chord.y() > 0 ? -0.5 * tolerance_ : chord.y() < 0 ? 0.5 * tolerance_ : chord.x() > 0 ? 0.5 * tolerance_ : -0.5 * tolerance_;
  return (f > 0 && y_seen > 0 && y_seen < f) || (f < 0 && y_seen < 0 && y_seen > f) ? Side::other : Side::same;
}

bool ParameterDomain::contains(Vec2 p, const Curve& curve) const {
  bool inside = false, on = false;
  BoxTree::Box here;
  here.add(in_plane(p));
  // A ray in the direction of u, just above the height of p, meets the chords.
  const auto meets = [&](const BoxTree::Box& b) {
    return b.low.y() <= p.y() + tolerance_ && p.y() - tolerance_ <= b.high.y() && p.x() - tolerance_ <= b.high.x();
  };
  tree_.all_that_meet(meets, [&](const BoxTree::Node& leaf) {
    for (const std::int32_t k : tree_.things(leaf)) {
      const Edge& edge = edges_[static_cast<std::size_t>(k)];
      const Vec2& a = edge.a;
      const Vec2& b = edge.b;
      if ((a.y() > p.y()) != (b.y() > p.y())) {
        const double side = cross2(b - a, p - a);
        if (b.y() > a.y() ? side > 0 : side < 0) inside = !inside;
      }
      const Side side = side_of(edge, p, curve);
      on = on || side == Side::on;
      if (side == Side::other) inside = !inside;
    }
  });
  return on || inside;
}

}  // namespace carreau
