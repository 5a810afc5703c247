#include "surface/face_metric.h"

#include <algorithm>
#include <cmath>

#include "metric/metric2_algebra.h"
#include "metric/metric3_algebra.h"

namespace carreau {

namespace {

// How far from a degenerate point towards a sound one limits are taken.
constexpr double towards_sound = 1e-2;

/// The step from a degenerate point that goes towards another one without leaving its meridian: without the part along
/// which the surface stands still, when that is one of the parameters.
Vec2 along_meridian(const SurfaceJet& jet, Vec2 step) noexcept {
  constexpr double still = 1e-12;
  const double u = norm(jet.su), v = norm(jet.sv);
  if (u <= still * v && step.y != 0) return {0, step.y};
  if (v <= still * u && step.x != 0) return {step.x, 0};
  return step;
}

}  // namespace

double FaceMetric::interpolated(Vec2 uv) {
  if (!interfaces_) interfaces_.emplace(plane_, physical_, rules_.law(), monitor_);
  return (*interfaces_)(uv);
}

void FaceMetric::at(std::span<const Vec2> uv, std::span<const SurfaceJet> jets, std::span<Metric2> metric) {
  const auto fallback = [this](Vec2 p) { return interpolated(p); };
  if (rules_.uses_metrics()) {
    rules_.metrics_on_surface(face_, uv, jets, fallback, metric);
    if (!limits_.idle()) apply_metric_limits(limits_, face_, uv, jets, metric);
    if (!rules_.uses_curvature() && limits_.field == nullptr) return;
    for (std::size_t i = 0; i < uv.size(); ++i)
      if (!TangentFrame::of(jets[i].su, jets[i].sv))
        if (const auto sizes = limit(i, uv, jets)) metric[i] = metric_of(jets[i], *sizes);
    return;
  }
  h_.resize(uv.size());
  rules_.on_surface(face_, uv, jets, fallback, h_);
  for (std::size_t i = 0; i < uv.size(); ++i) metric[i] = induced_metric(jets[i].su, jets[i].sv, h_[i]);
  if (!limits_.idle()) apply_limits(limits_, face_, uv, jets, metric);
}

std::optional<TangentMetric> FaceMetric::limit(std::size_t i, std::span<const Vec2> uv,
                                               std::span<const SurfaceJet> jets) {
  std::optional<Vec2> step;
  for (std::size_t k = 0; k < uv.size(); ++k) {
    const Vec2 to = uv[k] - uv[i];
    if ((!step || dot(to, to) < dot(*step, *step)) && TangentFrame::of(jets[k].su, jets[k].sv)) step = to;
  }
  if (!step) return {};
  const Vec2 beside = uv[i] + towards_sound * along_meridian(jets[i], *step);
  const SurfaceJet jet = rules_.surface_jet(face_, wants(), beside);
  if (!TangentFrame::of(jet.su, jet.sv)) return {};
  Metric2 there;
  const auto fallback = [this](Vec2 p) { return interpolated(p); };
  rules_.metrics_on_surface(face_, {&beside, 1}, {&jet, 1}, fallback, {&there, 1});
  if (!limits_.idle()) apply_metric_limits(limits_, face_, {&beside, 1}, {&jet, 1}, {&there, 1});
  return tangent_metric(jet, there);
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
