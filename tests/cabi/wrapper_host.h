// SPDX-License-Identifier: BSD-3-Clause
// A paraboloid by carreau.hpp: face 1 over a square, four curves, as paraboloid_cad of hosts.h.
#pragma once

#include <carreau.hpp>

namespace wrapper_tests {

inline carreau::CurvePoint side_of_paraboloid(int ic, double t) {
  constexpr std::array<carreau::Point2, 4> at{{{-2.5, -2.5}, {2.5, -2.5}, {2.5, 2.5}, {-2.5, 2.5}}};
  const carreau::Point2& from = at[static_cast<std::size_t>(ic - 1)];
  const carreau::Point2& to = at[static_cast<std::size_t>(ic % 4)];
  const carreau::Point2 along{to[0] - from[0], to[1] - from[1]};
  return {.c = {from[0] + t * along[0], from[1] + t * along[1]}, .ct = along, .ctt = {0, 0}};
}

inline carreau::SurfacePoint paraboloid_at(double u, double v) {
  return {{u, v, (u * u + v * v) / 2}, {1, 0, u}, {0, 1, v}, {0, 0, 1}, {0, 0, 0}, {0, 0, 1}};
}

inline carreau::Geometry paraboloid() {
  return {.surface_order = 2,
          .curve_order = 2,
          .surface = [](int, double u, double v, int) { return paraboloid_at(u, v); },
          .curve_interval = [](int, int) { return carreau::Interval{0, 1}; },
          .curve = [](int, int ic, double t, int) { return side_of_paraboloid(ic, t); }};
}

inline void add_sides(carreau::Session& session, int face = 1) {
  session.add_face(face);
  for (int ic = 1; ic <= 4; ++ic) session.add_curve(face, {.ref = ic, .ends = {ic, ic % 4 + 1}});
}

inline carreau::Session session_of(carreau::Geometry geometry, double size = 0.5) {
  carreau::Session session;
  session.set_geometry(std::move(geometry));
  add_sides(session);
  session.set("hphydef", size);
  return session;
}

/// The error that a call ends with, of status INTERNAL when it does not fail.
template <typename Call>
carreau::Error error_of(Call&& call) {
  try {
    call();
  } catch (const carreau::Error& error) {
    return error;
  }
  return {CARREAU_ERR_INTERNAL, "nothing was thrown"};
}

}  // namespace wrapper_tests
