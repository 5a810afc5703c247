// SPDX-License-Identifier: BSD-3-Clause
// Sizes at places from the answers of hosts and sources and from the geometry. Each function handles both
// representations: a size is a double, or a Metric2 of the tangent plane if sizes differ by direction.
#include <algorithm>
#include <cmath>

#include "size/answers.h"
#include "size/size_rules.h"

namespace carreau {
namespace {

/// One size in all directions.
template <typename Size>
constexpr Size of_size(double h) noexcept {
  if constexpr (has_directions<Size>)
    return {1 / (h * h), 0, 1 / (h * h)};
  else
    return h;
}

/// Size along a unit vector of the tangent plane.
double along(double h, const Vec2& /*direction*/) noexcept { return h; }
double along(Metric2 m, const Vec2& direction) noexcept { return 1 / length(m, direction); }

double combine(double prescribed, double bound, MetricCombination /*how*/) noexcept {
  return std::min(prescribed, bound);
}

/// In an orthonormal basis of the tangent plane.
Metric2 in_plane(const DirectedSizes& sizes, const TangentFrame& frame) noexcept {
  const auto term = [&](Vec3 w, double h) {
    const Vec2 d{dot(w, frame.e1) / h, dot(w, frame.e2) / h};
    return Metric2{d.x() * d.x(), d.x() * d.y(), d.y() * d.y()};
  };
  return sizes.h1 == sizes.h2 ? of_size<Metric2>(sizes.h1) : term(sizes.w1, sizes.h1) + term(sizes.w2, sizes.h2);
}

Vec3 any_across(const Vec3& along) {
  const Vec3 axis = std::abs(along.x()) < 0.6 * norm(along) ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  return cross(along, axis);
}

/// A place in a face or on a curve.
template <typename Size>
struct Place {
  bool regular = false;  ///< the size can be computed here
  std::optional<Size> geometric;
  double smallest = infinity;  ///< over the directions of `geometric`
  // If sizes differ by direction:
  std::optional<TangentFrame> frame;
  Vec2 direction{0, 0};  ///< of the curve, in the frame
  Vec2 uv{0, 0};         ///< of a place on a curve
  Vec3 xyz{0, 0, 0};     ///< the same
};

struct AlongCurve {
  bool by_curve = false;  ///< the curve or its end has answered, else the surfaces beside it
  bool answered = false;
  double physical = 0, h = infinity;
};

}  // namespace

/// Computes sizes of faces, curves and points by size rules.
template <typename Size>
class SizesAtPlaces {
 public:
  explicit SizesAtPlaces(const SizeRules& rules) : rules_(rules) {}

  // ---- answers ----

  /// Asks all sources at points of a face; the answers of one point follow each other.
  [[nodiscard]] std::vector<Prescription> told_on_surface(int face, std::span<const Vec2> uv,
                                                       std::span<const SurfaceJet> jets) const {
    if (!rules_.asks_sources()) return {};
    std::vector<Vec3> xyz(uv.size(), Vec3::Zero());
    if (rules_.needs_positions())
      for (std::size_t i = 0; i < uv.size(); ++i) xyz[i] = jets[i].s;
    const std::size_t count = rules_.parameters_.sources.size();
    std::vector<Prescription> told(count * uv.size()), of_source(uv.size());
    for (std::size_t s = 0; s < count; ++s) {
      rules_.parameters_.sources[s]->on_surface_points(rules_.model_.faces[static_cast<std::size_t>(face)].ref, uv, xyz, of_source);
      for (std::size_t i = 0; i < uv.size(); ++i) told[count * i + s] = of_source[i];
    }
    return told;
  }

  /// `told`: answers of the sources at this point.
  [[nodiscard]] Answers<Size> answers_on_surface(int face, const Vec2& uv,
                                                         std::span<const Prescription> told) const {
    Answers<Size> answers;
    if constexpr (has_directions<Size>)
      for (std::size_t s = 0; s < told.size(); ++s) {
        const int ref = rules_.model_.faces[static_cast<std::size_t>(face)].ref;
        check(told[s], *rules_.parameters_.sources[s], {.face = ref, .uv = uv});
        if (told[s].kind != Prescription::Kind::none) answers.add(enlarged(told[s], rules_.parameters_.enlargement));
      }
    if (rules_.parameters_.physical == PhysicalSizes::asked)
      if (const auto size = rules_.ask_surface(face, uv)) answers.add_size(*size);
    return answers;
  }

  /// Asks each source on the uses of the curve until one answers. Metrics of parameter planes are carried into space.
  [[nodiscard]] Answers<Size> answers_on_curve(int curve, std::span<const double> t) const {
    Answers<Size> answers;
    if constexpr (has_directions<Size>)
      if (rules_.asks_sources()) {
        const auto& uses = rules_.topology_.curves[static_cast<std::size_t>(curve)].uses;
        for (PrescriptionSource* source : rules_.parameters_.sources) {
          for (std::size_t u = 0; u < uses.size(); ++u) {
            const Where where = rules_.where_of(uses[u], t[u]);
            const Vec2 uv = rules_.cad_.curve(where.face, where.curve_index, want_position, t[u]).c;
            const SurfaceJet jet = surface_at(rules_.cad_, where.face, want_position | want_first, uv);
            const int ic =
                host_rank(rules_.model_.faces[static_cast<std::size_t>(uses[u].face)], static_cast<std::size_t>(uses[u].curve));
            Prescription p = source->on_curve(where.face, ic, t[u], uv, jet.s);
            check(p, *source, where);
            if (p.kind == Prescription::Kind::none) continue;
            if (p.kind == Prescription::Kind::parameter) {
              const auto frame = TangentFrame::of(jet.su, jet.sv);
              if (!frame) continue;
              const Metric2 tangent = frame->of_parameters(p.parameter);
              p = Prescription::of_space(frame->in_space(tangent, eigen(tangent).minor));
            }
            answers.add(enlarged(p, rules_.parameters_.enlargement));
            break;
          }
        }
      }
    if (rules_.parameters_.physical == PhysicalSizes::asked)
      if (const auto size = rules_.ask_curve(curve, t)) answers.add_size(*size);
    return answers;
  }

  /// The surface beside a curve.
  [[nodiscard]] Answers<Size> answers_beside(const CurveUse& use, double t, const Place<Size>& place) const {
    if constexpr (has_directions<Size>) {
      SurfaceJet jet;
      jet.s = place.xyz;
      return answers_on_surface(use.face, place.uv, told_on_surface(use.face, {&place.uv, 1}, {&jet, 1}));
    } else {
      if (rules_.parameters_.physical != PhysicalSizes::asked) return {};
      const int ref = rules_.model_.faces[static_cast<std::size_t>(use.face)].ref;
      return answers_on_surface(use.face, rules_.cad_.curve(ref, use.curve + 1, want_position, t).c, {});
    }
  }

  [[nodiscard]] Answers<Metric2> answers_at_point(int point) const {
    Answers<Metric2> answers;
    const auto& p = rules_.topology_.points[static_cast<std::size_t>(point)];
    const Where where{.point = p.ref};
    if (rules_.asks_sources()) {
      for (PrescriptionSource* source : rules_.parameters_.sources) {
        const Prescription answer = source->at_point(p.ref, p.position);
        check(answer, *source, where);
        const bool usable =
            answer.kind == Prescription::Kind::size || answer.kind == Prescription::Kind::space;  // no plane here
        if (usable) answers.add(enlarged(answer, rules_.parameters_.enlargement));
      }
    }
    if (rules_.parameters_.physical == PhysicalSizes::asked)
      if (const auto size = rules_.ask_point(point)) answers.add_size(*size);
    return answers;
  }

  // ---- sizes of one place ----

  [[nodiscard]] Metric2 clamped_in_plane(Metric2 tangent) const noexcept {
    return clamp_eigenvalues(tangent, 1 / (rules_.parameters_.hphymax * rules_.parameters_.hphymax),
                             1 / (rules_.parameters_.hphymin * rules_.parameters_.hphymin));
  }

  /// `answers` not empty.
  [[nodiscard]] Size physical_size(const Answers<Size>& answers, const Place<Size>& place) const {
    if constexpr (has_directions<Size>) {
      std::optional<Metric2> all;
      for (const Prescription& p : answers.all) {
        Metric2 m;
        switch (p.kind) {
          case Prescription::Kind::space:
            m = clamped_in_plane(place.frame->restricted(p.space));
            break;
          case Prescription::Kind::parameter:
            m = clamped_in_plane(place.frame->of_parameters(p.parameter));
            break;
          default:
            m = of_size<Metric2>(rules_.clamped_physical(p.size));
        }
        all = all ? intersection(*all, m) : m;
      }
      return *all;
    } else {
      return rules_.clamped_physical(*answers.size);
    }
  }

  /// Without a tangent plane: the metric of space, with an isotropic geometric size, induces a metric. A metric of the
  /// parameter plane is added; the sum is no larger in any direction than the intersection.
  [[nodiscard]] Metric2 degenerate_metric(const Answers<Metric2>& answers, const SurfaceJet& jet, double geometric) const {
    std::optional<Metric3> space;
    Metric2 added{0, 0, 0};
    const auto intersect = [&](const Metric3& m) { space = space ? intersection(*space, m) : m; };
    for (const Prescription& p : answers.all) {
      if (p.kind == Prescription::Kind::space) {
        intersect(clamp_eigenvalues(p.space, 1 / (rules_.parameters_.hphymax * rules_.parameters_.hphymax),
                                    1 / (rules_.parameters_.hphymin * rules_.parameters_.hphymin)));
      } else if (p.kind == Prescription::Kind::parameter) {
        added = added + p.parameter;
      } else {
        intersect(isotropic_metric3(rules_.clamped_physical(p.size)));
      }
    }
    if (std::isfinite(geometric)) {
      const Metric3 bound = isotropic_metric3(geometric);
      space = space ? carreau::combine(*space, bound, rules_.parameters_.metric_combination) : bound;
    }
    return space ? added + induced_metric(jet.su, jet.sv, *space) : added;
  }

  /// Returns clamped sizes, or nothing if the parametrisation is degenerate.
  [[nodiscard]] std::optional<DirectedSizes> directed_sizes(int face, const Vec2& uv, const SurfaceJet& jet) const {
    const auto clamped = [&](double h) { return std::clamp(h, rules_.parameters_.hgeomin, rules_.parameters_.hgeomax); };
    if (const auto radius = rules_.host_radius_of_surface(face, uv)) {
      const double h = rules_.clamped_geometric(*radius);
      return DirectedSizes{h, h, {}, {}};
    }
    std::optional<DirectedSizes> sizes = geometric_sizes(rules_.rule_, jet);
    if (!sizes) return {};
    sizes->h1 = clamped(sizes->h1);
    sizes->h2 = std::min(clamped(sizes->h2), rules_.parameters_.anisotropy_max * sizes->h1);
    return sizes;
  }

  /// `jet`: null if the rules need no derivatives.
  [[nodiscard]] Place<Size> place_in_face(int face, const Vec2& uv, const SurfaceJet* jet) const {
    Place<Size> place;
    if constexpr (has_directions<Size>) {
      place.frame = TangentFrame::of(jet->su, jet->sv);
      if (!place.frame) return place;
      if (rules_.uses_curvature()) {
        const auto sizes = directed_sizes(face, uv, *jet);
        if (!sizes) return place;
        place.geometric = in_plane(*sizes, *place.frame);
        place.smallest = sizes->h1;
      }
    } else if (rules_.uses_curvature()) {
      const auto radius = rules_.radius_in_face(face, uv, jet);
      if (!radius) return place;
      place.geometric = place.smallest = rules_.clamped_geometric(*radius);
    }
    place.regular = true;
    return place;
  }

  /// At a pole, the place a little way towards the middle of the curve. `jet`: both derivatives at t, null if unknown.
  [[nodiscard]] Place<Size> place_on_curve(const CurveUse& use, double t, const SurfaceJet* jet) const {
    Place<Size> place;
    if constexpr (!has_directions<Size>) {
      place.regular = true;
      if (!rules_.uses_curvature()) return place;
      if (const auto radius = rules_.radius_beside(use, t, jet)) place.geometric = rules_.clamped_geometric(*radius);
      return place;
    } else {
      const bool wire = rules_.model_.faces[static_cast<std::size_t>(use.face)].is_wire();
      const int ref = rules_.model_.faces[static_cast<std::size_t>(use.face)].ref;
      const unsigned wants = want_first | rules_.surface_wants();
      for (const double at : {t, rules_.towards_middle(use, t)}) {
        const CurveJet plane = rules_.cad_.curve(ref, use.curve + 1, want_position | want_first, at);
        const SurfaceJet here = surface_at(rules_.cad_, ref, wants, plane.c);
        place.uv = plane.c, place.xyz = here.s;
        const Vec3 along = plane.ct.x() * here.su + plane.ct.y() * here.sv;
        const double speed = norm(along);
        if (!(speed > 0)) continue;
        // A wire has no surface: any plane that holds its tangent does.
        const auto frame = wire ? TangentFrame::of(along, any_across(along)) : TangentFrame::of(here.su, here.sv);
        if (!frame) continue;
        if (rules_.uses_curvature() && !wire) {
          const auto sizes = directed_sizes(use.face, place.uv, here);
          if (!sizes) continue;
          place.geometric = in_plane(*sizes, *frame);
        }
        place.direction = {dot(along, frame->e1) / speed, dot(along, frame->e2) / speed};
        place.frame = frame;
        place.regular = true;
        return place;
      }
      return place;
    }
  }

  // ---- inside faces ----

  /// Calls regular(i, place, size) for places with a size, then degenerate(i, answers, geometric) for the others with the
  /// geometric size of the nearest regular place.
  template <typename Regular, typename Degenerate>
  void sizes_on_surface(int face, std::span<const Vec2> uv, std::span<const SurfaceJet> jets,
                                   const std::function<double(Vec2)>& fallback, const Regular& regular,
                                   const Degenerate& degenerate) const {
    const bool physical = rules_.parameters_.physical != PhysicalSizes::ignored;
    const bool by_boundary = rules_.parameters_.physical == PhysicalSizes::asked || rules_.asks_curves_only();
    const bool has_jets = has_directions<Size> || (rules_.surface_wants() & want_second) != 0;
    const std::vector<Prescription> told = told_on_surface(face, uv, jets);
    const std::size_t sources = told.size() / std::max<std::size_t>(uv.size(), 1);
    const auto answers_at = [&](std::size_t i) {
      Answers<Size> answers;
      if (!physical) return answers;
      answers = answers_on_surface(face, uv[i], std::span(told).subspan(sources * i, sources));
      if (answers.empty()) answers.add_size(by_boundary ? fallback(uv[i]) : rules_.parameters_.hphydef);
      return answers;
    };
    std::vector<std::size_t> with_geometry, without_size;
    std::vector<double> smallest(rules_.uses_curvature() ? uv.size() : 0, infinity);
    for (std::size_t i = 0; i < uv.size(); ++i) {
      const Place<Size> place = place_in_face(face, uv[i], has_jets ? &jets[i] : nullptr);
      if (!place.regular) {
        without_size.push_back(i);
        continue;
      }
      if (place.geometric) {
        smallest[i] = place.smallest;
        with_geometry.push_back(i);
      }
      const Answers<Size> answers = answers_at(i);
      if (answers.empty()) {
        regular(i, place, *place.geometric);
        continue;
      }
      Size size = physical_size(answers, place);
      if (place.geometric) size = combine(size, *place.geometric, rules_.parameters_.metric_combination);
      regular(i, place, size);
    }
    for (const std::size_t i : without_size) {
      const auto k = SizeRules::nearest_of(with_geometry, uv, uv[i]);
      const double otherwise = rules_.uses_curvature() ? rules_.parameters_.hgeomax : infinity;
      degenerate(i, answers_at(i), k ? smallest[*k] : otherwise);
    }
  }

  // ---- along curves ----

  /// `given`: the answers that hold here whatever curves and surfaces answer; silent(): the size without answers.
  template <typename Silent>
  [[nodiscard]] AlongCurve along_curve(int curve, std::span<const double> t, const Answers<Size>* given,
                                               const Silent& silent) const {
    const Curve& c = rules_.topology_.curves[static_cast<std::size_t>(curve)];
    const bool physical = rules_.parameters_.physical != PhysicalSizes::ignored;
    AlongCurve result;
    Answers<Size> of_curve;
    if (given != nullptr) {
      of_curve = *given;
    } else if (physical) {
      of_curve = answers_on_curve(curve, t);
    }
    result.by_curve = !of_curve.empty();
    double bound = infinity;         // of the geometry
    std::optional<SurfaceJet> jet;  // of the first use
    if (rules_.uses_curvature()) bound = rules_.clamped_geometric(rules_.radius_of_curve(curve, t, jet));
    std::vector<double> answered, combined;  // along the tangent, by use that answers
    std::vector<Place<Size>> silent_places;
    for (std::size_t u = 0; u < c.uses.size(); ++u) {
      const Place<Size> place = place_on_curve(c.uses[u], t[u], u == 0 && jet ? &*jet : nullptr);
      if (!place.regular) continue;
      if (place.geometric) bound = std::min(bound, along(*place.geometric, place.direction));
      const Answers<Size> own = result.by_curve || !physical ? of_curve : answers_beside(c.uses[u], t[u], place);
      if (own.empty()) {
        if (physical && place.geometric) silent_places.push_back(place);
        continue;
      }
      Size size = physical_size(own, place);
      answered.push_back(along(size, place.direction));
      // Sizes: the manual takes the mean first, then the smaller of the mean and the geometric size.
      if (has_directions<Size> && place.geometric)
        size = combine(size, *place.geometric, rules_.parameters_.metric_combination);
      combined.push_back(along(size, place.direction));
    }
    result.answered = !answered.empty();
    if (result.answered) {
      result.physical = mean_size(rules_.parameters_.mean, answered);
      result.h = std::min(bound, mean_size(rules_.parameters_.mean, combined));
      return result;
    }
    result.physical = physical ? silent() : infinity;
    result.h = std::min(result.physical, bound);
    for (const Place<Size>& place : silent_places) {
      const Size size = combine(of_size<Size>(result.physical), *place.geometric, rules_.parameters_.metric_combination);
      result.h = std::min(result.h, along(size, place.direction));
    }
    return result;
  }

  // ---- at points ----

  /// The smallest size of the metric at the point along the curves that end here; else the mean of the sizes along the
  /// curves, over the curves or over the surfaces beside them. A corner of a surface has no direction.
  [[nodiscard]] double physical_along_curves_at(int point) const {
    const double usual = rules_.clamped_physical(rules_.parameters_.hphydef);
    const Answers<Metric2> own = answers_at_point(point);
    double smallest = infinity;
    std::vector<double> by_curves, by_surfaces;
    for (const SizeRules::CurveEnd& end : rules_.ends_at(point)) {
      const AlongCurve along = along_curve(end.curve, end.t, own.empty() ? nullptr : &own, [&] { return usual; });
      if (!along.answered) continue;
      smallest = std::min(smallest, along.physical);
      (along.by_curve ? by_curves : by_surfaces).push_back(along.physical);
    }
    if (!own.empty() && std::isfinite(smallest)) return smallest;
    if (const auto mean = rules_.mean_of(by_curves)) return *mean;
    return rules_.mean_of(by_surfaces).value_or(usual);
  }

  [[nodiscard]] double size_at_point(int point, double physical) const {
    Answers<Size> given;
    double h = infinity;
    if (rules_.parameters_.physical != PhysicalSizes::ignored) {
      h = physical;
      if constexpr (has_directions<Size>) given = answers_at_point(point);
      if (given.empty()) given.add_size(h);
    }
    if (!rules_.uses_curvature()) return h;
    for (const SizeRules::CurveEnd& end : rules_.ends_at(point)) h = std::min(h, along_curve(end.curve, end.t, &given, [] { return infinity; }).h);
    return std::min(h, rules_.parameters_.hgeomax);
  }

 private:
  const SizeRules& rules_;
};

void SizeRules::on_surface(int face, std::span<const Vec2> uv, std::span<const SurfaceJet> jets,
                           const std::function<double(Vec2)>& fallback, std::span<double> h) const {
  alone_on_surface(face, uv, jets, fallback, h);
  if (joined_faces_ != nullptr) joined_faces_->lower(*this, face, uv, h);
}

void SizeRules::on_surface(int face, std::span<const Vec2> uv, std::span<const SurfaceJet> jets,
                           const std::function<double(Vec2)>& fallback, std::span<Metric2> metric) const {
  alone_on_surface(face, uv, jets, fallback, metric);
  if (joined_faces_ != nullptr) joined_faces_->intersect(*this, face, uv, metric);
}

void SizeRules::alone_on_surface(int face, std::span<const Vec2> uv, std::span<const SurfaceJet> jets,
                                 const std::function<double(Vec2)>& fallback, std::span<double> h) const {
  const SizesAtPlaces<double> sizes(*this);
  sizes.sizes_on_surface(
      face, uv, jets, fallback, [&](std::size_t i, const Place<double>&, double size) { h[i] = size; },
      [&](std::size_t i, const Answers<double>& answers, double geometric) {
        h[i] = answers.empty() ? geometric : std::min(sizes.physical_size(answers, {}), geometric);
      });
}

void SizeRules::alone_on_surface(int face, std::span<const Vec2> uv, std::span<const SurfaceJet> jets,
                                 const std::function<double(Vec2)>& fallback, std::span<Metric2> metric) const {
  if (!uses_metrics()) {
    std::vector<double> h(uv.size());
    alone_on_surface(face, uv, jets, fallback, h);
    for (std::size_t i = 0; i < uv.size(); ++i) metric[i] = induced_metric(jets[i].su, jets[i].sv, h[i]);
    return;
  }
  const SizesAtPlaces<Metric2> sizes(*this);
  sizes.sizes_on_surface(
      face, uv, jets, fallback,
      [&](std::size_t i, const Place<Metric2>& place, Metric2 m) { metric[i] = place.frame->induced(m); },
      [&](std::size_t i, const Answers<Metric2>& answers, double geometric) {
        metric[i] = sizes.degenerate_metric(answers, jets[i], geometric);
      });
}

CurveSizes SizeRules::ask_on_curve(int curve, std::span<const double> t, double r) {
  const bool asked = parameters_.physical == PhysicalSizes::asked;
  const auto silent = [&] { return asked ? interpolated_on_curve(curve, r) : clamped_physical(parameters_.hphydef); };
  const AlongCurve along = uses_metrics() ? SizesAtPlaces<Metric2>(*this).along_curve(curve, t, nullptr, silent)
                                          : SizesAtPlaces<double>(*this).along_curve(curve, t, nullptr, silent);
  return {.answered = along.answered || !asked, .physical = along.physical, .h = along.h};
}

double SizeRules::on_curve(int curve, std::span<const double> t, double r) { return ask_on_curve(curve, t, r).h; }

double SizeRules::alone_physical_at_point(int point) {
  if (parameters_.physical == PhysicalSizes::ignored) return infinity;
  auto& known = physical_at_point_[static_cast<std::size_t>(point)];
  if (!known)
    known = uses_metrics() ? SizesAtPlaces<Metric2>(*this).physical_along_curves_at(point) : mean_of_answers_around(point);
  return *known;
}

double SizeRules::alone_at_point(int point) {
  auto& known = size_at_point_[static_cast<std::size_t>(point)];
  const double physical = alone_physical_at_point(point);
  if (!known)
    known = uses_metrics() ? SizesAtPlaces<Metric2>(*this).size_at_point(point, physical)
                           : SizesAtPlaces<double>(*this).size_at_point(point, physical);
  return std::min(*known, physical);
}

}  // namespace carreau
