// SPDX-License-Identifier: BSD-3-Clause
// A closed plate with a hole, cut into halves for no reason: lines that turn fast beside faces that are flat.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>

#include "common/analytic_cad.h"

namespace carreau::testing {

inline constexpr double plate_height = 0.4;

/// [-1, 1]^2 x [0, plate_height] without a cylinder of radius r round the z axis; faces 1 to 12.
inline AnalyticCad drilled_plate(double r) {
  constexpr double pi = std::numbers::pi, h = plate_height;
  AnalyticCad cad;
  int ref = 0;
  for (const double z : {0., h}) {
    const auto plane = [z](Vec2 p) { return SurfaceJet{{p.x(), p.y(), z}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}}; };
    for (const double side : {1., -1.})
      cad.faces[++ref] = {plane,
                          {segment({0, -side}, {side, -side}), segment({side, -side}, {side, side}),
                           segment({side, side}, {0, side}), segment({0, side}, {0, side * r}),
                           arc({0, 0}, r, side * pi / 2, side * pi / 2 - pi), segment({0, -side * r}, {0, -side})}};
  }
  for (const double from : {-pi / 2, pi / 2})
    cad.faces[++ref] = {[r](Vec2 p) {
                          const double c = r * std::cos(p.x()), s = r * std::sin(p.x());
                          return SurfaceJet{{c, s, p.y()}, {-s, c, 0}, {0, 0, 1}, {-c, -s, 0}, {}, {}};
                        },
                        rectangle({from, 0}, {from + pi, h})};
  for (const double side : {1., -1.}) {
    const auto across = [side](Vec2 p) { return SurfaceJet{{side, p.x(), p.y()}, {0, 1, 0}, {0, 0, 1}, {}, {}, {}}; };
    cad.faces[++ref] = {across, rectangle({-1, 0}, {1, h})};
    const auto along = [side](Vec2 p) { return SurfaceJet{{p.x(), side, p.y()}, {1, 0, 0}, {0, 0, 1}, {}, {}, {}}; };
    for (const auto& [low, high] : {std::pair{-1., 0.}, std::pair{0., 1.}}) cad.faces[++ref] = {along, rectangle({low, 0}, {high, h})};
  }
  return cad;
}

inline double off_drilled_plate(double r, const Vec3& p) {
  double off = std::abs(std::hypot(p.x(), p.y()) - r);
  for (const double d : {p.z(), p.z() - plate_height, std::abs(p.x()) - 1, std::abs(p.y()) - 1}) off = std::min(off, std::abs(d));
  return off;
}

}  // namespace carreau::testing
