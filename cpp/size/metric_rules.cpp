// SPDX-License-Identifier: BSD-3-Clause
// Sizes that may differ by direction: sources of prescriptions, anisotropic geometry, and their combination.
#include <algorithm>
#include <cmath>
#include <string>

#include "size/size_rules.h"
#include "support/format.h"

namespace carreau {
namespace {

constexpr Metric2 isotropic(double h) noexcept { return {1 / (h * h), 0, 1 / (h * h)}; }

/// Size along a unit vector.
double size_along(Metric2 m, const Vec2& d) noexcept { return 1 / length(m, d); }

/// In an orthonormal basis of the tangent plane.
Metric2 in_plane(const DirectedSizes& sizes, const TangentFrame& frame) noexcept {
  const auto term = [&](Vec3 w, double h) {
    const Vec2 d{dot(w, frame.e1) / h, dot(w, frame.e2) / h};
    return Metric2{d.x() * d.x(), d.x() * d.y(), d.y() * d.y()};
  };
  return sizes.h1 == sizes.h2 ? isotropic(sizes.h1) : term(sizes.w1, sizes.h1) + term(sizes.w2, sizes.h2);
}

std::string text_of(const Metric3& m) {
  return "(xx, xy, xz, yy, yz, zz) = (" + format_number(m.xx) + ", " + format_number(m.xy) + ", " +
         format_number(m.xz) + ", " + format_number(m.yy) + ", " + format_number(m.yz) + ", " + format_number(m.zz) +
         ")";
}

std::string text_of(Metric2 m) {
  return "(a, b, c) = (" + format_number(m.a) + ", " + format_number(m.b) + ", " + format_number(m.c) + ")";
}

/// A definite metric within 1e-12 of a semi-definite one is not usable either. A size stands for the metric I / h^2, and
/// is positive.
void check(const Prescription& p, const PrescriptionSource& source, const Where& where) {
  const auto refuse = [&](const std::string& what) { throw CallbackError(where, source.name() + " returned " + what); };
  const auto finite = [](auto... x) { return (std::isfinite(x) && ...); };
  switch (p.kind) {
    case Prescription::Kind::none:
      return;
    case Prescription::Kind::size:
      if (!finite(p.size)) refuse("the size " + format_number(p.size) + ", which is not a finite number");
      if (!(p.size > 0)) refuse("the size " + format_number(p.size) + ", which is not positive");
      return;
    case Prescription::Kind::space: {
      const Metric3& m = p.space;
      if (!finite(m.xx, m.xy, m.xz, m.yy, m.yz, m.zz)) refuse("the metric " + text_of(m) + ", which is not finite");
      if (!is_positive_definite(m)) refuse("the metric " + text_of(m) + ", which is not positive definite");
      return;
    }
    case Prescription::Kind::parameter: {
      const Metric2 m = p.parameter;
      if (!finite(m.a, m.b, m.c)) refuse("the metric " + text_of(m) + ", which is not finite");
      if (!is_positive_definite(m)) refuse("the metric " + text_of(m) + ", which is not positive definite");
      return;
    }
  }
}

Prescription enlarged(Prescription p, double factor) noexcept {
  const double k = 1 / (factor * factor);
  p.size *= factor;
  for (double* m : {&p.space.xx, &p.space.xy, &p.space.xz, &p.space.yy, &p.space.yz, &p.space.zz}) *m *= k;
  p.parameter = k * p.parameter;
  return p;
}

}  // namespace

/// A place of a face on a curve: unit tangent in the frame, and what the geometry asks for.
struct SizeRules::CurvePlace {
  Vec2 uv;
  SurfaceJet jet;
  std::optional<TangentFrame> frame;  // empty: nothing is known here
  Vec2 direction;
  std::optional<Metric2> geometric;
};

struct SizeRules::AlongCurve {
  bool by_curve = false;  // or given; else by surfaces
  bool answered = false;
  double physical = 0, h = infinity;
};

bool SizeRules::needs_positions() const noexcept {
  return asks_sources() && std::any_of(parameters_.sources.begin(), parameters_.sources.end(),
                                       [](const PrescriptionSource* s) { return s->needs_position(); });
}

double SizeRules::source_accuracy() const noexcept {
  double accuracy = 0;
  if (asks_sources())
    for (const PrescriptionSource* source : parameters_.sources) accuracy = std::max(accuracy, source->accuracy());
  return accuracy;
}

bool SizeRules::asks_curves_only() const noexcept {
  return asks_sources() && std::any_of(parameters_.sources.begin(), parameters_.sources.end(),
                                       [](const PrescriptionSource* s) { return s->curves_only(); });
}

std::vector<Vec2> SizeRules::steep_places(int face) const {
  std::vector<Vec2> places;
  if (!asks_sources()) return places;
  for (const PrescriptionSource* source : parameters_.sources) {
    const std::vector<Vec2> more = source->steep_places(model_.faces[static_cast<std::size_t>(face)].ref);
    places.insert(places.end(), more.begin(), more.end());
  }
  return places;
}

std::vector<SteepPlace> SizeRules::steep_in_space() const {
  std::vector<SteepPlace> places;
  if (!asks_sources()) return places;
  for (const PrescriptionSource* source : parameters_.sources) {
    const std::span<const SteepPlace> more = source->steep_in_space();
    places.insert(places.end(), more.begin(), more.end());
  }
  return places;
}

std::vector<double> SizeRules::kinks_on_curve(const CurveUse& use) const {
  std::vector<double> kinks;
  if (!asks_sources()) return kinks;
  const Where where = where_of(use, 0);
  for (const PrescriptionSource* source : parameters_.sources) {
    const std::vector<double> more = source->kinks_on_curve(where.face, where.curve_index);
    kinks.insert(kinks.end(), more.begin(), more.end());
  }
  return kinks;
}

// ---- what is answered ----

/// What all sources say at points of a face, point by point: hosts that like batches get one.
std::vector<Prescription> SizeRules::told_on_surface(int face, std::span<const Vec2> uv,
                                                     std::span<const Vec3> xyz) const {
  if (!asks_sources()) return {};
  const std::size_t count = parameters_.sources.size();
  std::vector<Prescription> told(count * uv.size()), of_source(uv.size());
  for (std::size_t s = 0; s < count; ++s) {
    parameters_.sources[s]->on_surface_points(model_.faces[static_cast<std::size_t>(face)].ref, uv, xyz, of_source);
    for (std::size_t i = 0; i < uv.size(); ++i) told[count * i + s] = of_source[i];
  }
  return told;
}

SizeRules::Answers SizeRules::answers_on_surface(int face, const Vec2& uv, const Vec3& xyz) const {
  return answers_on_surface(face, uv, told_on_surface(face, {&uv, 1}, {&xyz, 1}));
}

/// `told`: by the sources, at this point.
SizeRules::Answers SizeRules::answers_on_surface(int face, const Vec2& uv, std::span<const Prescription> told) const {
  Answers answers;
  const int ref = model_.faces[static_cast<std::size_t>(face)].ref;
  for (std::size_t s = 0; s < told.size(); ++s) {
    check(told[s], *parameters_.sources[s], {.face = ref, .uv = uv});
    if (told[s].kind != Prescription::Kind::none) answers.push_back(enlarged(told[s], parameters_.enlargement));
  }
  if (parameters_.physical == PhysicalSizes::asked) {
    if (const auto size = ask_surface(face, uv)) answers.push_back(Prescription::of_size(*size));
  }
  return answers;
}

/// Of each source the first use that answers counts. What holds in one parameter plane is carried into space.
SizeRules::Answers SizeRules::answers_on_curve(int curve, std::span<const double> t) {
  Answers answers;
  if (asks_sources()) {
    const auto& uses = topology_.curves[static_cast<std::size_t>(curve)].uses;
    for (PrescriptionSource* source : parameters_.sources) {
      for (std::size_t u = 0; u < uses.size(); ++u) {
        const Where where = where_of(uses[u], t[u]);
        const Vec2 uv = cad_.curve(where.face, where.curve_index, want_position, t[u]).c;
        const SurfaceJet jet = surface_at(cad_, where.face, want_position | want_first, uv);
        const int ic =
            host_rank(model_.faces[static_cast<std::size_t>(uses[u].face)], static_cast<std::size_t>(uses[u].curve));
        Prescription p = source->on_curve(where.face, ic, t[u], uv, jet.s);
        check(p, *source, where);
        if (p.kind == Prescription::Kind::none) continue;
        if (p.kind == Prescription::Kind::parameter) {
          const auto frame = TangentFrame::of(jet.su, jet.sv);
          if (!frame) continue;
          const Metric2 tangent = frame->of_parameters(p.parameter);
          p = Prescription::of_space(frame->in_space(tangent, eigen(tangent).minor));
        }
        answers.push_back(enlarged(p, parameters_.enlargement));
        break;
      }
    }
  }
  if (parameters_.physical == PhysicalSizes::asked) {
    if (const auto size = ask_curve(curve, t)) answers.push_back(Prescription::of_size(*size));
  }
  return answers;
}

SizeRules::Answers SizeRules::answers_at_point(int point) {
  Answers answers;
  const auto& p = topology_.points[static_cast<std::size_t>(point)];
  const Where where{.point = p.ref};
  if (asks_sources()) {
    for (PrescriptionSource* source : parameters_.sources) {
      const Prescription answer = source->at_point(p.ref, p.position);
      check(answer, *source, where);
      const bool usable =
          answer.kind == Prescription::Kind::size || answer.kind == Prescription::Kind::space;  // no plane here
      if (usable) answers.push_back(enlarged(answer, parameters_.enlargement));
    }
  }
  if (parameters_.physical == PhysicalSizes::asked) {
    if (const auto size = ask_point(point)) answers.push_back(Prescription::of_size(*size));
  }
  return answers;
}

// ---- metrics of tangent planes ----

Metric2 SizeRules::clamped_in_plane(Metric2 tangent) const noexcept {
  return clamp_eigenvalues(tangent, 1 / (parameters_.hphymax * parameters_.hphymax),
                           1 / (parameters_.hphymin * parameters_.hphymin));
}

/// `answers` not empty.
Metric2 SizeRules::physical_in_plane(const Answers& answers, const TangentFrame& frame) const {
  std::optional<Metric2> all;
  for (const Prescription& p : answers) {
    Metric2 m;
    switch (p.kind) {
      case Prescription::Kind::space:
        m = clamped_in_plane(frame.restricted(p.space));
        break;
      case Prescription::Kind::parameter:
        m = clamped_in_plane(frame.of_parameters(p.parameter));
        break;
      default:
        m = isotropic(clamped_physical(p.size));
    }
    all = all ? intersection(*all, m) : m;
  }
  return *all;
}

/// Where there is no tangent plane: the metric of space, with an isotropic geometric size, induces what it can. A
/// metric of the parameter plane is added, which is no larger in any direction than the intersection.
Metric2 SizeRules::degenerate_metric(const Answers& answers, const SurfaceJet& jet, double geometric) const {
  std::optional<Metric3> space;
  Metric2 added{0, 0, 0};
  const auto intersect = [&](const Metric3& m) { space = space ? intersection(*space, m) : m; };
  for (const Prescription& p : answers) {
    if (p.kind == Prescription::Kind::space) {
      intersect(clamp_eigenvalues(p.space, 1 / (parameters_.hphymax * parameters_.hphymax),
                                  1 / (parameters_.hphymin * parameters_.hphymin)));
    } else if (p.kind == Prescription::Kind::parameter) {
      added = added + p.parameter;
    } else {
      intersect(isotropic_metric3(clamped_physical(p.size)));
    }
  }
  if (std::isfinite(geometric)) {
    const Metric3 bound = isotropic_metric3(geometric);
    space = space ? combine(*space, bound, parameters_.metric_combination) : bound;
  }
  return space ? added + induced_metric(jet.su, jet.sv, *space) : added;
}

/// Clamped. Empty where the parametrisation is degenerate.
std::optional<DirectedSizes> SizeRules::directed_sizes(int face, const Vec2& uv, const SurfaceJet& jet) const {
  const auto clamped = [&](double h) { return std::clamp(h, parameters_.hgeomin, parameters_.hgeomax); };
  if (const auto radius = host_radius_of_surface(face, uv)) {
    const double h = clamped_geometric(*radius);
    return DirectedSizes{h, h, {}, {}};
  }
  std::optional<DirectedSizes> sizes = geometric_sizes(rule_, jet);
  if (!sizes) return {};
  sizes->h1 = clamped(sizes->h1);
  sizes->h2 = std::min(clamped(sizes->h2), parameters_.anisotropy_max * sizes->h1);
  return sizes;
}

// ---- inside faces ----

SurfaceJet SizeRules::surface_jet(int face, unsigned want, const Vec2& uv) const {
  return surface_at(cad_, model_.faces[static_cast<std::size_t>(face)].ref, want, uv);
}

void SizeRules::metrics_on_surface(int face, std::span<const Vec2> uv, std::span<const SurfaceJet> jets,
                                   const std::function<double(Vec2)>& fallback, std::span<Metric2> metric) const {
  const bool geometric = uses_curvature(), physical = parameters_.physical != PhysicalSizes::ignored;
  std::vector<Prescription> told;
  if (asks_sources()) {
    std::vector<Vec3> xyz(uv.size(), Vec3::Zero());
    if (needs_positions())
      for (std::size_t i = 0; i < uv.size(); ++i) xyz[i] = jets[i].s;
    told = told_on_surface(face, uv, xyz);
  }
  const std::size_t sources = told.size() / std::max<std::size_t>(uv.size(), 1);
  const bool by_boundary = parameters_.physical == PhysicalSizes::asked || asks_curves_only();
  const auto answers_at = [&](std::size_t i) {
    Answers answers;
    if (!physical) return answers;
    answers = answers_on_surface(face, uv[i], std::span(told).subspan(sources * i, sources));
    if (answers.empty()) {
      const double usual = by_boundary ? fallback(uv[i]) : parameters_.hphydef;
      answers.push_back(Prescription::of_size(usual));
    }
    return answers;
  };
  std::vector<std::size_t> sound, degenerate;
  std::vector<double> smallest(uv.size(), infinity);
  for (std::size_t i = 0; i < uv.size(); ++i) {
    const auto frame = TangentFrame::of(jets[i].su, jets[i].sv);
    std::optional<DirectedSizes> sizes;
    if (frame && geometric) sizes = directed_sizes(face, uv[i], jets[i]);
    if (!frame || (geometric && !sizes)) {
      degenerate.push_back(i);
      continue;
    }
    if (sizes) {
      smallest[i] = sizes->h1;
      sound.push_back(i);
    }
    const Answers answers = answers_at(i);
    Metric2 m;
    if (answers.empty()) {
      m = in_plane(*sizes, *frame);
    } else {
      m = physical_in_plane(answers, *frame);
      if (sizes) m = combine(m, in_plane(*sizes, *frame), parameters_.metric_combination);
    }
    metric[i] = frame->induced(m);
  }
  for (const std::size_t i : degenerate) {
    const auto k = nearest_of(sound, uv, uv[i]);
    const double otherwise = geometric ? parameters_.hgeomax : infinity;
    metric[i] = degenerate_metric(answers_at(i), jets[i], k ? smallest[*k] : otherwise);
  }
}

// ---- along curves ----

namespace {

Vec3 any_across(const Vec3& along) {
  const Vec3 axis = std::abs(along.x()) < 0.6 * norm(along) ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  return cross(along, axis);
}

}  // namespace

/// At a pole, the place a little way towards the curve's middle.
SizeRules::CurvePlace SizeRules::place_on(const CurveUse& use, double t) {
  const bool wire = model_.faces[static_cast<std::size_t>(use.face)].is_wire();
  const int ref = model_.faces[static_cast<std::size_t>(use.face)].ref;
  const unsigned wants = want_first | surface_wants();
  CurvePlace place;
  for (const double at : {t, towards_middle(use, t)}) {
    const CurveJet plane = cad_.curve(ref, use.curve + 1, want_position | want_first, at);
    place.uv = plane.c;
    place.jet = surface_at(cad_, ref, wants, plane.c);
    const Vec3 along = plane.ct.x() * place.jet.su + plane.ct.y() * place.jet.sv;
    const double speed = norm(along);
    if (!(speed > 0)) continue;
    // A wire has no surface: any plane that holds its tangent does.
    const auto frame = wire ? TangentFrame::of(along, any_across(along)) : TangentFrame::of(place.jet.su, place.jet.sv);
    if (!frame) continue;
    if (uses_curvature() && !wire) {
      const auto sizes = directed_sizes(use.face, place.uv, place.jet);
      if (!sizes) continue;
      place.geometric = in_plane(*sizes, *frame);
    }
    place.direction = {dot(along, frame->e1) / speed, dot(along, frame->e2) / speed};
    place.frame = frame;
    return place;
  }
  return place;
}

/// `given`: what holds here whatever curves and surfaces say; `silent`: the size when nobody answers.
SizeRules::AlongCurve SizeRules::along_curve(int curve, std::span<const double> t, const Answers* given,
                                             double silent) {
  const Curve& c = topology_.curves[static_cast<std::size_t>(curve)];
  const bool physical = parameters_.physical != PhysicalSizes::ignored;
  AlongCurve result;
  Answers of_curve;
  if (given != nullptr) {
    of_curve = *given;
  } else if (physical) {
    of_curve = answers_on_curve(curve, t);
  }
  result.by_curve = !of_curve.empty();
  std::vector<double> answered, combined;  // along the tangent, by use that answers
  double bound = infinity;                 // of the geometry
  std::vector<CurvePlace> silent_places;
  for (std::size_t u = 0; u < c.uses.size(); ++u) {
    CurvePlace place = place_on(c.uses[u], t[u]);
    if (!place.frame) continue;
    if (place.geometric) bound = std::min(bound, size_along(*place.geometric, place.direction));
    const Answers own =
        result.by_curve || !physical ? of_curve : answers_on_surface(c.uses[u].face, place.uv, place.jet.s);
    if (own.empty()) {
      silent_places.push_back(place);
      continue;
    }
    Metric2 m = physical_in_plane(own, *place.frame);
    answered.push_back(size_along(m, place.direction));
    if (place.geometric) m = combine(m, *place.geometric, parameters_.metric_combination);
    combined.push_back(size_along(m, place.direction));
  }
  result.answered = !answered.empty();
  if (result.answered) {
    result.physical = mean_size(parameters_.mean, answered);
    result.h = std::min(bound, mean_size(parameters_.mean, combined));
  } else {
    result.physical = physical ? silent : infinity;
    result.h = std::min(result.physical, bound);
    for (const CurvePlace& place : silent_places) {
      if (!physical || !place.geometric) continue;
      const Metric2 m = combine(isotropic(silent), *place.geometric, parameters_.metric_combination);
      result.h = std::min(result.h, size_along(m, place.direction));
    }
  }
  if (uses_curvature()) {
    std::optional<SurfaceJet> jet;
    result.h = std::min(result.h, clamped_geometric(radius_of_curve(curve, t, jet)));
  }
  return result;
}

CurveSizes SizeRules::metric_sizes_on_curve(int curve, std::span<const double> t, double r) {
  double silent = infinity;
  if (parameters_.physical == PhysicalSizes::uniform) silent = clamped_physical(parameters_.hphydef);
  if (parameters_.physical == PhysicalSizes::asked) silent = interpolated_on_curve(curve, r);
  const AlongCurve along = along_curve(curve, t, nullptr, silent);
  return {.answered = along.answered || parameters_.physical != PhysicalSizes::asked,
          .physical = along.physical,
          .h = along.h};
}

// ---- at points ----

/// The smallest size that the point's own metric has along a curve that ends here; else the mean of what the curves, or
/// else the surfaces beside them, say along these curves.
double SizeRules::metric_physical_at_point(int point) {
  const double usual = clamped_physical(parameters_.hphydef);
  const Answers own = answers_at_point(point);
  double smallest = infinity;
  std::vector<double> by_curves, by_surfaces;
  for (const CurveEnd& end : ends_at(point)) {
    const AlongCurve along = along_curve(end.curve, end.t, own.empty() ? nullptr : &own, usual);
    if (!along.answered) continue;
    smallest = std::min(smallest, along.physical);
    (along.by_curve ? by_curves : by_surfaces).push_back(along.physical);
  }
  if (!own.empty() && std::isfinite(smallest)) return smallest;
  if (const auto mean = mean_of(by_curves)) return *mean;
  return mean_of(by_surfaces).value_or(usual);
}

double SizeRules::metric_size_at_point(int point) {
  Answers given;
  double h = infinity;
  if (parameters_.physical != PhysicalSizes::ignored) {
    h = physical_at_point(point);
    given = answers_at_point(point);
    if (given.empty()) given.push_back(Prescription::of_size(h));
  }
  if (!uses_curvature()) return h;
  for (const CurveEnd& end : ends_at(point)) h = std::min(h, along_curve(end.curve, end.t, &given, infinity).h);
  return std::min(h, parameters_.hgeomax);
}

}  // namespace carreau
