// SPDX-License-Identifier: BSD-3-Clause
// Surfaces with known curvatures, and a Cad made of them.
#pragma once

#include <cmath>
#include <functional>
#include <string>

#include "cad/cad.h"
#include "common/analytic_cad.h"
#include "support/error.h"

namespace carreau::testing {

inline SurfaceJet sphere_jet(Vec2 p, double radius) {
  const double cu = std::cos(p.x()), su = std::sin(p.x()), cv = std::cos(p.y()), sv = std::sin(p.y()), r = radius;
  return {{r * cu * cv, r * su * cv, r * sv}, {-r * su * cv, r * cu * cv, 0}, {-r * cu * sv, -r * su * sv, r * cv},
          {-r * cu * cv, -r * su * cv, 0},    {r * su * sv, -r * cu * sv, 0}, {-r * cu * cv, -r * su * cv, -r * sv}};
}

inline SurfaceJet cylinder_jet(Vec2 p, double radius) {
  const double c = std::cos(p.x()), s = std::sin(p.x()), r = radius;
  return {{r * c, r * s, p.y()}, {-r * s, r * c, 0}, {0, 0, 1}, {-r * c, -r * s, 0}, {}, {}};
}

/// Minimal: k1 = -k2 = 2 / (1 + u^2 + v^2)^2.
inline SurfaceJet enneper_jet(Vec2 p) {
  const double u = p.x(), v = p.y();
  return {{u - u * u * u / 3 + u * v * v, v - v * v * v / 3 + v * u * u, u * u - v * v},
          {1 - u * u + v * v, 2 * u * v, 2 * u},
          {2 * u * v, 1 - v * v + u * u, -2 * v},
          {-2 * u, 2 * v, 2},
          {2 * v, 2 * u, 0},
          {2 * u, -2 * v, -2}};
}

/// z = u^3 - 3 u v^2: a planar umbilic at the origin.
inline SurfaceJet monkey_saddle_jet(Vec2 p) {
  const double u = p.x(), v = p.y();
  return {{u, v, u * u * u - 3 * u * v * v},
          {1, 0, 3 * u * u - 3 * v * v},
          {0, 1, -6 * u * v},
          {0, 0, 6 * u},
          {0, 0, -6 * v},
          {0, 0, -6 * u}};
}

/// One face of reference 1 with one curve; tests replace its members.
struct FaceCad : Cad {
  std::function<SurfaceJet(Vec2)> jet = [](Vec2 p) { return enneper_jet(p); };
  std::function<CurveJet(double)> along = [](double t) {
    return CurveJet{
        {std::cos(t), std::sin(2 * t)}, {-std::sin(t), 2 * std::cos(2 * t)}, {-std::cos(t), -4 * std::sin(2 * t)}};
  };
  Interval interval{0, 2};
  unsigned gives = want_position | want_first | want_second;
  CallCounts calls;

  void surface(int, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override {
    for (std::size_t i = 0; i < uv.size(); ++i) {
      out[i] = jet(uv[i]);
      calls.surf0 += (want & want_position) != 0;
      calls.surf1 += (want & want_first) != 0;
      calls.surf2 += (want & want_second) != 0;
    }
  }
  Interval curve_interval(int, int) override { return interval; }
  CurveJet curve(int, int, unsigned want, double t) override {
    calls.curv0 += (want & want_position) != 0;
    calls.curv1 += (want & want_first) != 0;
    calls.curv2 += (want & want_second) != 0;
    return along(t);
  }
  [[nodiscard]] unsigned surface_gives() const noexcept override { return gives; }
  [[nodiscard]] unsigned curve_gives() const noexcept override { return gives; }
};

/// The sentence of the CallbackError that `act` throws; "" when it throws none.
template <typename Act>
std::string callback_error(Act act) {
  try {
    act();
  } catch (const CallbackError& error) {
    return error.what();
  }
  return "";
}

}  // namespace carreau::testing
