// SPDX-License-Identifier: BSD-3-Clause
#include "cad/checked_cad.h"

#include <cmath>
#include <string>

#include "cad/host_exceptions.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

// Squares of lengths, and their products, must not overflow.
constexpr double largest = 1e75;

[[noreturn]] void not_finite(const Where& where, const char* routine) {
  throw CallbackError(where, std::string(routine) + " returned a value that is not finite");
}

void check_number(double x, const Where& where, const char* routine) {
  if (std::abs(x) <= largest) return;
  if (!std::isfinite(x)) not_finite(where, routine);
  throw CallbackError(where, std::string(routine) + " returned " + format_number(x) +
                                 ", which is too large to compute with (beyond " + format_number(largest) + ")");
}
bool is_usable(const Vec3& v) {  // false for NaN
  return std::abs(v.x()) <= largest && std::abs(v.y()) <= largest && std::abs(v.z()) <= largest;
}
void check_vector(const Vec3& v, const Where& where, const char* routine) {
  for (const double x : {v.x(), v.y(), v.z()}) check_number(x, where, routine);
}
void check_vector(const Vec2& v, const Where& where, const char* routine) {
  for (const double x : {v.x(), v.y()}) check_number(x, where, routine);
}

bool is_usable(const SurfaceJet& jet, unsigned want) {
  return ((want & want_position) == 0 || is_usable(jet.s)) &&
         ((want & want_first) == 0 || (is_usable(jet.su) && is_usable(jet.sv))) &&
         ((want & want_second) == 0 || (is_usable(jet.suu) && is_usable(jet.suv) && is_usable(jet.svv)));
}

/// Checks a size of a host; values that mean no answer have been sorted out.
void check_size(double h, const Where& where, const char* routine) {
  check_number(h, where, routine);
  if (!(h > 0))
    throw CallbackError(where, std::string(routine) + " returned the size " + format_number(h) + ", which is not positive");
}

[[noreturn]] void not_a_number(const Where& where, const char* routine) {
  throw CallbackError(where, std::string(routine) + " returned a value that is not a number");
}

}  // namespace

void CheckedCad::surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) {
  counter_.add_surface(want, uv.size());
  if (uv.empty()) return;
  const char* const asked = (want & want_second) != 0 ? "surf2" : (want & want_first) != 0 ? "surf1" : "surf0";
  ask_host({.face = face, .uv = uv.front()}, asked, [&] { host_.surface(face, want, uv, out); });
  for (std::size_t i = 0; i < uv.size(); ++i) {
    const SurfaceJet& jet = out[i];
    if (is_usable(jet, want)) continue;
    const Where where{.face = face, .uv = uv[i]};
    if ((want & want_position) != 0) check_vector(jet.s, where, "surf0");
    if ((want & want_first) != 0)
      for (const Vec3& v : {jet.su, jet.sv}) check_vector(v, where, "surf1");
    if ((want & want_second) != 0)
      for (const Vec3& v : {jet.suu, jet.suv, jet.svv}) check_vector(v, where, "surf2");
  }
}

Interval CheckedCad::curve_interval(int face, int ic) {
  const Interval interval =
      ask_host({.face = face, .curve_index = ic}, "curv_int", [&] { return host_.curve_interval(face, ic); });
  if (std::isfinite(interval.a) && std::isfinite(interval.b) && interval.a < interval.b) return interval;
  throw CallbackError(Where{.face = face, .curve_index = ic},
                      "curv_int returned the interval [" + format_number(interval.a) + ", " +
                          format_number(interval.b) +
                          (interval.a >= interval.b ? "], which is reversed or empty" : "], which is not finite"));
}

CurveJet CheckedCad::curve(int face, int ic, unsigned want, double t) {
  counter_.add_curve(want);
  const Where where{.face = face, .curve_index = ic, .t = t};
  const char* const asked = (want & want_second) != 0 ? "curv2" : (want & want_first) != 0 ? "curv1" : "curv0";
  const CurveJet jet = ask_host(where, asked, [&] { return host_.curve(face, ic, want, t); });
  if ((want & want_position) != 0) check_vector(jet.c, where, "curv0");
  if ((want & want_first) != 0) check_vector(jet.ct, where, "curv1");
  if ((want & want_second) != 0) check_vector(jet.ctt, where, "curv2");
  return jet;
}

// Only an infinite radius has a meaning (a plane, a straight line: RT-0232 sec. 3.1.3 b).
std::optional<double> CheckedCad::surface_size(int face, Vec2 uv) {
  counter_.add_size();
  const Where where{.face = face, .uv = uv};
  const std::optional<double> h = ask_host(where, "cad_hphys", [&] { return host_.surface_size(face, uv); });
  if (h) check_size(*h, where, "cad_hphys");
  return h;
}

std::optional<double> CheckedCad::curve_size(int face, int ic, double t) {
  counter_.add_size();
  const Where where{.face = face, .curve_index = ic, .t = t};
  const std::optional<double> h = ask_host(where, "cad_hphyc", [&] { return host_.curve_size(face, ic, t); });
  if (h) check_size(*h, where, "cad_hphyc");
  return h;
}

std::optional<double> CheckedCad::point_size(int point) {
  counter_.add_size();
  const Where where{.point = point};
  const std::optional<double> h = ask_host(where, "cad_hphyp", [&] { return host_.point_size(point); });
  if (h) check_size(*h, where, "cad_hphyp");
  return h;
}

std::optional<double> CheckedCad::surface_radius(int face, Vec2 uv) {
  counter_.add_size();
  const Where where{.face = face, .uv = uv};
  const std::optional<double> rho = ask_host(where, "cad_rads", [&] { return host_.surface_radius(face, uv); });
  if (rho && std::isnan(*rho)) not_a_number(where, "cad_rads");
  return rho;
}

std::optional<double> CheckedCad::curve_radius(int face, int ic, double t) {
  counter_.add_size();
  const Where where{.face = face, .curve_index = ic, .t = t};
  const std::optional<double> rho = ask_host(where, "cad_radc", [&] { return host_.curve_radius(face, ic, t); });
  if (rho && std::isnan(*rho)) not_a_number(where, "cad_radc");
  return rho;
}

CallCounts CheckedCad::counts() const noexcept {
  const CallCounts now = host_.counts();
  if (now == CallCounts{}) return counter_.counts();  // the host keeps no count (or nothing was called)
  return {.surf0 = now.surf0 - before_.surf0,
          .surf1 = now.surf1 - before_.surf1,
          .surf2 = now.surf2 - before_.surf2,
          .curv0 = now.curv0 - before_.curv0,
          .curv1 = now.curv1 - before_.curv1,
          .curv2 = now.curv2 - before_.curv2,
          .sizes = now.sizes - before_.sizes};
}

}  // namespace carreau
