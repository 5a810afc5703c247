// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/parameter_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "metric/metric2_algebra.h"
#include "metric/thresholds.h"
#include "periodic/closest.h"
#include "periodic/thresholds.h"
#include "support/infinity.h"
#include "support/shares.h"

namespace carreau {

namespace {

using namespace thresholds::periodic;

// Coefficients of the least-squares plane through values at points around their middle.
Vec2 slopes(const std::vector<Vec2>& at, const Vec2& middle, const std::vector<Vec2>& values, const Vec2& mean, int component) {
  double xx = 0, xy = 0, yy = 0, xv = 0, yv = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const Vec2 d = at[i] - middle;
    const double v = values[i][component] - mean[component];
    xx += d.x() * d.x(), xy += d.x() * d.y(), yy += d.y() * d.y(), xv += d.x() * v, yv += d.y() * v;
  }
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > 1e-20 * xx * yy)) return {0, 0};
  return {(yy * xv - xy * yv) / determinant, (xx * yv - xy * xv) / determinant};
}

Vec2 mean_of(const std::vector<Vec2>& points) {
  Vec2 sum(0, 0);
  for (const Vec2& p : points) sum += p;
  return sum / static_cast<double>(std::max<std::size_t>(points.size(), 1));
}

}  // namespace

ParameterMap::ParameterMap(const CurveModel& model, const FacePair& pair) {
  std::vector<Vec2> from, to;
  for (const auto& [curve, image] : pair.curves) {
    const std::vector<CurveUse>&uses = model.curve(curve).uses, &images = model.curve(image.curve).uses;
    const auto count = [](const std::vector<CurveUse>& all, int face) {
      return std::count_if(all.begin(), all.end(), [face](const CurveUse& use) { return use.face == face; });
    };
    // Sides of seams cannot be told apart yet.
    if (count(uses, pair.master) != 1 || count(images, pair.slave) != 1 || model.curve(curve).degenerate) continue;
    const auto use_in = [](const std::vector<CurveUse>& all, int face) {
      return *std::find_if(all.begin(), all.end(), [face](const CurveUse& use) { return use.face == face; });
    };
    const CurveUse a = use_in(uses, pair.master), b = use_in(images, pair.slave);
    const bool closed = model.curve(curve).end1 == model.curve(curve).end2;
    for (const double r : {0.05, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95}) {
      const double there = closed ? wrapped(image.at(r)) : image.at(r);
      const auto place = [&](const CurveUse& use, double at) {
        return model.cad.curve(model.face_ref(use), use.curve + 1, want_position, parameter_at(model, use, at)).c;
      };
      from.push_back(place(a, r));
      to.push_back(place(b, there));
    }
  }
  *this = ParameterMap(std::move(from), std::move(to));
}

ParameterMap::ParameterMap(std::vector<Vec2> from, std::vector<Vec2> to) : from_(std::move(from)), to_(std::move(to)) {
  if (from_.size() < 3) return;
  middle_ = mean_of(from_), image_ = mean_of(to_);
  for (int i = 0; i < 2; ++i) row_[i] = slopes(from_, middle_, to_, image_, i);
  Vec2 low = to_.front(), high = to_.front();
  for (const Vec2& p : to_) low = low.cwiseMin(p), high = high.cwiseMax(p);
  affine_ = true;
  for (std::size_t i = 0; i < from_.size() && affine_; ++i) {
    const Vec2 miss = guess(from_[i]) - to_[i];
    affine_ = std::abs(miss.x()) <= shares::negligible * (high.x() - low.x()) && std::abs(miss.y()) <= shares::negligible * (high.y() - low.y());
  }
}

Vec2 ParameterMap::guess(const Vec2& uv) const {
  if (affine_) {
    const Vec2 d = uv - middle_;
    return {image_.x() + dot(row_[0], d), image_.y() + dot(row_[1], d)};
  }
  double nearest = infinity;
  Vec2 found(0, 0);
  for (std::size_t i = 0; i < from_.size(); ++i)
    if (const double d = norm(from_[i] - uv); d < nearest) nearest = d, found = to_[i];
  return found;
}

SlaveSizes::SlaveSizes(const CurveModel& model, const std::vector<FacePair>& pairs) : model_(model), slaves_(model.model.faces.size()) {
  for (const FacePair& pair : pairs) slaves_[pair.master].push_back({&pair, ParameterMap(model, pair)});
}

// Calls use(i, jet of the face, uv and jet of the image, map) for each place that has an image.
template <typename Use>
void SlaveSizes::for_images(int face, std::span<const Vec2> uv, unsigned want, const Use& use) const {
  for (const Slave& slave : slaves_[face]) {
    const int ref = model_.model.faces[face].ref, other = model_.model.faces[slave.pair->slave].ref;
    std::vector<SurfaceJet> jets(uv.size()), images(uv.size());
    model_.cad.surface(ref, want_position | want_first, uv, jets);
    std::vector<Vec3> targets;
    std::vector<ClosestPoint> points;
    for (std::size_t i = 0; i < uv.size(); ++i) {
      targets.push_back(slave.pair->map(jets[i].s));
      points.push_back({slave.map.guess(uv[i]), {}, 0});
    }
    find_closest(model_.cad, other, targets, points);
    std::vector<Vec2> places;
    for (const ClosestPoint& point : points) places.push_back(point.uv);
    model_.cad.surface(other, want | want_position | want_first, places, images);
    for (std::size_t i = 0; i < uv.size(); ++i) {
      const double reach = norm(jets[i].su) + norm(jets[i].sv);
      if (points[i].distance <= max_gap * reach) use(i, jets[i], slave.pair, places[i], images[i]);
    }
  }
}

void SlaveSizes::lower(const SizeRules& rules, int face, std::span<const Vec2> uv, std::span<double> h) const {
  if (slaves_[face].empty()) return;
  const auto none = [](const Vec2&) { return infinity; };
  for_images(face, uv, rules.surface_wants(), [&](std::size_t i, const SurfaceJet&, const FacePair* pair, const Vec2& place, const SurfaceJet& image) {
    Metric2 metric;
    rules.alone_on_surface(pair->slave, {&place, 1}, {&image, 1}, none, {&metric, 1});
    const double trace = metric.a + metric.c, speed = dot(image.su, image.su) + dot(image.sv, image.sv);
    if (trace > 0) h[i] = std::min(h[i], std::sqrt(speed / trace));
  });
}

void SlaveSizes::intersect(const SizeRules& rules, int face, std::span<const Vec2> uv, std::span<Metric2> metric) const {
  if (slaves_[face].empty()) return;
  const auto none = [](const Vec2&) { return infinity; };
  for_images(face, uv, rules.surface_wants(), [&](std::size_t i, const SurfaceJet& jet, const FacePair* pair, const Vec2& place, const SurfaceJet& image) {
    Metric2 there;
    rules.alone_on_surface(pair->slave, {&place, 1}, {&image, 1}, none, {&there, 1});
    // Derivatives of the image's parameters: least squares of R S_u in its tangent plane.
    const double a = dot(image.su, image.su), b = dot(image.su, image.sv), c = dot(image.sv, image.sv);
    const double determinant = a * c - b * b;
    if (!(determinant > thresholds::degenerate::parallel * a * c)) return;
    const auto carried = [&](const Vec3& tangent) {
      const double p = dot(image.su, tangent), q = dot(image.sv, tangent);
      return Vec2((c * p - b * q) / determinant, (a * q - b * p) / determinant);
    };
    const Vec2 du = carried(pair->map.turn(jet.su)), dv = carried(pair->map.turn(jet.sv));
    const auto form = [&](const Vec2& x, const Vec2& y) {
      return there.a * x.x() * y.x() + there.b * (x.x() * y.y() + x.y() * y.x()) + there.c * x.y() * y.y();
    };
    const Metric2 mine{form(du, du), form(du, dv), form(dv, dv)};
    if (mine.a > 0 && mine.a * mine.c > mine.b * mine.b) metric[i] = intersection(metric[i], mine);
  });
}

}  // namespace carreau
