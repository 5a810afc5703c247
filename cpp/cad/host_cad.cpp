#include "cad/host_cad.h"

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

#include "support/error.h"

namespace carreau {

namespace {

// Central differences lose step^2 to truncation and eps / step to rounding: the cube root of eps balances them.
constexpr double difference_step = 6e-6;

void check(std::int32_t status, const Where& where, const char* routine) {
  if (status != 0)
    throw CallbackError(where, std::string(routine) + " of the host returned the status " + std::to_string(status));
}

std::optional<double> answer(double h) { return h == no_answer ? std::nullopt : std::optional<double>(h); }

int order_of(unsigned want) { return (want & want_second) != 0 ? 2 : (want & want_first) != 0 ? 1 : 0; }

}  // namespace

HostCad::HostCad(const CadMTable& table) : is_c_(false), cad_m_(table) {
  if (table.surf0 == nullptr) throw InvalidArgument("surf0 is missing: it cannot be done without");
  if (table.curv_int == nullptr) throw InvalidArgument("curv_int is missing: it cannot be done without");
  if (table.curv0 == nullptr) throw InvalidArgument("curv0 is missing: it cannot be done without");
}

HostCad::HostCad(const HostTable& table) : is_c_(true), host_(table) {
  if (table.surface == nullptr) throw InvalidArgument("the callback surface is missing: it cannot be done without");
  if (table.curve_interval == nullptr)
    throw InvalidArgument("the callback curve_interval is missing: it cannot be done without");
  if (table.curve == nullptr) throw InvalidArgument("the callback curve is missing: it cannot be done without");
  if (table.surface_order < 0 || table.surface_order > 2 || table.curve_order < 0 || table.curve_order > 2)
    throw InvalidArgument("the orders of derivative that callbacks give must be 0, 1 or 2");
}

void HostCad::set_parameter_box(int face, Vec2 low, Vec2 high) { boxes_[face] = {low, high}; }

bool HostCad::gives_surface_order(int order) const noexcept {
  if (is_c_) return order <= host_.surface_order;
  return order == 0 || (order == 1 ? cad_m_.surf1 != nullptr : cad_m_.surf2 != nullptr);
}

bool HostCad::gives_curve_order(int order) const noexcept {
  if (is_c_) return order <= host_.curve_order;
  return order == 0 || (order == 1 ? cad_m_.curv1 != nullptr : cad_m_.curv2 != nullptr);
}

// --- surfaces -----------------------------------------------------------------------------------------------------

void HostCad::raw_surface(int face, int order, Vec2 uv, unsigned want, SurfaceJet& jet) {
  const double p[2] = {uv.x, uv.y};
  if (is_c_) {
    check(host_.surface(face, uv.x, uv.y, order, &jet.s.x, &jet.su.x, &jet.sv.x, &jet.suu.x, &jet.suv.x, &jet.svv.x,
                        host_.user),
          {.face = face, .uv = uv}, "surface");
    return;
  }
  if ((want & want_position) != 0) cad_m_.surf0(&face, p, &jet.s.x);
  if ((want & want_first) != 0) cad_m_.surf1(&face, p, &jet.su.x, &jet.sv.x);
  if ((want & want_second) != 0) cad_m_.surf2(&face, p, &jet.suu.x, &jet.suv.x, &jet.svv.x);
}

void HostCad::raw_batch(int face, int order, std::span<const Vec2> uv, std::span<SurfaceJet> out) {
  const std::size_t n = uv.size();
  std::vector<double> in(2 * n), values(18 * n);
  for (std::size_t i = 0; i < n; ++i) in[2 * i] = uv[i].x, in[2 * i + 1] = uv[i].y;
  double* at[6];
  for (int k = 0; k < 6; ++k)
    at[k] = (k == 0 || order >= 2 || (order == 1 && k <= 2)) ? values.data() + 3 * n * static_cast<std::size_t>(k)
                                                             : nullptr;
  check(host_.surface_batch(face, static_cast<std::int64_t>(n), in.data(), order, at[0], at[1], at[2], at[3], at[4],
                            at[5], host_.user),
        {.face = face}, "surface_batch");
  const auto vector = [&](int k, std::size_t i) {
    return at[k] == nullptr ? Vec3{} : Vec3{at[k][3 * i], at[k][3 * i + 1], at[k][3 * i + 2]};
  };
  for (std::size_t i = 0; i < n; ++i)
    out[i] = {vector(0, i), vector(1, i), vector(2, i), vector(3, i), vector(4, i), vector(5, i)};
}

std::pair<double, double> HostCad::steps(int face, double at, bool second_parameter, double relative) const {
  const auto box = boxes_.find(face);
  if (box == boxes_.end()) {
    const double step = relative * std::max(1.0, std::abs(at));
    return {step, step};
  }
  const double low = second_parameter ? box->second.low.y : box->second.low.x,
               high = second_parameter ? box->second.high.y : box->second.high.x;
  const double step = relative * std::max({high - low, 1e-3 * std::abs(low), 1e-3 * std::abs(high)});
  return {std::clamp(at - low, 0.0, step), std::clamp(high - at, 0.0, step)};
}

void HostCad::difference_surface(int face, unsigned missing, Vec2 uv, SurfaceJet& jet) {
  const bool first_known = gives_surface_order(1);
  // f(x - a), f(x), f(x + b): the derivative of the parabola through them; one-sided and of second order where a or b
  // is 0.
  const auto at = [&](double du, double dv, unsigned want) {
    SurfaceJet other;
    raw_surface(face, order_of(want), {uv.x + du, uv.y + dv}, want, other);
    return other;
  };
  const auto derivative = [](Vec3 before, Vec3 here, Vec3 after, double a, double b) {
    const double wa = -b / (a * (a + b)), wb = a / (b * (a + b));
    return wa * before + (-(wa + wb)) * here + wb * after;
  };
  const auto sample = [&](bool v, double relative, unsigned want, double& a, double& b) {
    std::tie(a, b) = steps(face, v ? uv.y : uv.x, v, relative);
    const auto moved = [&](double d) { return v ? at(0, d, want) : at(d, 0, want); };
    const double full = std::max(a, b);
    // At the border both neighbours lie on the same side: at one and at two steps.
    if (a < 0.5 * full) return a = -full, b = 2 * full, std::pair{moved(full), moved(2 * full)};
    if (b < 0.5 * full) return b = -full, a = 2 * full, std::pair{moved(-2 * full), moved(-full)};
    return std::pair{moved(-a), moved(b)};
  };
  double a = 0, b = 0;
  if ((missing & want_first) != 0) {
    const SurfaceJet here = at(0, 0, want_position);
    const auto [u0, u1] = sample(false, difference_step, want_position, a, b);
    jet.su = derivative(u0.s, here.s, u1.s, a, b);
    const auto [v0, v1] = sample(true, difference_step, want_position, a, b);
    jet.sv = derivative(v0.s, here.s, v1.s, a, b);
  }
  if ((missing & want_second) == 0) return;
  if (first_known) {
    const SurfaceJet here = at(0, 0, want_first);
    const auto [u0, u1] = sample(false, difference_step, want_first, a, b);
    jet.suu = derivative(u0.su, here.su, u1.su, a, b);
    jet.suv = derivative(u0.sv, here.sv, u1.sv, a, b);
    const auto [v0, v1] = sample(true, difference_step, want_first, a, b);
    jet.svv = derivative(v0.sv, here.sv, v1.sv, a, b);
    return;
  }
  // From positions alone: a wider step, since rounding is divided by its square.
  constexpr double wide = 1e-4;
  const auto first_at = [&](double du, double dv) {
    const Vec2 kept = uv;
    uv = {kept.x + du, kept.y + dv};
    SurfaceJet j;
    const SurfaceJet here = at(0, 0, want_position);
    double p = 0, q = 0;
    const auto [u0, u1] = sample(false, wide, want_position, p, q);
    j.su = derivative(u0.s, here.s, u1.s, p, q);
    const auto [v0, v1] = sample(true, wide, want_position, p, q);
    j.sv = derivative(v0.s, here.s, v1.s, p, q);
    uv = kept;
    return j;
  };
  const SurfaceJet here = first_at(0, 0);
  const auto outer = [&](bool v, double& p, double& q) {
    std::tie(p, q) = steps(face, v ? uv.y : uv.x, v, wide);
    const auto moved = [&](double d) { return v ? first_at(0, d) : first_at(d, 0); };
    const double full = std::max(p, q);
    if (p < 0.5 * full) return p = -full, q = 2 * full, std::pair{moved(full), moved(2 * full)};
    if (q < 0.5 * full) return q = -full, p = 2 * full, std::pair{moved(-2 * full), moved(-full)};
    return std::pair{moved(-p), moved(q)};
  };
  const auto [u0, u1] = outer(false, a, b);
  jet.suu = derivative(u0.su, here.su, u1.su, a, b);
  jet.suv = derivative(u0.sv, here.sv, u1.sv, a, b);
  const auto [v0, v1] = outer(true, a, b);
  jet.svv = derivative(v0.sv, here.sv, v1.sv, a, b);
}

void HostCad::surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) {
  unsigned missing = 0;
  for (const auto& [bit, order] : {std::pair{want_first, 1}, std::pair{want_second, 2}})
    if ((want & bit) != 0 && !gives_surface_order(order)) missing |= bit;
  const unsigned given = want & ~missing;
  if (is_c_ && host_.surface_batch != nullptr && given != 0) {
    raw_batch(face, order_of(given), uv, out);
  } else if (given != 0) {
    for (std::size_t i = 0; i < uv.size(); ++i) raw_surface(face, order_of(given), uv[i], given, out[i]);
  }
  if (missing != 0)
    for (std::size_t i = 0; i < uv.size(); ++i) difference_surface(face, missing, uv[i], out[i]);
}

// --- curves -------------------------------------------------------------------------------------------------------

Interval HostCad::curve_interval(int face, int ic) {
  Interval interval{0, 0};
  if (is_c_)
    check(host_.curve_interval(face, ic, &interval.a, &interval.b, host_.user), {.face = face, .curve_index = ic},
          "curve_interval");
  else
    cad_m_.curv_int(&face, &ic, &interval.a, &interval.b);
  return interval;
}

CurveJet HostCad::raw_curve(int face, int ic, int order, unsigned want, double t) {
  CurveJet jet;
  if (is_c_) {
    check(host_.curve(face, ic, t, order, &jet.c.x, &jet.ct.x, &jet.ctt.x, host_.user),
          {.face = face, .curve_index = ic, .t = t}, "curve");
    return jet;
  }
  if ((want & want_position) != 0) cad_m_.curv0(&face, &ic, &t, &jet.c.x);
  if ((want & want_first) != 0) cad_m_.curv1(&face, &ic, &t, &jet.ct.x);
  if ((want & want_second) != 0) cad_m_.curv2(&face, &ic, &t, &jet.ctt.x);
  return jet;
}

CurveJet HostCad::curve(int face, int ic, unsigned want, double t) {
  unsigned missing = 0;
  if ((want & want_first) != 0 && !gives_curve_order(1)) missing |= want_first;
  if ((want & want_second) != 0 && !gives_curve_order(2)) missing |= want_second;
  const unsigned given = want & ~missing;
  CurveJet jet;
  if (given != 0) jet = raw_curve(face, ic, order_of(given), given, t);
  if (missing == 0) return jet;
  const Interval range = curve_interval(face, ic);
  const bool from_first = gives_curve_order(1) && (missing & want_first) == 0;
  const double step = (from_first ? difference_step : 1e-4) * (range.b - range.a);
  // Three points inside the interval; the parabola through them gives both derivatives at t.
  const double middle = std::clamp(t, range.a + step, range.b - step), at[3] = {middle - step, middle, middle + step};
  Vec2 value[3];
  for (int k = 0; k < 3; ++k) {
    const unsigned w = from_first ? want_first : want_position;
    const CurveJet other = raw_curve(face, ic, order_of(w), w, at[k]);
    value[k] = from_first ? other.ct : other.c;
  }
  const Vec2 slope = (0.5 / step) * (value[2] - value[0]),
             bend = (1 / (step * step)) * (value[0] + value[2] - 2 * value[1]);
  const Vec2 derivative = slope + (t - middle) * bend;
  if ((missing & want_first) != 0) jet.ct = derivative;
  if ((missing & want_second) != 0) jet.ctt = from_first ? derivative : bend;
  return jet;
}

// --- sizes --------------------------------------------------------------------------------------------------------

std::optional<double> HostCad::surface_size(int face, Vec2 uv) {
  double h = no_answer;
  const double p[2] = {uv.x, uv.y};
  if (is_c_ && host_.surface_size != nullptr)
    check(host_.surface_size(face, uv.x, uv.y, &h, host_.user), {.face = face, .uv = uv}, "surface_size");
  if (!is_c_ && cad_m_.cad_hphys != nullptr) cad_m_.cad_hphys(&face, p, &h);
  return answer(h);
}

std::optional<double> HostCad::curve_size(int face, int ic, double t) {
  double h = no_answer;
  if (is_c_ && host_.curve_size != nullptr)
    check(host_.curve_size(face, ic, t, &h, host_.user), {.face = face, .curve_index = ic, .t = t}, "curve_size");
  if (!is_c_ && cad_m_.cad_hphyc != nullptr) cad_m_.cad_hphyc(&face, &ic, &t, &h);
  return answer(h);
}

std::optional<double> HostCad::point_size(int point) {
  double h = no_answer;
  if (is_c_ && host_.point_size != nullptr)
    check(host_.point_size(point, &h, host_.user), {.point = point}, "point_size");
  if (!is_c_ && cad_m_.cad_hphyp != nullptr) cad_m_.cad_hphyp(&point, &h);
  return answer(h);
}

std::optional<double> HostCad::surface_radius(int face, Vec2 uv) {
  double rho = no_answer;
  const double p[2] = {uv.x, uv.y};
  if (is_c_ && host_.surface_radius != nullptr)
    check(host_.surface_radius(face, uv.x, uv.y, &rho, host_.user), {.face = face, .uv = uv}, "surface_radius");
  if (!is_c_ && cad_m_.cad_rads != nullptr) cad_m_.cad_rads(&face, p, &rho);
  return answer(rho);
}

std::optional<double> HostCad::curve_radius(int face, int ic, double t) {
  double rho = no_answer;
  if (is_c_ && host_.curve_radius != nullptr)
    check(host_.curve_radius(face, ic, t, &rho, host_.user), {.face = face, .curve_index = ic, .t = t}, "curve_radius");
  if (!is_c_ && cad_m_.cad_radc != nullptr) cad_m_.cad_radc(&face, &ic, &t, &rho);
  return answer(rho);
}

}  // namespace carreau
