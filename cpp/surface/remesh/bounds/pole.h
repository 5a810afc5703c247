// SPDX-License-Identifier: BSD-3-Clause
// Ways to a pole: a side of (u, v) that is one point of space.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "support/vec.h"

namespace carreau {

/// First derivatives.
struct Tangents {
  Vec3 su, sv;
};

/// The place where the straight way from `a` arrives at a pole, of which one end `pole` is known. It lies on the line of constant u or v
/// through `pole` that is degenerate, by the derivatives there; `box`: the least and the largest (u, v) that may be. `chord`: from a to the
/// pole in space. An edge to a pole is a meridian, whichever end of the side stands for the pole in (u, v).
inline Vec2 arrival_at_pole(const Vec2& pole, const Tangents& at_pole, const Vec2& a, const Tangents& at_a, const Vec3& chord,
                            const std::array<Vec2, 2>& box) {
  const Vec3 &su = at_a.su, &sv = at_a.sv;
  const double e = dot(su, su), f = dot(su, sv), g = dot(sv, sv), x = dot(su, chord), y = dot(sv, chord);
  const Vec2 way{g * x - f * y, e * y - f * x};  // times the determinant
  // The way runs along u if that derivative has vanished.
  const bool along_u = norm(at_pole.su) * norm(sv) < norm(at_pole.sv) * norm(su);
  const int i = along_u ? 0 : 1, j = 1 - i;
  const double step = way[j] != 0 ? way[i] * (pole[j] - a[j]) / way[j] : 0;
  Vec2 place = pole;
  place[i] = std::clamp(std::isfinite(step) ? a[i] + step : a[i], box[0][i], box[1][i]);
  return place;
}

}  // namespace carreau
