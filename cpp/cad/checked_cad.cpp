#include "cad/checked_cad.h"

#include <cmath>
#include <string>

#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

[[noreturn]] void not_finite(const Where& where, const char* routine) {
  throw CallbackError(where, std::string(routine) + " returned a value that is not finite");
}

[[noreturn]] void not_a_number(const Where& where, const char* routine) {
  throw CallbackError(where, std::string(routine) + " returned a value that is not a number");
}

}  // namespace

void CheckedCad::surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) {
  counter_.add_surface(want, uv.size());
  host_.surface(face, want, uv, out);
  for (std::size_t i = 0; i < uv.size(); ++i) {
    const SurfaceJet& jet = out[i];
    const Where where{.face = face, .uv = uv[i]};
    if ((want & want_position) != 0 && !is_finite(jet.s)) not_finite(where, "surf0");
    if ((want & want_first) != 0 && !(is_finite(jet.su) && is_finite(jet.sv))) not_finite(where, "surf1");
    if ((want & want_second) != 0 && !(is_finite(jet.suu) && is_finite(jet.suv) && is_finite(jet.svv)))
      not_finite(where, "surf2");
  }
}

Interval CheckedCad::curve_interval(int face, int ic) {
  const Interval interval = host_.curve_interval(face, ic);
  if (std::isfinite(interval.a) && std::isfinite(interval.b) && interval.a < interval.b) return interval;
  throw CallbackError(Where{.face = face, .curve_index = ic},
                      "curv_int returned the interval [" + format_number(interval.a) + ", " +
                          format_number(interval.b) +
                          (interval.a >= interval.b ? "], which is reversed or empty" : "], which is not finite"));
}

CurveJet CheckedCad::curve(int face, int ic, unsigned want, double t) {
  counter_.add_curve(want);
  const CurveJet jet = host_.curve(face, ic, want, t);
  const Where where{.face = face, .curve_index = ic, .t = t};
  if ((want & want_position) != 0 && !is_finite(jet.c)) not_finite(where, "curv0");
  if ((want & want_first) != 0 && !is_finite(jet.ct)) not_finite(where, "curv1");
  if ((want & want_second) != 0 && !is_finite(jet.ctt)) not_finite(where, "curv2");
  return jet;
}

// Only an infinite radius has a meaning (a plane, a straight line: RT-0232 sec. 3.1.3 b).
std::optional<double> CheckedCad::surface_size(int face, Vec2 uv) {
  counter_.add_size();
  const std::optional<double> h = host_.surface_size(face, uv);
  if (h && !std::isfinite(*h)) not_finite({.face = face, .uv = uv}, "cad_hphys");
  return h;
}

std::optional<double> CheckedCad::curve_size(int face, int ic, double t) {
  counter_.add_size();
  const std::optional<double> h = host_.curve_size(face, ic, t);
  if (h && !std::isfinite(*h)) not_finite({.face = face, .curve_index = ic, .t = t}, "cad_hphyc");
  return h;
}

std::optional<double> CheckedCad::point_size(int point) {
  counter_.add_size();
  const std::optional<double> h = host_.point_size(point);
  if (h && !std::isfinite(*h)) not_finite({.point = point}, "cad_hphyp");
  return h;
}

std::optional<double> CheckedCad::surface_radius(int face, Vec2 uv) {
  counter_.add_size();
  const std::optional<double> rho = host_.surface_radius(face, uv);
  if (rho && std::isnan(*rho)) not_a_number({.face = face, .uv = uv}, "cad_rads");
  return rho;
}

std::optional<double> CheckedCad::curve_radius(int face, int ic, double t) {
  counter_.add_size();
  const std::optional<double> rho = host_.curve_radius(face, ic, t);
  if (rho && std::isnan(*rho)) not_a_number({.face = face, .curve_index = ic, .t = t}, "cad_radc");
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
