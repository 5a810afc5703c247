// SPDX-License-Identifier: BSD-3-Clause
#include "fields/field_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "metric/metric2_algebra.h"
#include "support/infinity.h"
#include "support/pieces.h"

namespace carreau {

namespace {

const Vec3 no_point{nan, nan, nan};
const SurfaceJet nothing{no_point, no_point, no_point, no_point, no_point, no_point};
// Points evaluated at a time, as elsewhere.
constexpr std::size_t batch = 1024;
// A host that fails everywhere, by an exception at each point, would take seconds. After so many failures at single
// points, one of so many points is evaluated.
constexpr std::size_t max_in_vain = 1024, stride_in_vain = 31;
// Below this difference of the sizes the direction is determined by rounding errors.
constexpr double isotropic = 1e-6;

}  // namespace

TangentSizes tangent_sizes(const SurfaceJet& jet, Metric2 metric) noexcept {
  // In the orthonormal frame (Su / |Su|, its normal in the tangent plane) Su = (a, 0) and Sv = (b, c).
  const double a = norm(jet.su), b = dot(jet.su, jet.sv) / a, c = norm(cross(jet.su, jet.sv)) / a;
  // M of the frame: P^-T M P^-1, P = (a b; 0 c).
  const double xx = metric.a / (a * a), xy = (metric.b - metric.a * b / a) / (a * c);
  const double yy = (metric.c - 2 * metric.b * b / a + metric.a * b * b / (a * a)) / (c * c);
  const Metric2 tangent{xx, xy, yy};
  if (!std::isfinite(xx) || !std::isfinite(xy) || !std::isfinite(yy)) return {nan, nan, nan, nan};
  const Eigen2 e = eigen(tangent);
  if (!(e.minor > 0)) return {nan, nan, nan, nan};
  TangentSizes sizes;
  sizes.h1 = 1 / std::sqrt(e.major), sizes.h2 = 1 / std::sqrt(e.minor);
  sizes.h = std::sqrt(sizes.h1) * std::sqrt(sizes.h2);
  if (sizes.h2 <= (1 + isotropic) * sizes.h1) return sizes;
  sizes.angle = std::atan2(e.direction.y(), e.direction.x()) * 180 / std::numbers::pi;
  if (sizes.angle < 0) sizes.angle += 180;
  if (sizes.angle >= 180) sizes.angle -= 180;
  return sizes;
}

FieldSampler::FieldSampler(int ref, unsigned want, FaceMetric* prescribed, Cad& cad, Monitor& monitor)
    : ref_(ref),
      want_(want | (prescribed != nullptr ? prescribed->wants() : 0)),
      prescribed_(prescribed),
      cad_(cad),
      monitor_(monitor) {}

void FieldSampler::keep(const char* sentence) {
  failed_ = true;
  if (first_failure_.empty()) first_failure_ = sentence;
}

bool FieldSampler::evaluate(unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> jets) {
  try {
    cad_.surface(ref_, want, uv, jets);
    return true;
  } catch (const CallbackError& error) {
    keep(error.what());
    return false;
  }
}

bool FieldSampler::prescribe(std::span<const Vec2> uv, std::span<const SurfaceJet> jets, std::span<Metric2> metric) {
  try {
    prescribed_->at(uv, jets, metric);
    return true;
  } catch (const Cancelled&) {
    throw;
  } catch (const CallbackError& error) {
    keep(error.what());
  } catch (const Error&) {  // no answer, and no interfaces to interpolate one from
  }
  return false;
}

bool FieldSampler::sample_one(Vec2 uv, SurfaceJet& jet, Metric2& metric) {
  metric = {nan, nan, nan};
  failed_ = false;
  bool told = true;
  if (!evaluate(want_, {&uv, 1}, {&jet, 1})) {
    told = false;
    jet = nothing;
    SurfaceJet part;
    if ((want_ & want_position) != 0 && evaluate(want_position, {&uv, 1}, {&part, 1})) jet.s = part.s, told = true;
    if ((want_ & want_first) != 0 && evaluate(want_first, {&uv, 1}, {&part, 1}))
      jet.su = part.su, jet.sv = part.sv, told = true;
  } else if (prescribed_ != nullptr && !prescribe({&uv, 1}, {&jet, 1}, {&metric, 1})) {
    metric = {nan, nan, nan};
  }
  if (failed_) ++failures_;
  return told;
}

// Evaluates one point of so many, and skips the others. Returns false, with nothing changed, when the host answers.
bool FieldSampler::sample_some(std::span<const Vec2> uv, std::span<SurfaceJet> jets, std::span<Metric2> metric) {
  const std::int64_t before = failures_;
  for (std::size_t k = 0; k < uv.size(); k += stride_in_vain)
    if (sample_one(uv[k], jets[k], metric[k])) {
      failures_ = before;
      return false;
    }
  failures_ = before + static_cast<std::int64_t>(uv.size());
  std::fill(jets.begin(), jets.end(), nothing);
  std::fill(metric.begin(), metric.end(), Metric2{nan, nan, nan});
  return true;
}

void FieldSampler::sample(std::span<const Vec2> uv, std::span<SurfaceJet> jets, std::span<Metric2> metric) {
  if (prescribed_ == nullptr) std::fill(metric.begin(), metric.end(), Metric2{nan, nan, nan});
  if (want_ == 0) return;
  for_pieces(uv.size(), batch, [&](std::size_t i, std::size_t n) {
    monitor_.checkpoint();
    const auto points = uv.subspan(i, n);
    const auto there = jets.subspan(i, n);
    const auto here = metric.subspan(i, n);
    const bool told = evaluate(want_, points, there);
    answered_ = answered_ || told;
    if (told && (prescribed_ == nullptr || prescribe(points, there, here))) return;
    if (!answered_ && in_vain_ >= max_in_vain && sample_some(points, there, here)) return;
    for (std::size_t k = 0; k < n; ++k)
      if (sample_one(points[k], there[k], here[k]))
        answered_ = true;
      else
        ++in_vain_;
  });
}

}  // namespace carreau
