// SPDX-License-Identifier: BSD-3-Clause
// Closest points on the interpolations of leaves.
#include <algorithm>
#include <cmath>

#include "projection/face_leaves.h"
#include "projection/thresholds.h"
#include "support/infinity.h"
#include "support/rounding_of.h"

namespace carreau::projection {

namespace {

namespace limit = thresholds::projection;

/// The squared distance of the interpolation from x, halved, with its derivatives; `form` is the first fundamental form.
struct Expansion {
  double square = 0;  // not halved
  Vec2 gradient;
  Symmetric2 hessian, form;
};

Expansion expansion_at(const BicubicTerms& terms, const Vec3& x, const Vec2& w) {
  using Pair = BicubicTerms::Pair;
  const double u = w.x(), v = w.y();
  Pair of_r{}, of_v{}, of_u{}, bends{};  // sums over the coordinates of r (r, Su), r (Sv, Suv), Su (Su, Sv), r (Suu, Svv)
  double vv = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Pair* c = &terms.pairs[8 * k];
    std::array<Pair, 2> p, pu, puu;  // rows and their derivatives along u, the second one halved
    for (std::size_t h = 0; h < 2; ++h) {
      const Pair t = u * c[6 + h], q = c[4 + h] + t;
      p[h] = c[h] + u * (c[2 + h] + u * q), pu[h] = c[2 + h] + u * (q + q + t), puu[h] = q + t + t;
    }
    const Pair first{p[0][0], pu[0][0]}, second{p[0][1], pu[0][1]}, third{p[1][0], pu[1][0]}, last{p[1][1], pu[1][1]};
    const Pair t = v * last, q = third + t;
    const Pair r = first + v * (second + v * q) - Pair{x[static_cast<Eigen::Index>(k)], 0}, across = second + v * (q + q + t);
    const Pair uu = puu[0] + (v * v) * puu[1];
    of_r += r[0] * r, of_v += r[0] * across, of_u += r[1] * Pair{r[1], across[0]};
    bends += r[0] * Pair{uu[0] + v * uu[1], q[0] + t[0] + t[0]};
    vv += across[0] * across[0];
  }
  const Symmetric2 form{of_u[0], of_u[1], vv};
  return {of_r[0], {of_r[1], of_v[0]}, {form.xx + 2 * bends[0], form.xy + of_v[1], form.yy + 2 * bends[1]}, form};
}

/// Both eigenvalues of the Hessian are positive, and not small.
bool is_convex(const Symmetric2& h, const Symmetric2& form) {
  const double det = h.xx * h.yy - h.xy * h.xy, sum = h.xx * form.yy + h.yy * form.xx;
  return h.xx > 0 && form.xx * form.yy > 0 && det * form.xx * form.yy > limit::regular_hessian * sum * sum;
}

/// The minimum of a convex quadratic function over the unit square, from a place in it.
RestrictedStep step_in_square(const Vec2& w, const Vec2& g, const Symmetric2& h) {
  const double det = h.xx * h.yy - h.xy * h.xy;
  const auto gain_of = [&](const Vec2& d) { return -dot(g, d) - 0.5 * (h.xx * d.x() * d.x() + 2 * h.xy * d.x() * d.y() + h.yy * d.y() * d.y()); };
  RestrictedStep step;
  step.d = {-(h.yy * g.x() - h.xy * g.y()) / det, -(h.xx * g.y() - h.xy * g.x()) / det};
  step.to = w + step.d;
  const Vec2 inside = step.to.cwiseMax(Vec2(0, 0)).cwiseMin(Vec2(1, 1));
  if (inside == step.to) {
    step.gain = -0.5 * dot(g, step.d);
    return step;
  }
  // The minimum lies on a side beyond which the free minimum lies.
  const Vec2 beyond = step.to;
  step.gain = -infinity;
  if (inside.x() != beyond.x()) {
    const double dx = inside.x() - w.x(), y = std::clamp(w.y() - (g.y() + h.xy * dx) / h.yy, 0.0, 1.0);
    step.to = {inside.x(), y}, step.d = step.to - w, step.gain = gain_of(step.d);
  }
  if (inside.y() != beyond.y()) {
    const double dy = inside.y() - w.y(), x = std::clamp(w.x() - (g.x() + h.xy * dy) / h.xx, 0.0, 1.0);
    const Vec2 to{x, inside.y()}, d = to - w;
    if (const double gain = gain_of(d); gain > step.gain) step.to = to, step.d = d, step.gain = gain;
  }
  return step;
}

/// The end of a descent on an interpolation.
struct Landing {
  Vec2 w;
  double square = infinity, slack = 0;
  bool convex = true;  // the squared distance, at all places of the way
};

/// If `known` is less than the square at `from`, the descent begins at `otherwise`.
Landing descend(const SurfaceLeaf& leaf, const Vec3& x, const Vec2& from, double known, const Vec2& otherwise, double bound) {
  const bool triangle = leaf.region.triangle;
  const Region unit{{0, 0}, {1, 1}, triangle};
  Vec2 w = from;
  Landing landing{w, infinity, leaf.size};  // the bound of a descent that does not converge
  double move = 0;
  for (int k = 0; k < rounding_of::newton_steps; ++k) {
    const Expansion f = expansion_at(leaf.terms, x, w);
    const double d = f.square;
    if (k == 0 && known < d) {
      w = otherwise;
      continue;
    }
    if (!(d < landing.square)) {
      if (move <= limit::last_step_in_exact_leaf) landing.slack = 0;
      break;
    }
    landing.square = d, landing.w = w;
    const bool convex = is_convex(f.hessian, f.form);
    landing.convex = landing.convex && convex;
    const RestrictedStep step = convex && !triangle ? step_in_square(w, f.gradient, f.hessian) : restricted_step(unit, w, f.gradient, f.hessian, f.form);
    const double squared_move = dot(step.d, step.d);
    move = std::sqrt(squared_move);
    if (move < limit::expanded_step) {
      const double square = std::max(0.0, d - 2 * step.gain), off = 2 * (leaf.bend + leaf.third * std::sqrt(d)) * squared_move * move;
      const double distance = std::sqrt(square), slack = distance - std::sqrt(std::max(0.0, square - off));
      if ((move < limit::last_step_in_leaf && slack <= leaf.error) || move < limit::last_step_in_exact_leaf || distance - slack - leaf.error > bound) {
        landing.w = step.to, landing.square = square, landing.slack = slack;
        break;
      }
    }
    w = step.to;
  }
  return landing;
}

}  // namespace

NearestSample nearest_sample(const SurfaceLeaf& leaf, const Vec3& x) {
  NearestSample nearest{0, infinity};
  for (std::size_t k = 0; k < 9; ++k) {
    if (leaf.region.triangle && k % 3 + k / 3 > 2) continue;
    const Vec3 r = leaf.at[k] - x;
    if (const double d = dot(r, r); d < nearest.square) nearest = {k, d};
  }
  return nearest;
}

LeafPlace nearest_on(const SurfaceLeaf& leaf, const Vec3& x, const Vec2& from, const NearestSample* sample, double bound) {
  Landing best = descend(leaf, x, from, sample != nullptr ? sample->square : infinity, sample != nullptr ? place_of(*sample) : from, bound);
  if (!best.convex && !leaf.region.triangle) {  // there may be a minimum at each corner
    for (const Vec2& corner : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1), Vec2(1, 1)}) {
      const Landing other = descend(leaf, x, corner, infinity, corner, bound);
      if (std::sqrt(other.square) - other.slack < std::sqrt(best.square) - best.slack) best = other;
    }
  }
  return {leaf.region.low + Vec2(best.w.cwiseProduct(leaf.region.size())), std::sqrt(best.square), best.slack};
}

LeafPlace nearest_on(const CurveLeaf& leaf, const Vec3& x) {
  const Vec3 d = leaf.to - leaf.from;
  const double square = dot(d, d), share = square > 0 ? std::clamp(dot(x - leaf.from, d) / square, 0.0, 1.0) : 0;
  return {{leaf.t0 + share * (leaf.t1 - leaf.t0), 0}, norm(leaf.from + share * d - x), 0};
}

}  // namespace carreau::projection
