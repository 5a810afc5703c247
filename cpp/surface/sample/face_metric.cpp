// SPDX-License-Identifier: BSD-3-Clause
#include "surface/sample/face_metric.h"

#include <algorithm>
#include <cmath>

#include "metric/metric2_algebra.h"
#include "metric/metric3_algebra.h"
#include "support/infinity.h"
#include "support/rounding_of.h"
#include "surface/sample/face_sampling.h"
#include "surface/sample/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::sample;

/// The direction of the meridian of a degenerate point. It follows the parameter along which the surface does not stand
/// still, if it stands still along the other; otherwise it leads towards the middle.
Vec2 along_meridian(const SurfaceJet& jet, const Vec2& to_middle, const Vec2& half) noexcept {
  const double u = norm(jet.su), v = norm(jet.sv);
  if (u <= rounding_of::heights * v) return {0, std::copysign(half.y(), to_middle.y())};
  if (v <= rounding_of::heights * u) return {std::copysign(half.x(), to_middle.x()), 0};
  return to_middle;
}

}  // namespace

double FaceMetric::interpolated(Vec2 uv) {
  if (!interfaces_) interfaces_.emplace(plane_, physical_, rules_.law(), monitor_);
  return (*interfaces_)(uv);
}

void FaceMetric::at(std::span<const Vec2> uv, std::span<const SurfaceJet> jets, std::span<Metric2> metric) {
  const auto fallback = [this](Vec2 p) { return interpolated(p); };
  rules_.on_surface(face_, uv, jets, fallback, metric);
  apply_limits(limits_, !rules_.uses_metrics(), face_, uv, jets, metric);
  if (!rules_.uses_metrics() || (!rules_.uses_curvature() && limits_.field == nullptr)) return;
  for (std::size_t i = 0; i < uv.size(); ++i)
    if (!TangentFrame::of(jets[i].su, jets[i].sv))
      if (const auto sizes = limit(uv[i], jets[i])) metric[i] = metric_of(jets[i], *sizes);
}

// A place inside the domain, a little way from a degenerate one along its meridian.
std::optional<Vec2> FaceMetric::beside(Vec2 uv, const SurfaceJet& jet) {
  if (!inside_) {
    const SampledDomain domain = sampled_domain(plane_);
    Vec2 low{infinity, infinity}, high{-infinity, -infinity};
    for (const Vec2& p : domain.vertices) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    inside_.emplace(Inside{{domain.vertices, domain.edges}, 0.5 * (low + high), 0.5 * (high - low)});
  }
  const Vec2 to_middle = inside_->middle - uv, way = along_meridian(jet, to_middle, inside_->half);
  for (const double share : ways_inside)
    for (const double sign : {1., -1.}) {
      const Vec2 p = uv + share * (sign * way + rounding_of::sizes * to_middle);
      if (inside_->locator.contains(p)) return p;
    }
  return {};
}

std::optional<TangentMetric> FaceMetric::limit(Vec2 uv, const SurfaceJet& at_uv) {
  const auto inside = beside(uv, at_uv);
  if (!inside) return {};
  const SurfaceJet jet = rules_.surface_jet(face_, wants(), *inside);
  if (!TangentFrame::of(jet.su, jet.sv)) return {};
  Metric2 there;
  const auto fallback = [this](Vec2 p) { return interpolated(p); };
  rules_.on_surface(face_, {&*inside, 1}, {&jet, 1}, fallback, std::span<Metric2>(&there, 1));
  apply_limits(limits_, false, face_, {&*inside, 1}, {&jet, 1}, {&there, 1});
  return tangent_metric(jet, there);
}

double isotropic_size(const SurfaceJet& jet, Metric2 metric) noexcept {
  const double first = dot(jet.su, jet.su) + dot(jet.sv, jet.sv), second = metric.a + metric.c;
  return first > 0 && second > 0 ? std::sqrt(first / second) : 0;
}

double geometric_mean_size(const SurfaceJet& jet, Metric2 metric) noexcept {
  const double density = accurate_determinant(metric), area = norm(cross(jet.su, jet.sv));
  return density > 0 && area > 0 ? std::sqrt(area / std::sqrt(density)) : 0;
}

namespace {

/// One size in all directions.
void limit_size(const SizeLimits& limits, int face, const Vec2& uv, const SurfaceJet& jet, Metric2& metric) noexcept {
  const double h = isotropic_size(jet, metric);
  if (!(h > 0)) return;
  const double k = h / std::min(limits.factor * limits.bounded(face, uv, jet.s, h), limits.largest);
  if (k != 1) metric = (k * k) * metric;
}

void limit_metric(const SizeLimits& limits, int face, const Vec2& uv, const SurfaceJet& jet, Metric2& metric) noexcept {
  auto sizes = tangent_metric(jet, metric);
  const double beside = limits.edges != nullptr ? limits.edges->at(jet.s) : infinity;
  if (!sizes) {
    const double h = isotropic_size(jet, metric), bounded = std::min(h, beside);
    const double graded = limits.field != nullptr ? std::min(bounded, limits.field->smaller_size(face, uv)) : bounded;
    const double k = h > 0 ? h / (limits.factor * graded) : 1 / limits.factor;
    metric = (k * k) * metric;
    return;
  }
  const TangentMetric before = *sizes;
  if (limits.field != nullptr) *sizes = limits.field->sizes(face, uv, jet.s, *sizes);
  if (std::isfinite(limits.lean)) bound_lean(jet, limits.lean, *sizes);
  sizes->h1 = std::min({limits.factor * sizes->h1, limits.largest, beside});
  sizes->h2 = std::min({limits.factor * sizes->h2, limits.largest, beside});
  if (sizes->h1 != before.h1 || sizes->h2 != before.h2) metric = metric_of(jet, *sizes);
}

}  // namespace

void apply_limits(const SizeLimits& limits, bool isotropic, int face, std::span<const Vec2> uv,
                  std::span<const SurfaceJet> jets, std::span<Metric2> metric) noexcept {
  if (limits.idle()) return;
  for (std::size_t i = 0; i < uv.size(); ++i)
    (isotropic ? limit_size : limit_metric)(limits, face, uv[i], jets[i], metric[i]);
}

}  // namespace carreau
