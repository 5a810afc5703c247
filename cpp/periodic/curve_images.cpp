// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/curve_images.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "model/traces.h"
#include "periodic/closest.h"
#include "periodic/thresholds.h"
#include "support/rounding_of.h"
#include "support/shares.h"

namespace carreau {

namespace {

using namespace thresholds::periodic;

// Not symmetric, so that a reversed curve differs.
constexpr std::array<double, 4> compared_at{0.17, 0.38, 0.56, 0.81};

bool fits(const CurveModel& model, const CurveShape& from, const CurveImage& image, const Isometry& map, double gap) {
  const double length = std::max(from.length, 0.);
  const auto target = [&](double r) { return map(support_point(model, from.curve, r)); };
  const auto fraction = [&](double r) { return from.closed ? wrapped(image.at(r)) : image.at(r); };
  // The polylines first: they cost no call.
  for (const double r : compared_at)
    if (norm(target(r) - support_point(model, image.curve, fraction(r))) > shares::of_polylines * length + gap) return false;
  const Curve& curve = model.curve(from.curve);
  const CurveUse& use = curve.uses.front();
  for (const double r : compared_at) {
    const double t = parameter_at(model, use, r);
    const Vec2 uv = model.cad.curve(model.face_ref(use), use.curve + 1, want_position, t).c;
    const Vec3 p = map(surface_at(model.cad, model.face_ref(use), want_position, uv).s);
    if (closest_on_curve(model, image.curve, 0, fraction(r), p).distance > gap) return false;
  }
  return true;
}

}  // namespace

double wrapped(double r) noexcept {
  const double rest = r - std::floor(r);
  return rest < rounding_of::places || rest > 1 - rounding_of::places ? 0 : rest;
}

CurveImage composed(const CurveImage& first, const CurveImage& second) noexcept {
  return {second.curve, first.reversed != second.reversed, second.at(first.shift)};
}

CurveImage inverse(int from, const CurveImage& image) noexcept {
  return {from, image.reversed, image.reversed ? image.shift : -image.shift};
}

CurveShape shape_of(const CurveModel& model, int index) {
  const Curve& curve = model.curve(index);
  CurveShape shape{.curve = index, .degenerate = curve.degenerate, .closed = curve.end1 == curve.end2, .length = model.length(index)};
  const CurveSupport& support = model.support(curve.uses.front());
  shape.low = shape.high = support.xyz.front();
  for (const Vec3& p : support.xyz) shape.low = shape.low.cwiseMin(p), shape.high = shape.high.cwiseMax(p);
  return shape;
}

Vec3 support_point(const CurveModel& model, int curve, double r) {
  const CurveUse& use = model.curve(curve).uses.front();
  const CurveSupport& support = model.support(use);
  return support.point_at_arc((use.reversed ? 1 - r : r) * support.length());
}

CurvePoint closest_on_curve(const CurveModel& model, int curve, std::size_t use, double r, const Vec3& target) {
  const CurveUse& of = model.curve(curve).uses[use];
  const CurveSupport& support = model.support(of);
  return find_closest(model, of, parameter_at(model, of, r), support.t.front(), support.t.back(), target);
}

std::optional<CurveImage> image_of(const CurveModel& model, const CurveShape& from, const CurveShape& to, const Isometry& map,
                                   double gap) {
  if (from.degenerate != to.degenerate || from.closed != to.closed) return {};
  const Curve &a = model.curve(from.curve), &b = model.curve(to.curve);
  const auto corner = [&](int point) { return model.topology.points[static_cast<std::size_t>(point)].position; };
  const Vec3 first = map(corner(a.end1)), last = map(corner(a.end2));
  if (from.degenerate) return norm(first - corner(b.end1)) <= gap ? std::optional(CurveImage{to.curve}) : std::nullopt;
  if (std::abs(from.length - to.length) > shares::of_polylines * std::max(from.length, to.length) + gap) return {};
  const double near = std::min(gap, shares::of_polylines * from.length);
  if (!from.closed) {
    const bool along = norm(first - corner(b.end1)) <= near && norm(last - corner(b.end2)) <= near;
    const bool against = norm(first - corner(b.end2)) <= near && norm(last - corner(b.end1)) <= near;
    for (const CurveImage& image : {CurveImage{to.curve, false, 0}, CurveImage{to.curve, true, 1}})
      if ((image.reversed ? against : along) && fits(model, from, image, map, near)) return image;
    return {};
  }
  const CurveUse& use = b.uses.front();
  const CurveSupport& support = model.support(use);
  const TracePlace place = nearest_on_trace(support.xyz, first);
  if (place.distance > shares::of_polylines * from.length + gap) return {};
  double r = place.arc / std::max(trace_length(support.xyz), 1e-300);
  r = use.reversed ? 1 - r : r;
  double shift = 0;
  if (norm(first - corner(b.end1)) > near) {
    const CurvePoint start = closest_on_curve(model, to.curve, 0, r, first);
    if (start.distance > near) return {};
    shift = support.arc_at_t(start.t) / support.length();
    shift = wrapped(use.reversed ? 1 - shift : shift);
  }
  for (const bool reversed : {false, true})
    if (const CurveImage image{to.curve, reversed, shift}; fits(model, from, image, map, near)) return image;
  return {};
}

}  // namespace carreau
