// SPDX-License-Identifier: BSD-3-Clause
#include "cad/difference_cad.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "support/error.h"
#include "support/format.h"
#include "support/pieces.h"

namespace carreau {

namespace {

// Truncation step^2 against rounding eps / step: cube root of eps, a little wider for hosts that compute less well.
constexpr double first_step = 1e-5;
// With eps / step^2: fourth root of eps.
constexpr double second_step = 2e-4;
// Points whose stencils are evaluated in one batch.
constexpr std::size_t chunk = 512;
// Directions of formulas beside a boundary: half the angle between both, in radians, and the number of their bisectors.
// Corners of a domain are seldom sharper than the last one.
struct Fan {
  double half_angle;
  int bisectors;
};
constexpr Fan fans[] = {{0.785, 16}, {0.35, 16}, {0.12, 48}, {0.03, 192}};
// Fractions of the usual step, where domains are narrow.
constexpr double narrow_steps[] = {1, 0.125, 0.015625};
// Steps from the boundary to a place whose derivatives replace those of a singular boundary, or of a cusp; and the radius
// around the place that must lie inside, as a share of the way.
constexpr double steps_inside[] = {32, 8, 2, 256};
constexpr double radius_inside = 0.5;
// Step there, as a share of the radius: differences of a root lose a digit by 1 / 16, none by 1 / 64.
constexpr double step_inside = 1.0 / 64;
// A fourth of the step changes derivatives by less than the first share of them, unless they grow without bound; and
// rounding changes them by less than the second share of the first derivatives over the box.
constexpr double singular_change = 0.25, rounding_change = 1e-3;
// Places inside by which positions outside are extrapolated, in ways from the boundary.
constexpr double ways_inside[] = {1, 0.5, 0.25};

// Points of all formulas of one (u, v), in the order in which `combine` reads the values.
void append_points(bool second_from_position, Vec2 uv, DifferenceStep u, DifferenceStep v, std::vector<Vec2>& points) {
  const int order = second_from_position ? 2 : 1;
  const Stencil along_u = stencil_of(order, u.side), along_v = stencil_of(order, v.side);
  for (int i = 0; i < along_u.count; ++i) points.push_back({uv.x() + along_u.offset[i] * u.step, uv.y()});
  for (int i = 0; i < along_v.count; ++i) points.push_back({uv.x(), uv.y() + along_v.offset[i] * v.step});
  if (!second_from_position) return;
  const Stencil mixed_u = stencil_of(1, u.side), mixed_v = stencil_of(1, v.side);
  for (int i = 0; i < mixed_u.count; ++i)
    for (int j = 0; j < mixed_v.count; ++j)
      points.push_back({uv.x() + mixed_u.offset[i] * u.step, uv.y() + mixed_v.offset[j] * v.step});
}

// Consumes the values of one (u, v) and returns their number.
std::size_t combine(unsigned missing, unsigned from, DifferenceStep u, DifferenceStep v, const SurfaceJet* value,
                    SurfaceJet& out) {
  const bool from_position = from == want_position;
  const int order = from_position && missing == want_second ? 2 : 1;
  const Stencil along_u = stencil_of(order, u.side), along_v = stencil_of(order, v.side);
  const double scale_u = 1 / std::pow(u.step, order), scale_v = 1 / std::pow(v.step, order);
  Vec3 du_s, dv_s, du_su, du_sv, dv_su, dv_sv;
  const SurfaceJet* const first = value;
  for (int i = 0; i < along_u.count; ++i, ++value) {
    const double w = along_u.weight[i] * scale_u;
    du_s = du_s + w * value->s;
    du_su = du_su + w * value->su;
    du_sv = du_sv + w * value->sv;
  }
  for (int i = 0; i < along_v.count; ++i, ++value) {
    const double w = along_v.weight[i] * scale_v;
    dv_s = dv_s + w * value->s;
    dv_su = dv_su + w * value->su;
    dv_sv = dv_sv + w * value->sv;
  }
  if (missing == want_first) {
    out.su = du_s, out.sv = dv_s;
  } else if (!from_position) {
    out.suu = du_su, out.svv = dv_sv, out.suv = 0.5 * (du_sv + dv_su);
  } else {
    out.suu = du_s, out.svv = dv_s, out.suv = {};
    const Stencil mixed_u = stencil_of(1, u.side), mixed_v = stencil_of(1, v.side);
    for (int i = 0; i < mixed_u.count; ++i)
      for (int j = 0; j < mixed_v.count; ++j, ++value)
        out.suv = out.suv + (mixed_u.weight[i] * mixed_v.weight[j] / (u.step * v.step)) * value->s;
  }
  return static_cast<std::size_t>(value - first);
}

bool is_finite(const SurfaceJet& jet, unsigned bit) {
  return bit == want_first ? carreau::is_finite(jet.su) && carreau::is_finite(jet.sv)
                           : carreau::is_finite(jet.suu) && carreau::is_finite(jet.suv) && carreau::is_finite(jet.svv);
}

}  // namespace

DifferenceCad::DifferenceCad(std::unique_ptr<Cad> source, unsigned surface_gives, unsigned curve_gives)
    : source_(std::move(source)), surface_gives_(surface_gives), curve_gives_(curve_gives) {}

void DifferenceCad::set_parameter_box(int face, Vec2 low, Vec2 high) {
  if (!(is_finite(low) && is_finite(high) && low.x() < high.x() && low.y() < high.y()))
    throw InvalidArgument(Where{.face = face},
                          "a parameter box must have finite bounds, the low ones below the high ones");
  boxes_[face] = {low, high};
}

void DifferenceCad::set_boundary(int face, std::vector<BoundaryCurve> boundary) {
  domains_.insert_or_assign(face, Domain{ParameterDomain(boundary), TrimmedDomain(face, boundary)});
}

const DifferenceCad::Domain* DifferenceCad::domain_of(int face) const {
  const auto domain = domains_.find(face);
  return domain == domains_.end() ? nullptr : &domain->second;
}

bool DifferenceCad::admits(int face, Vec2 uv, std::span<const Vec2> points, Proof proof) {
  const Domain* const domain = domain_of(face);
  if (domain == nullptr || proof == Proof::none) return true;
  if (proof == Proof::steps) return domain->steps.admits(uv, points);
  return std::all_of(points.begin(), points.end(), [&](const Vec2& p) { return domain->places.contains(p, *this); });
}

DifferenceCad::Box DifferenceCad::box_at(int face, const Vec2& uv) const {
  const auto it = boxes_.find(face);
  if (it != boxes_.end()) return it->second;
  // Without a known box: a box about the point, as wide as its parameters are large.
  const Vec2 half = {std::max(1.0, std::abs(uv.x())) / 2, std::max(1.0, std::abs(uv.y())) / 2};
  return {uv - half, uv + half};
}

// Meshes have places between a concave curve and its chords, on which the source need not be defined.
void DifferenceCad::surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) {
  const Domain* const domain = domain_of(face);
  if (domain == nullptr) return surface_inside(face, want, uv, out);
  std::vector<Vec2> inside;
  std::vector<std::optional<Vec2>> closest(uv.size());
  for (std::size_t i = 0; i < uv.size(); ++i) {
    if (!domain->known->contains(uv[i])) closest[i] = domain->places.closest_from_outside(uv[i], *this);
    if (!closest[i]) inside.push_back(uv[i]);
  }
  if (inside.size() == uv.size()) return surface_inside(face, want, uv, out);
  std::vector<SurfaceJet> jets(inside.size());
  surface_inside(face, want, inside, jets);
  for (std::size_t i = 0, next = 0; i < uv.size(); ++i) out[i] = closest[i] ? extrapolated(face, want, uv[i], *closest[i]) : jets[next++];
}

// Derivatives are the closest ones. Three places on a line through the closest one give the position by a parabola: it
// stays near the surface if derivatives grow without bound at the boundary.
SurfaceJet DifferenceCad::extrapolated(int face, unsigned want, const Vec2& uv, const Vec2& closest) {
  SurfaceJet jet;
  surface_inside(face, want, {&closest, 1}, {&jet, 1});
  if ((want & want_position) == 0) return jet;
  for (const double a : ways_inside) {
    const Vec2 places[] = {closest - a * (uv - closest), closest - 2 * a * (uv - closest)};
    if (!admits(face, closest, places, Proof::places)) continue;
    SurfaceJet values[2];
    surface_inside(face, want_position, places, values);
    jet.s = ((1 + a) * (1 + 2 * a) * jet.s - 2 * (1 + 2 * a) * values[0].s + (1 + a) * values[1].s) / (2 * a * a);
    break;
  }
  return jet;
}

void DifferenceCad::surface_inside(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) {
  const unsigned given = want & surface_gives_, missing = want & ~surface_gives_;
  if (given != 0) source_->surface(face, given, uv, out);
  for (const unsigned bit : {want_first, want_second}) {
    if ((missing & bit) == 0) continue;
    Task task{bit, want_position, bit == want_first ? first_step : second_step};
    if (bit == want_second && (surface_gives_ & want_first) != 0) task.from = want_first, task.relative = first_step;
    for_pieces(uv.size(), chunk, [&](std::size_t first, std::size_t n) {
      add_differences(face, task, uv.subspan(first, n), out.subspan(first, n));
    });
  }
}

void DifferenceCad::add_differences(int face, const Task& task, std::span<const Vec2> uv, std::span<SurfaceJet> out) {
  std::vector<Vec2> points;
  std::vector<std::pair<DifferenceStep, DifferenceStep>> steps;
  steps.reserve(uv.size());
  std::vector<char> beside;
  for (const Vec2& p : uv) {
    const Box box = box_at(face, p);
    const DifferenceStep u = difference_step(p.x(), box.low.x(), box.high.x(), task.relative),
                         v = difference_step(p.y(), box.low.y(), box.high.y(), task.relative);
    steps.emplace_back(u, v);
    const std::size_t first = points.size();
    append_points(task.second_from_position(), p, u, v, points);
    beside.push_back(admits(face, p, std::span(points).subspan(first), Proof::steps) ? 0 : 1);
    if (beside.back() != 0) points.resize(first);
  }
  std::vector<SurfaceJet> values(points.size());
  bool failed = false;
  try {
    source_->surface(face, task.from, points, values);
  } catch (const CallbackError&) {
    failed = true;  // perhaps only beside the domain: each point is tried alone
  }
  const SurfaceJet* value = values.data();
  for (std::size_t i = 0; i < uv.size(); ++i) {
    if (beside[i] != 0) {
      add_one_sided(face, task, uv[i], out[i]);
      continue;
    }
    if (!failed) value += combine(task.missing, task.from, steps[i].first, steps[i].second, value, out[i]);
    if (failed || !is_finite(out[i], task.missing)) add_one_sided(face, task, uv[i], out[i]);
  }
}

bool DifferenceCad::add_differences_at(int face, const Task& task, Vec2 uv, DifferenceStep u, DifferenceStep v,
                                       Proof proof, SurfaceJet& out) {
  std::vector<Vec2> points;
  append_points(task.second_from_position(), uv, u, v, points);
  if (!admits(face, uv, points, proof)) return false;
  std::vector<SurfaceJet> values(points.size());
  try {
    source_->surface(face, task.from, points, values);
  } catch (const CallbackError&) {
    return false;
  }
  combine(task.missing, task.from, u, v, values.data(), out);
  return is_finite(out, task.missing);
}

// Differences along two directions that lead into the domain, transformed to those of u and v: with the matrix W of both
// steps, the gradient g becomes W^T g and the Hessian H becomes W^T H W.
bool DifferenceCad::add_along_directions(int face, const Task& task, Vec2 uv, DifferenceStep u, DifferenceStep v, Proof proof, SurfaceJet& out) {
  const bool second_from_position = task.second_from_position();
  const Stencil along = stencil_of(second_from_position ? 2 : 1, Side::forward), mixed = stencil_of(1, Side::forward);
  std::vector<Vec2> points;
  for (const double narrow : narrow_steps)
    for (const auto& [half_angle, bisectors] : fans)
      for (int k = 0; k < bisectors; ++k) {
        const double angle = 2 * std::numbers::pi * k / bisectors;
        const auto step_at = [&](double a) -> Vec2 { return {narrow * u.step * std::cos(a), narrow * v.step * std::sin(a)}; };
        const Vec2 w1 = step_at(angle - half_angle), w2 = step_at(angle + half_angle);
        points.clear();
        for (const Vec2& w : {w1, w2})
          for (int i = 0; i < along.count; ++i) points.push_back(uv + along.offset[i] * w);
        for (int i = 0; second_from_position && i < mixed.count; ++i)
          for (int j = 0; j < mixed.count; ++j) points.push_back(uv + mixed.offset[i] * w1 + mixed.offset[j] * w2);
        if (!admits(face, uv, points, proof)) continue;
        std::vector<SurfaceJet> values(points.size());
        try {
          source_->surface(face, task.from, points, values);
        } catch (const CallbackError&) {
          return false;
        }
        const double det = w1.x() * w2.y() - w1.y() * w2.x();
        // Gradient of f from its differences along w1 and w2.
        const auto gradient = [&](const Vec3& d1, const Vec3& d2) {
          return std::pair<Vec3, Vec3>{(w2.y() * d1 - w1.y() * d2) / det, (w1.x() * d2 - w2.x() * d1) / det};
        };
        const auto sum = [&](std::size_t first, Vec3 SurfaceJet::*member) -> Vec3 {
          Vec3 total;
          for (int i = 0; i < along.count; ++i)
            total += along.weight[i] * (values[first + static_cast<std::size_t>(i)].*member);
          return total;
        };
        const auto count = static_cast<std::size_t>(along.count);
        if (task.missing == want_first) {
          std::tie(out.su, out.sv) = gradient(sum(0, &SurfaceJet::s), sum(count, &SurfaceJet::s));
        } else if (!second_from_position) {
          const auto [suu, suv] = gradient(sum(0, &SurfaceJet::su), sum(count, &SurfaceJet::su));
          const auto [svu, svv] = gradient(sum(0, &SurfaceJet::sv), sum(count, &SurfaceJet::sv));
          out.suu = suu, out.svv = svv, out.suv = 0.5 * (suv + svu);
        } else {
          Vec3 both;
          std::size_t at = 2 * count;
          for (int i = 0; i < mixed.count; ++i)
            for (int j = 0; j < mixed.count; ++j, ++at) both += mixed.weight[i] * mixed.weight[j] * values[at].s;
          // The columns of W^-T (H_w W^-1) by two gradients.
          const auto [a1, a2] = gradient(sum(0, &SurfaceJet::s), both);
          const auto [b1, b2] = gradient(both, sum(count, &SurfaceJet::s));
          std::tie(out.suu, out.suv) = gradient(a1, b1);
          out.svv = gradient(a2, b2).second;
        }
        return is_finite(out, task.missing);
      }
  return false;
}

// Derivatives of a place inside, near uv, all of them.
bool DifferenceCad::add_from_inside(int face, const Task& task, Vec2 uv, DifferenceStep u, DifferenceStep v, Proof proof, SurfaceJet& out) {
  constexpr int directions = 32, around = 8;
  for (const double steps : steps_inside)
    for (int k = 0; k < directions; ++k) {
      const auto at = [&](int i, int n, double way) -> Vec2 {
        const double angle = 2 * std::numbers::pi * i / n;
        return {way * u.step * std::cos(angle), way * v.step * std::sin(angle)};
      };
      const Vec2 inside = uv + at(k, directions, steps);
      std::vector<Vec2> disc{inside};
      for (int i = 0; i < around; ++i) disc.push_back(inside + at(i, around, radius_inside * steps));
      if (!admits(face, uv, disc, proof)) continue;
      for (const unsigned bit : {want_first, want_second}) {
        if (bit > task.missing || (surface_gives_ & bit) != 0) continue;
        const double share = std::min(1.0, radius_inside * steps * step_inside);
        const Task own = bit == task.missing ? task : Task{bit, want_position, first_step};
        if (!add_differences_at(face, own, inside, {share * u.step, Side::central}, {share * v.step, Side::central}, Proof::places, out)) return false;
      }
      return true;
    }
  return false;
}

bool DifferenceCad::add_on_any_side(int face, const Task& task, Vec2 uv, DifferenceStep u, DifferenceStep v, Proof proof, SurfaceJet& out) {
  const auto sides = [](Side side) {
    return side == Side::central ? std::vector{Side::central, Side::forward, Side::backward} : std::vector{side};
  };
  for (const Side side_u : sides(u.side))
    for (const Side side_v : sides(v.side))
      if (add_differences_at(face, task, uv, {u.step, side_u}, {v.step, side_v}, proof, out)) return true;
  return false;
}

// Derivatives of a hemisphere over its disc grow without bound towards the circle, and no difference there approaches
// them: its curvature comes from a place inside.
void DifferenceCad::avoid_singular_boundary(int face, const Task& task, Vec2 uv, DifferenceStep u, DifferenceStep v, SurfaceJet& out) {
  DifferenceStep finer_u = u, finer_v = v;
  finer_u.step /= 4, finer_v.step /= 4;
  SurfaceJet finer;
  if (!add_on_any_side(face, task, uv, finer_u, finer_v, Proof::steps, finer) &&
      !add_along_directions(face, task, uv, finer_u, finer_v, Proof::steps, finer))
    return;
  const Box box = box_at(face, uv);
  const Vec2 size = box.high - box.low;
  const auto norm_of = [&](const SurfaceJet& jet) {
    return size.x() * size.x() * norm(jet.suu) + size.x() * size.y() * norm(jet.suv) + size.y() * size.y() * norm(jet.svv);
  };
  SurfaceJet change;
  change.suu = finer.suu - out.suu, change.suv = finer.suv - out.suv, change.svv = finer.svv - out.svv;
  if (!(norm_of(change) > singular_change * norm_of(finer))) return;
  SurfaceJet first;
  surface_inside(face, want_first, {&uv, 1}, {&first, 1});
  if (norm_of(change) > rounding_change * (size.x() * norm(first.su) + size.y() * norm(first.sv)))
    add_from_inside(face, task, uv, u, v, Proof::steps, out);
}

// The host's domain ends near the point, inside of its box: every pair of sides that the box allows is evaluated.
void DifferenceCad::add_one_sided(int face, const Task& task, Vec2 uv, SurfaceJet& out) {
  const Box box = box_at(face, uv);
  const DifferenceStep u = difference_step(uv.x(), box.low.x(), box.high.x(), task.relative),
                       v = difference_step(uv.y(), box.low.y(), box.high.y(), task.relative);
  if (domain_of(face) == nullptr) {
    if (add_on_any_side(face, task, uv, u, v, Proof::none, out)) return;
  } else {
    if (add_on_any_side(face, task, uv, u, v, Proof::steps, out) || add_along_directions(face, task, uv, u, v, Proof::steps, out)) {
      if (task.second_from_position()) avoid_singular_boundary(face, task, uv, u, v, out);
      return;
    }
    // No step is proved to stay inside: cusps, strips narrower than a hundredth of their length. The curves decide.
    for (const double narrow : narrow_steps)
      if (add_on_any_side(face, task, uv, {narrow * u.step, u.side}, {narrow * v.step, v.side}, Proof::places, out)) return;
    if (add_along_directions(face, task, uv, u, v, Proof::places, out) || add_from_inside(face, task, uv, u, v, Proof::places, out)) return;
  }
  throw CallbackError(
      Where{.face = face, .uv = uv},
      std::string(task.missing == want_first ? "first" : "second") +
          " derivatives are not given, and the finite differences that replace them are not finite here");
}

CurveJet DifferenceCad::curve(int face, int ic, unsigned want, double t) {
  const unsigned given = want & curve_gives_, missing = want & ~curve_gives_;
  CurveJet jet;
  if (given != 0) jet = source_->curve(face, ic, given, t);
  if ((given & want_position) != 0)
    if (const Domain* const domain = domain_of(face); domain != nullptr) domain->known->add(jet.c);
  if (missing == 0) return jet;
  const Interval interval = source_->curve_interval(face, ic);
  if (!(std::isfinite(interval.a) && std::isfinite(interval.b) && interval.a < interval.b))
    throw CallbackError(Where{.face = face, .curve_index = ic}, "the interval [" + format_number(interval.a) + ", " +
                                                                    format_number(interval.b) +
                                                                    "] is reversed, empty or not finite");
  const auto difference = [&](int order, unsigned from, double relative) -> Vec2 {
    const DifferenceStep step = difference_step(t, interval.a, interval.b, relative);
    const Stencil stencil = stencil_of(order, step.side);
    Vec2 sum;
    for (int i = 0; i < stencil.count; ++i) {
      const CurveJet other = source_->curve(face, ic, from, t + stencil.offset[i] * step.step);
      sum = sum + stencil.weight[i] * (from == want_first ? other.ct : other.c);
    }
    return (1 / std::pow(step.step, order)) * sum;
  };
  if ((missing & want_first) != 0) jet.ct = difference(1, want_position, first_step);
  if ((missing & want_second) != 0)
    jet.ctt = (curve_gives_ & want_first) != 0 ? difference(1, want_first, first_step)
                                               : difference(2, want_position, second_step);
  return jet;
}

}  // namespace carreau
