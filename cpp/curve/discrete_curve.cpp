// SPDX-License-Identifier: BSD-3-Clause
#include "curve/discrete_curve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "curve/prescribed_edges.h"
#include "curve/unit_discretisation.h"

namespace carreau {
namespace {

/// Fewest segments of a curve that returns to its start: two would lie on each other.
constexpr int min_closed = 3;

Vec3 corner(const CurveModel& model, int point) {
  return model.topology.points[static_cast<std::size_t>(point)].position;
}

void note_gap(DiscreteCurve& d, std::size_t use, double gap) {
  if (gap > d.gap) d.gap = gap, d.gap_use = static_cast<int>(use);
}

/// Parameters and images at the ends of each use: the support has evaluated them.
void carry_ends(DiscreteCurve& d, const CurveModel& model) {
  const auto& uses = model.curve(d.curve).uses;
  const std::size_t n = d.r.size();
  d.t_of_use.assign(uses.size(), std::vector<double>(n));
  d.uv_of_use.assign(uses.size(), std::vector<Vec2>(n));
  d.refined.assign(uses.size(), 0);
  for (std::size_t u = 0; u < uses.size(); ++u) {
    const CurveSupport& s = model.support(uses[u]);
    const bool back = uses[u].reversed;
    d.t_of_use[u].front() = back ? s.t.back() : s.t.front();
    d.t_of_use[u].back() = back ? s.t.front() : s.t.back();
    d.uv_of_use[u].front() = back ? s.uv.back() : s.uv.front();
    d.uv_of_use[u].back() = back ? s.uv.front() : s.uv.back();
    note_gap(d, u, norm((back ? s.xyz.back() : s.xyz.front()) - d.xyz.front()));
    note_gap(d, u, norm((back ? s.xyz.front() : s.xyz.back()) - d.xyz.back()));
  }
}

void carry_vertex(DiscreteCurve& d, const CurveModel& model, std::size_t u, std::size_t k, double t) {
  const CurveUse& use = model.curve(d.curve).uses[u];
  d.t_of_use[u][k] = t;
  d.uv_of_use[u][k] = model.cad.curve(model.face_ref(use), use.curve + 1, want_position, t).c;
}

/// Moves vertex k of use u to the parameter nearest to the vertex in space, between its neighbours' parameters.
void refine_vertex(DiscreteCurve& d, const CurveModel& model, std::size_t u, std::size_t k) {
  const CurveUse& use = model.curve(d.curve).uses[u];
  auto& t = d.t_of_use[u];
  const auto [low, high] = std::minmax({(t[k - 1] + t[k]) / 2, (t[k] + t[k + 1]) / 2});
  const CurvePoint p =
      refine_t(model.cad, model.face_ref(use), use.curve + 1, model.support(use), t[k], low, high, d.xyz[k]);
  t[k] = p.t;
  d.uv_of_use[u][k] = p.uv;
  note_gap(d, u, p.distance);
}

const CurveUse& owner_of(const DiscreteCurve& d, const CurveModel& model) {
  return model.curve(d.curve).uses[static_cast<std::size_t>(d.owner)];
}

/// The interior vertices at which a use is probed: quarter points, and where the two supports disagree most (their
/// polylines know it without a callback).
std::vector<std::size_t> probes(const DiscreteCurve& d, const CurveModel& model, std::size_t u) {
  const std::size_t n = d.r.size() - 1;
  const auto& uses = model.curve(d.curve).uses;
  const CurveUse& owner = owner_of(d, model);
  const CurveSupport& first = model.support(owner);
  const CurveSupport& other = model.support(uses[u]);
  std::vector<std::size_t> chosen{n / 4, n / 2, n - n / 4};
  double worst = -1;
  std::size_t where = n / 2;
  for (std::size_t k = 1; k < n; ++k) {
    const auto place = [&](const CurveUse& use, const CurveSupport& support) {
      return support.point_at_arc((use.reversed ? 1 - d.r[k] : d.r[k]) * support.length());
    };
    const double apart = norm(place(owner, first) - place(uses[u], other)) / d.size[k];
    if (apart > worst) {
      worst = apart;
      where = k;
    }
  }
  chosen.push_back(where);
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  std::erase_if(chosen, [&](std::size_t k) { return k == 0 || k >= n; });
  return chosen;
}

/// Measures the distance of a few vertices from their images in use u; refines all of its parameters when it is too
/// large.
void check_use(DiscreteCurve& d, const CurveModel& model, std::size_t u, double tolerance) {
  const std::vector<std::size_t> at = probes(d, model, u);
  if (at.empty()) return;
  std::vector<Vec2> uv;
  for (const std::size_t k : at) uv.push_back(d.uv_of_use[u][k]);
  std::vector<SurfaceJet> jets(uv.size());
  model.cad.surface(model.face_ref(model.curve(d.curve).uses[u]), want_position, uv, jets);
  bool far = false;
  double gap = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double distance = norm(jets[i].s - d.xyz[at[i]]);
    gap = std::max(gap, distance);
    far = far || distance > tolerance * d.size[at[i]];
  }
  if (!far) {
    note_gap(d, u, gap);
    return;
  }
  d.refined[u] = 1;
  for (std::size_t k = 1; k + 1 < d.r.size(); ++k) refine_vertex(d, model, u, k);
}

void place_in_space(DiscreteCurve& d, const CurveModel& model) {
  const std::size_t inner = d.r.size() - 2;
  if (inner == 0) return;
  std::vector<SurfaceJet> jets(inner);
  model.cad.surface(model.face_ref(owner_of(d, model)), want_position,
                    {d.uv_of_use[static_cast<std::size_t>(d.owner)].data() + 1, inner}, jets);
  for (std::size_t k = 0; k < inner; ++k) d.xyz[k + 1] = jets[k].s;
}

void fill_sizes(DiscreteCurve& d, const Curve& curve, SizeRules& rules, bool ask_points) {
  d.size.resize(d.r.size());
  d.physical.resize(d.r.size());
  for (std::size_t k = 0; k < d.r.size(); ++k) {
    d.size[k] = d.sizes.size_at(d.r[k]);
    d.physical[k] = d.sizes.physical_at(d.r[k]);
  }
  if (rules.constant()) return;
  d.physical.front() = rules.physical_at_point(curve.end1);
  d.physical.back() = rules.physical_at_point(curve.end2);
  if (!ask_points) return;
  d.size.front() = rules.at_point(curve.end1);
  d.size.back() = rules.at_point(curve.end2);
}

std::vector<double> fractions(const DiscreteCurve& d, const Curve& curve, double length) {
  std::vector<double> s;
  for (const double r : d.sizes.r) s.push_back(r * length);
  std::vector<double> cuts = split_by_sizes(s, d.sizes.h, d.sizes.law, curve.end1 == curve.end2 ? min_closed : 1);
  for (double& cut : cuts) cut /= length;
  cuts.front() = 0;
  cuts.back() = 1;
  return cuts;
}

/// Prescribed parameters as shares of the first use's length, as far as supports determine them.
std::vector<double> fractions(const CurveModel& model, const CurvePrescription& told, const Curve& curve) {
  const CurveUse& use = curve.uses[static_cast<std::size_t>(told.use)];
  const CurveSupport& support = model.support(use);
  std::vector<double> r;
  for (const double t : told.t) {
    const double share = support.arc_at_t(t) / support.length();
    r.push_back(use.reversed ? 1 - share : share);
  }
  r.front() = 0;
  r.back() = 1;
  return r;
}

/// Computes images of all vertices in all uses, and inner vertices in space. `told`: the owner's parameters if they are
/// known.
void carry(DiscreteCurve& d, const CurveModel& model, double tolerance, const std::vector<double>& told = {}) {
  const std::vector<CurveUse>& uses = model.curve(d.curve).uses;
  carry_ends(d, model);
  for (std::size_t u = 0; u < uses.size(); ++u) {
    const bool known = !told.empty() && static_cast<int>(u) == d.owner;
    for (std::size_t k = 1; k + 1 < d.r.size(); ++k)
      carry_vertex(d, model, u, k, known ? told[k] : parameter_at(model, uses[u], d.r[k]));
  }
  place_in_space(d, model);
  for (std::size_t u = 0; u < uses.size(); ++u)
    if (static_cast<int>(u) != d.owner) check_use(d, model, u, tolerance);
}

void place_inside(DiscreteCurve& d, const std::vector<double>& inside) {
  const auto keep_ends = [&](auto& values) {
    const auto first = values.front(), last = values.back();
    values.assign(inside.size() + 2, first);
    values.back() = last;
  };
  keep_ends(d.r);
  keep_ends(d.size);
  keep_ends(d.physical);
  keep_ends(d.xyz);
  for (std::size_t i = 0; i < inside.size(); ++i) {
    d.r[i + 1] = inside[i];
    d.size[i + 1] = d.sizes.size_at(inside[i]);
    d.physical[i + 1] = d.sizes.physical_at(inside[i]);
  }
  d.gap = 0;
}

}  // namespace

DiscreteCurve discretise_curve(const CurveModel& model, int curve, SizeRules& rules, const CurveOptions& options) {
  const Curve& c = model.curve(curve);
  const double length = model.length(curve);
  DiscreteCurve d;
  d.curve = curve;
  d.indivisible = c.degenerate || !(length > 0);
  d.sizes = options.known != nullptr ? *options.known : sample_sizes(model, curve, rules, options);
  const CurvePrescription told = prescription_of(model, curve);
  d.prescribed = told.use >= 0;
  d.owner = std::max(told.use, 0);
  if (d.prescribed)
    d.r = fractions(model, told, c);
  else
    d.r = d.indivisible ? std::vector<double>{0, 1} : fractions(d, c, length);
  fill_sizes(d, c, rules, options.known == nullptr);
  d.xyz.resize(d.r.size());
  d.xyz.front() = corner(model, c.end1);
  d.xyz.back() = corner(model, c.end2);
  carry(d, model, options.carry_tolerance, told.t);
  return d;
}

void place_vertices(DiscreteCurve& d, const std::vector<double>& inside, const CurveModel& model) {
  if (d.indivisible || d.prescribed) return;
  place_inside(d, inside);
  carry(d, model, CurveOptions{}.carry_tolerance);
}

void place_vertices_at(DiscreteCurve& d, const std::vector<double>& inside, const std::vector<double>& t,
                       const CurveModel& model) {
  place_inside(d, inside);
  std::vector<double> told{0};  // ends are known
  told.insert(told.end(), t.begin(), t.end());
  told.push_back(0);
  carry(d, model, CurveOptions{}.carry_tolerance, told);
}

bool split_segment(DiscreteCurve& d, int segment, const CurveModel& model, double share) {
  if (d.indivisible || d.prescribed) return false;
  const auto k = static_cast<std::size_t>(segment);
  const auto& uses = model.curve(d.curve).uses;
  const bool halved = share == 0.5;  // the same sums as ever
  const double r = halved ? (d.r[k] + d.r[k + 1]) / 2 : d.r[k] + share * (d.r[k + 1] - d.r[k]);
  std::vector<double> t;
  for (std::size_t u = 0; u < uses.size(); ++u) {
    const double left = d.t_of_use[u][k];
    const double right = d.t_of_use[u][k + 1];
    // The shift that refine_t made at the neighbours also holds between them.
    const double shift =
        (left - parameter_at(model, uses[u], d.r[k]) + right - parameter_at(model, uses[u], d.r[k + 1])) / 2;
    double middle = parameter_at(model, uses[u], r) + shift;
    if (!(std::min(left, right) < middle && middle < std::max(left, right))) middle = (left + right) / 2;
    if (middle == left || middle == right) return false;
    t.push_back(middle);
  }
  if (!(d.r[k] < r && r < d.r[k + 1])) return false;
  const auto at = static_cast<std::ptrdiff_t>(k) + 1;
  d.r.insert(d.r.begin() + at, r);
  d.size.insert(d.size.begin() + at, d.sizes.size_at(r));
  d.physical.insert(d.physical.begin() + at, d.sizes.physical_at(r));
  d.xyz.insert(d.xyz.begin() + at, Vec3{});
  for (std::size_t u = 0; u < uses.size(); ++u) {
    d.t_of_use[u].insert(d.t_of_use[u].begin() + at, t[u]);
    d.uv_of_use[u].insert(d.uv_of_use[u].begin() + at, Vec2{});
    carry_vertex(d, model, u, k + 1, t[u]);
  }
  const auto owner = static_cast<std::size_t>(d.owner);
  d.xyz[k + 1] = surface_at(model.cad, model.face_ref(uses[owner]), want_position, d.uv_of_use[owner][k + 1]).s;
  for (std::size_t u = 0; u < uses.size(); ++u) {
    if (u != owner && d.refined[u] != 0) refine_vertex(d, model, u, k + 1);
  }
  return true;
}

}  // namespace carreau
