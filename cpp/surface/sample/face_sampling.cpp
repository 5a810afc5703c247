// SPDX-License-Identifier: BSD-3-Clause
#include "surface/sample/face_sampling.h"

#include <algorithm>
#include <cmath>

#include "support/infinity.h"
#include "surface/sample/face_metric.h"
#include "surface/sample/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::sample;

// Whether the metric is that of a size which is the same in all directions.
bool has_one_size(const SurfaceJet& jet, Metric2 m) noexcept {
  const double h = isotropic_size(jet, m), k = 1 / (h * h);
  if (!(h > 0)) return true;
  const double e = k * dot(jet.su, jet.su), f = k * dot(jet.su, jet.sv), g = k * dot(jet.sv, jet.sv);
  return std::abs(m.a - e) <= same_size * e && std::abs(m.c - g) <= same_size * g &&
         std::abs(m.b - f) <= same_size * std::sqrt(e * g);
}

// The median; where most do not move nothing is usual.
double usual_square(std::vector<double>& squares) {
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  return *middle > 0 ? *middle : infinity;
}

}  // namespace

void SpeedWatch::look(std::span<const Vec2> uv, std::span<const SurfaceJet> jets) {
  if (std::isinf(most2_)) return;
  if (usual_u2_ == 0 && usual_v2_ == 0) find_usual(jets);
  for (std::size_t i = 0; i < uv.size(); ++i) {
    const double u2 = dot(jets[i].su, jets[i].su), v2 = dot(jets[i].sv, jets[i].sv);
    if (u2 > most2_ * usual_u2_) throw UnevenSpeed{uv[i], std::sqrt(u2 / usual_u2_)};
    if (v2 > most2_ * usual_v2_) throw UnevenSpeed{uv[i], std::sqrt(v2 / usual_v2_)};
  }
}

void SpeedWatch::find_usual(std::span<const SurfaceJet> jets) {
  if (jets.empty()) return;
  std::vector<double> u2, v2;
  for (const SurfaceJet& jet : jets) u2.push_back(dot(jet.su, jet.su)), v2.push_back(dot(jet.sv, jet.sv));
  usual_u2_ = usual_square(u2), usual_v2_ = usual_square(v2);
}

ControlSpace sample_face(const PatchInput& input, Cad& cad, const SizeRules& rules, std::span<const Vec2> probe_points,
                         Monitor& monitor, SampledFacts* facts) {
  FaceMetric prescribed = prescription_of(input, rules, monitor);
  std::vector<SurfaceJet> jets;
  const SampledFacts asked = facts != nullptr ? *facts : SampledFacts{};
  SpeedWatch speeds(asked.most_uneven, asked.usual_speed);
  const SurfaceSampler sampler = [&](std::span<const Vec2> uv, std::span<Metric2> metric,
                                     std::span<SurfaceTangents> tangents) {
    jets.resize(uv.size());
    cad.surface(input.ref, prescribed.wants(), uv, jets);
    speeds.look(uv, jets);
    prescribed.at(uv, jets, metric);
    for (std::size_t i = 0; i < tangents.size(); ++i) tangents[i] = {jets[i].su, jets[i].sv};
    if (facts == nullptr) return;
    for (std::size_t i = 0; i < uv.size(); ++i) {
      if (facts->normals != nullptr) facts->normals->add(uv[i], cross(jets[i].su, jets[i].sv));
      if (rules.uses_metrics()) facts->isotropic = facts->isotropic && has_one_size(jets[i], metric[i]);
    }
  };
  ControlSpaceOptions space_options;
  space_options.probe_points = probe_points;
  space_options.tolerance = std::max(input.tolerance, rules.source_accuracy());
  const SampledDomain domain = sampled_domain(input.domain->plane);
  if (input.slope > 0)
    return ControlSpace::build_graded(domain, sampler, input.slope, !input.isotropic, space_options, monitor);
  return ControlSpace::build(
      domain, [&](std::span<const Vec2> uv, std::span<Metric2> metric) { sampler(uv, metric, {}); }, space_options,
      monitor);
}

std::vector<double> prescribed_sizes(const PatchInput& input, Cad& cad, const SizeRules& rules,
                                     std::span<const Vec2> uv, Monitor& monitor) {
  if (input.constant_size) return std::vector<double>(uv.size(), *input.constant_size);
  FaceMetric prescribed = prescription_of(input, rules, monitor);
  std::vector<double> sizes(uv.size());
  prescribed.sample(cad, input.ref, 0, uv, [&](std::size_t k, const SurfaceJet& jet, Metric2 metric) {
    sizes[k] = geometric_mean_size(jet, metric);
  });
  return sizes;
}

}  // namespace carreau
