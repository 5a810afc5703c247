// SPDX-License-Identifier: BSD-3-Clause
#include "surface/sample/face_sampling.h"

#include <algorithm>
#include <cmath>

#include "cad/continued_cad.h"
#include "control_space/even_space.h"
#include "support/infinity.h"
#include "support/rounding_of.h"
#include "surface/sample/face_metric.h"
#include "support/ranks/shared_answers.h"
#include "surface/sample/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::sample;

// Returns whether the metric belongs to a size which is equal in all directions.
bool has_one_size(const SurfaceJet& jet, Metric2 m) noexcept {
  const double h = isotropic_size(jet, m), k = 1 / (h * h);
  if (!(h > 0)) return true;
  const double e = k * dot(jet.su, jet.su), f = k * dot(jet.su, jet.sv), g = k * dot(jet.sv, jet.sv);
  return std::abs(m.a - e) <= rounding_of::sizes * e && std::abs(m.c - g) <= rounding_of::sizes * g &&
         std::abs(m.b - f) <= rounding_of::sizes * std::sqrt(e * g);
}

// The median; infinity if most derivatives vanish.
double usual_square(std::vector<double>& squares) {
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  return *middle > 0 ? *middle : infinity;
}

// True if the prescription may be evaluated in the whole box of the domain, and no detail of it is narrower than an edge.
bool has_smooth_box(const PatchInput& input, const Cad& cad, const SizeRules& rules, std::span<const Vec2> probe_points) {
  return rules.constant() && input.limits.field == nullptr && probe_points.empty() && is_continued(cad, input.ref);
}

/// The samples of a batch: metrics, and the first derivatives in jets.
struct Samples {
  std::span<SurfaceJet> jets;
  std::span<Metric2> metric;
};

// Shares the samples among all processes that make the patch. Each process samples from the calling thread, since one
// thread uses `prescribed`.
void share_samples(const Executor& executor, int ref, Cad& cad, FaceMetric& prescribed, std::span<const Vec2> uv, const Samples& out,
                   Monitor& monitor) {
  constexpr std::size_t width = 9;
  const auto ask = [&](std::span<const Vec2> some, double* row, Monitor&) {
    prescribed.sample(cad, ref, 0, some, [&](std::size_t, const SurfaceJet& jet, const Metric2& m) {
      for (int axis = 0; axis < 3; ++axis) row[axis] = jet.su[axis], row[3 + axis] = jet.sv[axis];
      row[6] = m.a, row[7] = m.b, row[8] = m.c;
      row += width;
    });
  };
  const std::vector<double> all = shared_answers(executor, ref, {"samples of a face", width, 1, ask}, uv, monitor);
  for (std::size_t k = 0; k < uv.size(); ++k) {
    const double* row = all.data() + k * width;
    out.jets[k].su = {row[0], row[1], row[2]}, out.jets[k].sv = {row[3], row[4], row[5]};
    out.metric[k] = {row[6], row[7], row[8]};
  }
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
  SpeedWatch speeds(asked.max_uneven, asked.usual_speed);
  const auto look = [&](std::span<const Vec2> uv, std::span<const Metric2> metric, std::span<SurfaceTangents> tangents) {
    for (std::size_t i = 0; i < tangents.size(); ++i) tangents[i] = {jets[i].su, jets[i].sv};
    if (facts == nullptr) return;
    for (std::size_t i = 0; i < uv.size(); ++i) {
      if (facts->normals != nullptr) facts->normals->add(uv[i], cross(jets[i].su, jets[i].sv));
      if (!input.isotropic) facts->isotropic = facts->isotropic && has_one_size(jets[i], metric[i]);
    }
  };
  const bool costs_nothing = input.is_plane && rules.constant();
  const SurfaceSampler sampler = [&](std::span<const Vec2> uv, std::span<Metric2> metric,
                                     std::span<SurfaceTangents> tangents) {
    jets.resize(uv.size());
    if (!costs_nothing && is_shared(input.executor, uv.size())) {
      share_samples(input.executor, input.ref, cad, prescribed, uv, {jets, metric}, monitor);
      speeds.look(uv, jets);
    } else {
      cad.surface(input.ref, prescribed.wants(), uv, jets);
      speeds.look(uv, jets);
      prescribed.at(uv, jets, metric);
    }
    look(uv, metric, tangents);
  };
  ControlSpaceOptions space_options;
  space_options.probe_points = probe_points;
  space_options.tolerance = std::max(input.tolerance, rules.source_accuracy());
  const SampledDomain domain = sampled_domain(input.domain->plane);
  if (input.slope > 0)
    return ControlSpace::build_graded(domain, sampler, input.slope, !input.isotropic, space_options, monitor);
  const MetricSampler metrics = [&](std::span<const Vec2> uv, std::span<Metric2> metric) { sampler(uv, metric, {}); };
  if (has_smooth_box(input, cad, rules, probe_points))
    if (std::optional<ControlSpace> even = build_even_space(domain, metrics, monitor)) return std::move(*even);
  return ControlSpace::build(domain, metrics, space_options, monitor);
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
