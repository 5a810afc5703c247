// SPDX-License-Identifier: BSD-3-Clause
#include "size/size_rules.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "size/thresholds.h"
#include "support/format.h"
#include "support/rounding_of.h"
#include "support/shares.h"

namespace carreau {
namespace {

constexpr unsigned both_derivatives = want_first | want_second;
using namespace thresholds::size;

void check_bounds(const char* name, double least, double most) {
  if (least > 0 && least <= most && std::isfinite(most)) return;
  throw InvalidArgument(std::string(name) + "min and " + name + "max must be positive and ascending; they are " +
                        format_number(least) + " and " + format_number(most));
}

/// A size that the host gave (RT-0232 sec. 3.1.3 a): any number can be clamped, NaN and infinity cannot be meant.
std::optional<double> checked_size(std::optional<double> answer, const char* routine, const Where& where) {
  if (answer && !std::isfinite(*answer)) {
    throw CallbackError(where, std::string(routine) + " returned the size " + format_number(*answer) +
                                   ", which is not a finite number");
  }
  return answer;
}

std::optional<double> checked_radius(std::optional<double> answer, const char* routine, const Where& where) {
  if (!answer) return {};
  if (std::isnan(*answer)) throw CallbackError(where, std::string(routine) + " returned a radius that is not a number");
  return std::abs(*answer);  // some hosts encode the side in the sign
}

}  // namespace

// Edges keep the angle, triangles the distance.
GeometricLimits geometric_limits(const SizeParameters& size) noexcept {
  GeometricLimits limits;
  if (size.geometric == GeometricSizes::ignored) return limits;
  const GeometricCriterion rule = size.geo_rule;
  const bool by_radius = rule == GeometricCriterion::radii && !size.geo_anisotropic;  // the angle's equation
  if (rule == GeometricCriterion::angle || rule == GeometricCriterion::both || by_radius)
    limits.edge_angle_deg = size.enlargement * size.angle_mesh;
  if (size.guarantee_triangles) limits.triangle_angle_deg = limits.edge_angle_deg;
  if (rule == GeometricCriterion::chord || rule == GeometricCriterion::both) limits.deviation = size.enlargement * size.enlargement * size.eps_chord;
  limits.shortest_divided = std::numbers::sqrt2 * size.hgeomin;  // a half of it is as far from unit length
  return limits;
}

SizeParameters enlarged(SizeParameters size, double factor) noexcept {
  for (double* h : {&size.hphydef, &size.hphymin, &size.hphymax, &size.hgeomin, &size.hgeomax, &size.enlargement})
    *h *= factor;
  return size;
}

GeometricRule geometric_rule(const SizeParameters& p) noexcept {
  GeometricRule rule{
      .criterion = p.geo_rule, .anisotropic = p.geo_anisotropic, .angle_deg = p.angle_mesh, .eps0 = p.eps_chord};
  if (p.geo_guarantee) {
    rule.angle_factor = p.guarantee_triangles ? triangle_angle_factor : guaranteed_angle_factor;
    rule.chord_factor = guaranteed_chord_factor;
  }
  rule.angle_factor *= p.enlargement, rule.chord_factor *= p.enlargement;
  return rule;
}

namespace {

void check_geometric(const SizeParameters& p) {
  check_bounds("hgeo", p.hgeomin, p.hgeomax);
  if (!(p.angle_mesh > 0 && p.angle_mesh <= 90)) {
    throw InvalidArgument("angle_mesh must lie between 0 and 90 degrees; it is " + format_number(p.angle_mesh));
  }
  const bool chord = p.geo_rule == GeometricCriterion::chord || p.geo_rule == GeometricCriterion::both;
  if (chord && !(p.eps_chord > 0 && std::isfinite(p.eps_chord))) {
    throw InvalidArgument("geo_rule '" + std::string(p.geo_rule == GeometricCriterion::both ? "both" : "chord") +
                          "' needs a positive eps_chord; it is " + format_number(p.eps_chord));
  }
  if (!(p.anisotropy_max >= 1)) {
    throw InvalidArgument("anisotropy_max must be at least 1; it is " + format_number(p.anisotropy_max));
  }
}

}  // namespace

double mean_size(SizeMean kind, std::span<const double> values) {
  if (values.empty()) throw InvalidArgument("a mean requires at least one size");
  const double smallest = *std::min_element(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double sum = 0;
  switch (kind) {
    case SizeMean::minimum:
      return smallest;
    case SizeMean::geometric:  // exp of the mean logarithm: the product of many sizes would underflow
      for (const double h : values) sum += std::log(h / smallest);
      return smallest * std::exp(sum / n);
    default:
      for (const double h : values) sum += h;
      return sum / n;
  }
}

SizeRules::SizeRules(const Model& model, const Topology& topology, Cad& cad, const SizeParameters& parameters)
    : model_(model),
      topology_(topology),
      cad_(cad),
      parameters_(parameters),
      rule_(geometric_rule(parameters)),
      physical_at_point_(topology.points.size()),
      size_at_point_(topology.points.size()) {
  if (parameters.physical == PhysicalSizes::ignored && parameters.geometric == GeometricSizes::ignored) {
    throw InvalidArgument("hphy_flag and hgeo_flag are both 0: no sizes are prescribed");
  }
  if (parameters.physical != PhysicalSizes::ignored) {
    check_bounds("hphy", parameters.hphymin, parameters.hphymax);
    if (!std::isfinite(parameters.hphydef)) {
      throw InvalidArgument("hphydef must be a finite number; it is " + format_number(parameters.hphydef));
    }
  }
  if (parameters.geometric != GeometricSizes::ignored) check_geometric(parameters);
  if (parameters.geometric == GeometricSizes::ignored &&
      (parameters.geo_anisotropic || parameters.geo_rule != GeometricCriterion::angle)) {
    throw InvalidArgument(
        "hgeo_flag is 0, so that geometric sizes are ignored, but geo_metric or geo_rule requires them: set hgeo_flag "
        "to 1");
  }
}

unsigned SizeRules::surface_wants() const noexcept {
  unsigned wants = parameters_.geometric == GeometricSizes::curvature ? both_derivatives : 0;
  if (!uses_metrics()) return wants;
  wants |= want_first;
  if (uses_curvature()) wants |= want_second;  // if the host does not give its radius
  if (needs_positions()) wants |= want_position;
  return wants;
}

std::optional<double> SizeRules::constant() const noexcept {
  if (parameters_.physical != PhysicalSizes::uniform || parameters_.geometric != GeometricSizes::ignored ||
      uses_metrics())
    return {};
  return clamped_physical(parameters_.hphydef);
}

double SizeRules::clamped_physical(double h) const noexcept {
  return std::clamp(h, parameters_.hphymin, parameters_.hphymax);
}

double SizeRules::clamped_geometric(double radius) const noexcept {
  return std::clamp(geometric_size(rule_, radius), parameters_.hgeomin, parameters_.hgeomax);
}

Where SizeRules::where_of(const CurveUse& use, double t) const {
  const Face& face = model_.faces[static_cast<std::size_t>(use.face)];
  return {.face = face.ref,
          .curve_index = use.curve + 1,
          .curve = face.curves[static_cast<std::size_t>(use.curve)].ref,
          .t = t};
}

/// The parameter beside a curve's end that represents the surface when the end is a pole.
double SizeRules::towards_middle(const CurveUse& use, double t) const {
  const Interval i = cad_.curve_interval(model_.faces[static_cast<std::size_t>(use.face)].ref, use.curve + 1);
  return t + shares::negligible * (i.a + (i.b - i.a) / 2 - t);
}

/// The point of a batch with a value that is nearest to p, which takes the value; the first of equally near ones.
std::optional<std::size_t> SizeRules::nearest_of(std::span<const std::size_t> sound, std::span<const Vec2> uv,
                                                 const Vec2& p) {
  std::optional<std::size_t> found;
  double nearest = infinity;
  for (const std::size_t k : sound) {
    const double distance = norm(uv[k] - p);
    if (distance < nearest) nearest = distance, found = k;
  }
  return found;
}

// ---- physical sizes (RT-0232 sec. 3.1.3 a) ----

std::optional<double> SizeRules::ask_surface(int face, const Vec2& uv) const {
  const int ref = model_.faces[static_cast<std::size_t>(face)].ref;
  const auto answer = checked_size(cad_.surface_size(ref, uv), "cad_hphys", Where{.face = ref, .uv = uv});
  if (!answer) return {};
  return clamped_physical(parameters_.enlargement * *answer);
}

/// As the host has it; to be clamped.
std::optional<double> SizeRules::ask_point(int point) const {
  const int ref = topology_.points[static_cast<std::size_t>(point)].ref;
  std::optional<double> answer = checked_size(cad_.point_size(ref), "cad_hphyp", Where{.point = ref});
  if (answer) *answer *= parameters_.enlargement;
  return answer;
}

/// The uses of a curve are evaluated in their order, the first being the one that defines it; the first answer counts.
std::optional<double> SizeRules::ask_curve(int curve, std::span<const double> t) const {
  const auto& uses = topology_.curves[static_cast<std::size_t>(curve)].uses;
  for (std::size_t u = 0; u < uses.size(); ++u) {
    const Where where = where_of(uses[u], t[u]);
    const auto answer = checked_size(cad_.curve_size(where.face, where.curve_index, t[u]), "cad_hphyc", where);
    if (answer) return clamped_physical(parameters_.enlargement * *answer);
  }
  return {};
}

std::optional<double> SizeRules::mean_of(const std::vector<double>& answers) const {
  if (answers.empty()) return {};
  return mean_size(parameters_.mean, answers);
}

std::vector<SizeRules::CurveEnd> SizeRules::ends_at(int point) const {
  std::vector<CurveEnd> ends;
  for (const int c : topology_.points[static_cast<std::size_t>(point)].curves) {
    const Curve& curve = topology_.curves[static_cast<std::size_t>(c)];
    for (const bool first : {true, false}) {
      if ((first ? curve.end1 : curve.end2) != point) continue;
      CurveEnd end{c, {}};
      for (const CurveUse& use : curve.uses) {
        const Interval i = cad_.curve_interval(model_.faces[static_cast<std::size_t>(use.face)].ref, use.curve + 1);
        end.t.push_back(first != use.reversed ? i.a : i.b);
      }
      ends.push_back(std::move(end));
    }
  }
  return ends;
}

/// Corners of parameter domains at which the curves end, each once: a face that holds the point at both sides of a
/// seam has two.
std::vector<SizeRules::Corner> SizeRules::corners_of(const std::vector<CurveEnd>& ends) const {
  std::vector<Corner> all;
  for (const CurveEnd& end : ends) {
    const auto& uses = topology_.curves[static_cast<std::size_t>(end.curve)].uses;
    for (std::size_t u = 0; u < uses.size(); ++u) {
      const int face = model_.faces[static_cast<std::size_t>(uses[u].face)].ref;
      all.push_back({uses[u].face, cad_.curve(face, uses[u].curve + 1, want_position, end.t[u]).c});
    }
  }
  std::vector<Corner> corners;
  for (const Corner& corner : all) {
    // The farthest that two corners of this face are apart, or for a single corner its distance from the origin.
    double scale = 0;
    for (const Corner& other : all) {
      if (other.face == corner.face) scale = std::max({scale, norm(other.uv - corner.uv), norm(corner.uv)});
    }
    const bool known = std::any_of(corners.begin(), corners.end(), [&](const Corner& other) {
      return other.face == corner.face && norm(other.uv - corner.uv) <= rounding_of::sizes * scale;
    });
    if (!known) corners.push_back(corner);
  }
  return corners;
}

double SizeRules::interpolated_on_curve(int curve, double r) {
  const Curve& c = topology_.curves[static_cast<std::size_t>(curve)];
  return interpolate_size(law(), physical_at_point(c.end1), physical_at_point(c.end2), r);
}

// ---- geometric sizes (RT-0232 sec. 3.1.3 b) ----

std::optional<double> SizeRules::host_radius_of_surface(int face, const Vec2& uv) const {
  if (parameters_.geometric != GeometricSizes::radii) return {};
  const int ref = model_.faces[static_cast<std::size_t>(face)].ref;
  return checked_radius(cad_.surface_radius(ref, uv), "cad_rads", Where{.face = ref, .uv = uv});
}

std::optional<double> SizeRules::host_radius_of_curve(int curve, std::span<const double> t) const {
  if (parameters_.geometric != GeometricSizes::radii) return {};
  const auto& uses = topology_.curves[static_cast<std::size_t>(curve)].uses;
  for (std::size_t u = 0; u < uses.size(); ++u) {
    const Where where = where_of(uses[u], t[u]);
    const auto radius = checked_radius(cad_.curve_radius(where.face, where.curve_index, t[u]), "cad_radc", where);
    if (radius) return radius;
  }
  return {};
}

/// `jet` with both derivatives when known, else nullptr. If a host that was to give radii does not answer, the
/// curvature is computed.
std::optional<double> SizeRules::radius_in_face(int face, const Vec2& uv, const SurfaceJet* jet) const {
  if (const auto radius = host_radius_of_surface(face, uv)) return radius;
  if (jet != nullptr) return smallest_radius(*jet);
  return smallest_radius(surface_at(cad_, model_.faces[static_cast<std::size_t>(face)].ref, both_derivatives, uv));
}

/// Radius of the surface beside a curve; at a pole, the radius at a point a little way towards the curve's middle.
/// `jet` is the surface's at t when known, else nullptr.
std::optional<double> SizeRules::radius_beside(const CurveUse& use, double t, const SurfaceJet* jet) const {
  if (model_.faces[static_cast<std::size_t>(use.face)].is_wire()) return {};  // there is no surface
  const int ref = model_.faces[static_cast<std::size_t>(use.face)].ref;
  const auto uv_at = [&](double at) { return cad_.curve(ref, use.curve + 1, want_position, at).c; };
  if (const auto radius = radius_in_face(use.face, uv_at(t), jet)) return radius;
  return radius_in_face(use.face, uv_at(towards_middle(use, t)), nullptr);
}

/// `jet` becomes the jet of the first use, which defines the curve's shape, if it had to be evaluated.
double SizeRules::radius_of_curve(int curve, std::span<const double> t, std::optional<SurfaceJet>& jet) const {
  const Curve& c = topology_.curves[static_cast<std::size_t>(curve)];
  if (c.degenerate) return infinity;
  if (const auto radius = host_radius_of_curve(curve, t)) return *radius;
  const CurveUse& use = c.uses.front();
  const int ref = model_.faces[static_cast<std::size_t>(use.face)].ref;
  const CurveJet plane = cad_.curve(ref, use.curve + 1, want_position | both_derivatives, t.front());
  jet = surface_at(cad_, ref, both_derivatives, plane.c);
  return carreau::curve_radius(*jet, plane);
}

SurfaceJet SizeRules::surface_jet(int face, unsigned want, const Vec2& uv) const {
  return surface_at(cad_, model_.faces[static_cast<std::size_t>(face)].ref, want, uv);
}

// ---- properties of the sources ----

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

/// The answer at the point; else the mean of the curves that end here, a closed curve counting once; else the mean of
/// the corners of surfaces.
double SizeRules::mean_of_answers_around(int point) {
  if (parameters_.physical == PhysicalSizes::asked) {
    if (const auto answer = ask_point(point)) return clamped_physical(*answer);
    const std::vector<CurveEnd> ends = ends_at(point);
    std::vector<double> answers;
    int answered = -1;
    for (const SizeRules::CurveEnd& end : ends) {
      if (end.curve == answered) continue;
      if (const auto answer = ask_curve(end.curve, end.t)) {
        answers.push_back(*answer);
        answered = end.curve;
      }
    }
    if (answers.empty()) {
      for (const Corner& corner : corners_of(ends))
        if (const auto answer = ask_surface(corner.face, corner.uv)) answers.push_back(*answer);
    }
    if (const auto mean = mean_of(answers)) return *mean;
  }
  return clamped_physical(parameters_.hphydef);
}

double SizeRules::physical_at_point(int point) {
  const auto joined = joined_points_.find(point);
  if (joined == joined_points_.end()) return alone_physical_at_point(point);
  double least = infinity;
  for (const int p : joined->second) least = std::min(least, alone_physical_at_point(p));
  return least;
}

double SizeRules::at_point(int point) {
  const auto joined = joined_points_.find(point);
  if (joined == joined_points_.end()) return alone_at_point(point);
  double least = infinity;
  for (const int p : joined->second) least = std::min(least, alone_at_point(p));
  return least;
}

void SizeRules::join(const std::vector<std::vector<int>>& points, const JoinedFaces* faces) {
  joined_points_.clear();
  for (const std::vector<int>& all : points)
    for (const int p : all) joined_points_[p] = all;
  joined_faces_ = faces;
}

}  // namespace carreau
