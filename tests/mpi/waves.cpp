// SPDX-License-Identifier: BSD-3-Clause
#include "waves.h"

#include <array>
#include <cmath>
#include <csignal>

namespace mpi_tests {

namespace {

bool is_inside(double u, double v) { return u > 0.01 && u < 0.99 && v > 0.01 && v < 0.99; }

bool is_at_fault(const Waves& waves, std::int32_t face) { return waves.cells == 1 || face == waves.face; }

/// 0, or the value that the callback returns.
std::int32_t misbehave(Waves& waves, std::int32_t face, double u, double v) {
  if (waves.fault == Fault::status) return 42;
  if (!is_at_fault(waves, face) || !is_inside(u, v)) return 0;
  if (waves.fault == Fault::status_inside) return 43;
  if (waves.fault == Fault::stop) carreau_stop(waves.session);
  if (waves.fault == Fault::no_memory) memory_is_short = true;
  if (waves.fault == Fault::dies) std::raise(SIGKILL);
  return 0;
}

double height(const Waves& waves, std::int32_t face, double u, double v) {
  constexpr double slightly = 1e-9;
  if (waves.fault == Fault::other_curves) return slightly;
  if (waves.fault == Fault::other_inside && is_at_fault(waves, face)) return is_inside(u, v) ? slightly : 0;
  return 0;
}

std::int32_t surface(std::int32_t face, double u, double v, std::int32_t order, double* S, double* Su, double* Sv,
                     double* Suu, double* Suv, double* Svv, void* user) {
  auto& waves = *static_cast<Waves*>(user);
  ++waves.asked;
  if (const std::int32_t status = misbehave(waves, face, u, v); status != 0) return status;
  const int cell = face - 1;
  const double x = cell % waves.cells + u, y = cell / waves.cells + v;
  const double sx = std::sin(x), cx = std::cos(x), sy = std::sin(y), cy = std::cos(y);
  S[0] = x, S[1] = y, S[2] = sx * sy / 2 + height(waves, face, u, v);
  if (order >= 1) Su[0] = 1, Su[1] = 0, Su[2] = cx * sy / 2, Sv[0] = 0, Sv[1] = 1, Sv[2] = sx * cy / 2;
  if (order >= 2)
    for (int i = 0; i < 2; ++i) Suu[i] = Suv[i] = Svv[i] = 0;
  if (order >= 2) Suu[2] = -S[2], Suv[2] = cx * cy / 2, Svv[2] = -S[2];
  // bulge * p(u) p(v), p(u) = 4 u (1 - u).
  const double pu = 4 * u * (1 - u), pv = 4 * v * (1 - v), du = 4 - 8 * u, dv = 4 - 8 * v, b = waves.bulge;
  S[2] += b * pu * pv;
  if (order >= 1) Su[2] += b * du * pv, Sv[2] += b * pu * dv;
  if (order >= 2) Suu[2] -= 8 * b * pv, Suv[2] += b * du * dv, Svv[2] -= 8 * b * pu;
  return 0;
}

std::int32_t interval(std::int32_t, std::int32_t, double* a, double* b, void*) {
  *a = 0, *b = 1;
  return 0;
}

// Sides of the unit square, counterclockwise.
std::int32_t curve(std::int32_t, std::int32_t ic, double t, std::int32_t order, double* C, double* Ct, double* Ctt, void*) {
  constexpr std::array<std::array<double, 4>, 4> sides{{{0, 0, 1, 0}, {1, 0, 0, 1}, {1, 1, -1, 0}, {0, 1, 0, -1}}};
  const auto& s = sides[static_cast<std::size_t>(ic - 1)];
  for (std::size_t i = 0; i < 2; ++i) {
    C[i] = s[i] + t * s[i + 2];
    if (order >= 1) Ct[i] = s[i + 2];
    if (order >= 2) Ctt[i] = 0;
  }
  return 0;
}

}  // namespace

carreau_status give(carreau_session* session, Waves& waves) {
  waves.session = session;
  carreau_cad cad{};
  cad.struct_size = sizeof cad;
  cad.user = &waves;
  cad.surface_order = cad.curve_order = 2;
  cad.reentrant = waves.fault == Fault::none ? 1 : 0;
  cad.surface = surface, cad.curve_interval = interval, cad.curve = curve;
  if (const carreau_status status = carreau_set_cad(session, &cad); status != CARREAU_OK) return status;
  const std::int32_t n = waves.cells;
  const auto corner = [n](int i, int j) { return 1 + i + (n + 1) * j; };
  const auto across = [n](int i, int j) { return 1 + i + n * j; };                    // from corner (i, j) to (i + 1, j)
  const auto along = [n](int i, int j) { return 1 + n * (n + 1) + j + n * i; };       // from corner (i, j) to (i, j + 1)
  carreau_status status = CARREAU_OK;
  const auto add = [&](std::int32_t face, std::int32_t ref, std::int32_t a, std::int32_t b) {
    if (status == CARREAU_OK) status = carreau_model_add_curve(session, face, CARREAU_BOUNDARY, ref, a, b);
  };
  for (int j = 0; j < n && status == CARREAU_OK; ++j)
    for (int i = 0; i < n && status == CARREAU_OK; ++i) {
      const std::int32_t face = 1 + i + n * j;
      status = carreau_model_add_face(session, face, 1);
      add(face, across(i, j), corner(i, j), corner(i + 1, j));
      add(face, along(i + 1, j), corner(i + 1, j), corner(i + 1, j + 1));
      add(face, across(i, j + 1), corner(i + 1, j + 1), corner(i, j + 1));
      add(face, along(i, j), corner(i, j + 1), corner(i, j));
    }
  return status;
}

}  // namespace mpi_tests
