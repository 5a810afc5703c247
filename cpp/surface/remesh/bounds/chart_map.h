// SPDX-License-Identifier: BSD-3-Clause
// The map of a triangle to (u, v), under which upper bounds see the surface.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "surface/remesh/bounds/pole.h"
#include "surface/remesh/bounds/triangle_bound.h"

namespace carreau {

/// Sides are parabolas of (u, v) over their chords, by the derivatives at their ends. At a pole the triangle is the sector between the ways
/// from its other corners.
struct ChartMap {
  std::array<Vec2, 3> corner;
  std::array<Vec2, 3> bulge;  ///< of the middles of sides
  int pole = -1;
  std::array<Vec2, 2> arrival;  ///< end points of the ways from the next corner and the one after it

  [[nodiscard]] Vec2 at(const PlaceInTriangle& place) const {
    const std::array<double, 3> w{1 - place.x() - place.y(), place.x(), place.y()};
    if (pole < 0) {
      Vec2 uv = w[0] * corner[0] + w[1] * corner[1] + w[2] * corner[2];
      for (std::size_t i = 0; i < 3; ++i) uv += 4 * w[i] * w[(i + 1) % 3] * bulge[i];
      return uv;
    }
    const auto i = static_cast<std::size_t>(pole), j = (i + 1) % 3, k = (i + 2) % 3;
    const double rest = w[j] + w[k], share = rest > 0 ? w[k] / rest : 0.5;
    return w[i] * lerp(arrival[0], arrival[1], share) + w[j] * corner[j] + w[k] * corner[k];
  }
};

/// The offset of the middle of the image of a side from the middle of its chord, by the cubic that has the derivatives at the ends; `way`:
/// the side. Not finite at a singular place.
inline Vec2 bulge_over_chord(const Vec2& way, const Tangents& p, const Tangents& q) {
  const Vec3 su = 0.5 * (p.su + q.su), sv = 0.5 * (p.sv + q.sv);
  const Vec3 off = ((way.x() * (q.su - p.su)) + (way.y() * (q.sv - p.sv))) / 8;
  const double e = dot(su, su), f = dot(su, sv), g = dot(sv, sv), x = dot(su, off), y = dot(sv, off), det = e * g - f * f;
  return {(g * x - f * y) / det, (e * y - f * x) / det};
}

/// The part of a bulge by which weights in a triangle with the sides ab and ac change by a quarter at most: then places stay inside it
/// and its neighbours.
inline double part_inside(const Vec2& bulge, const Vec2& ab, const Vec2& ac) {
  const double area = cross(ab, ac), b = cross(bulge, ac) / area, d = cross(ab, bulge) / area;
  const double most = std::max({std::abs(b), std::abs(d), std::abs(b + d)});
  return most <= 0.25 ? 1 : most > 0.25 ? 0.25 / most : 0;
}

}  // namespace carreau
