#include "surface/face_metric.h"

#include <algorithm>
#include <cmath>

#include "metric/metric2_algebra.h"

namespace carreau {

void FaceMetric::at(std::span<const Vec2> uv, std::span<const SurfaceJet> jets, std::span<Metric2> metric) {
  const auto fallback = [this](Vec2 p) {
    if (!interfaces_) interfaces_.emplace(plane_, physical_, rules_.law(), monitor_);
    return (*interfaces_)(p);
  };
  if (rules_.uses_metrics()) {
    rules_.metrics_on_surface(face_, uv, jets, fallback, metric);
    if (!limits_.idle()) apply_metric_limits(limits_, face_, uv, jets, metric);
    return;
  }
  h_.resize(uv.size());
  rules_.on_surface(face_, uv, jets, fallback, h_);
  for (std::size_t i = 0; i < uv.size(); ++i) metric[i] = induced_metric(jets[i].su, jets[i].sv, h_[i]);
  if (!limits_.idle()) apply_limits(limits_, face_, uv, jets, metric);
}

double isotropic_size(const SurfaceJet& jet, Metric2 metric) noexcept {
  const double first = dot(jet.su, jet.su) + dot(jet.sv, jet.sv), second = metric.a + metric.c;
  return first > 0 && second > 0 ? std::sqrt(first / second) : 0;
}

double mean_size(const SurfaceJet& jet, Metric2 metric) noexcept {
  const double density = accurate_determinant(metric), area = norm(cross(jet.su, jet.sv));
  return density > 0 && area > 0 ? std::sqrt(area / std::sqrt(density)) : 0;
}

void apply_limits(const SizeLimits& limits, int face, std::span<const Vec2> uv, std::span<const SurfaceJet> jets,
                  std::span<Metric2> metric) noexcept {
  for (std::size_t i = 0; i < uv.size(); ++i) {
    const double h = isotropic_size(jets[i], metric[i]);
    if (!(h > 0)) continue;
    const double k = h / std::min(limits.factor * limits.bounded(face, uv[i], jets[i].s, h), limits.largest);
    if (k != 1) metric[i] = (k * k) * metric[i];
  }
}

void apply_metric_limits(const SizeLimits& limits, int face, std::span<const Vec2> uv, std::span<const SurfaceJet> jets,
                         std::span<Metric2> metric) noexcept {
  for (std::size_t i = 0; i < uv.size(); ++i) {
    auto sizes = tangent_metric(jets[i], metric[i]);
    if (!sizes) {
      const double h = isotropic_size(jets[i], metric[i]);
      const double graded = limits.field != nullptr ? std::min(h, limits.field->smaller_size(face, uv[i])) : h;
      const double k = h > 0 ? h / (limits.factor * graded) : 1 / limits.factor;
      metric[i] = (k * k) * metric[i];
      continue;
    }
    const TangentMetric before = *sizes;
    if (limits.field != nullptr) *sizes = limits.field->sizes(face, uv[i], *sizes);
    sizes->h1 = std::min(limits.factor * sizes->h1, limits.largest);
    sizes->h2 = std::min(limits.factor * sizes->h2, limits.largest);
    if (sizes->h1 != before.h1 || sizes->h2 != before.h2) metric[i] = metric_of(jets[i], *sizes);
  }
}

}  // namespace carreau
