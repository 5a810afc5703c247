#include "cad/checked_cad.h"

#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

[[noreturn]] void not_finite(const Where& where, const char* routine) {
  throw CallbackError(where, std::string(routine) + " returned a value that is not finite");
}

}  // namespace

void CheckedCad::surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) {
  const auto n = static_cast<std::int64_t>(uv.size());
  if ((want & want_position) != 0) counts_.surf0 += n;
  if ((want & want_first) != 0) counts_.surf1 += n;
  if ((want & want_second) != 0) counts_.surf2 += n;
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
  counts_.curv0 += (want & want_position) != 0;
  counts_.curv1 += (want & want_first) != 0;
  counts_.curv2 += (want & want_second) != 0;
  const CurveJet jet = host_.curve(face, ic, want, t);
  const Where where{.face = face, .curve_index = ic, .t = t};
  if ((want & want_position) != 0 && !is_finite(jet.c)) not_finite(where, "curv0");
  if ((want & want_first) != 0 && !is_finite(jet.ct)) not_finite(where, "curv1");
  if ((want & want_second) != 0 && !is_finite(jet.ctt)) not_finite(where, "curv2");
  return jet;
}

// Sizes and radii are judged by the size rules, which know what an infinite one means.
std::optional<double> CheckedCad::surface_size(int face, Vec2 uv) {
  return ++counts_.sizes, host_.surface_size(face, uv);
}
std::optional<double> CheckedCad::curve_size(int face, int ic, double t) {
  return ++counts_.sizes, host_.curve_size(face, ic, t);
}
std::optional<double> CheckedCad::point_size(int point) { return ++counts_.sizes, host_.point_size(point); }
std::optional<double> CheckedCad::surface_radius(int face, Vec2 uv) {
  return ++counts_.sizes, host_.surface_radius(face, uv);
}
std::optional<double> CheckedCad::curve_radius(int face, int ic, double t) {
  return ++counts_.sizes, host_.curve_radius(face, ic, t);
}

}  // namespace carreau
