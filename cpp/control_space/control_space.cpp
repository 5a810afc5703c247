// SPDX-License-Identifier: BSD-3-Clause
#include "control_space/control_space.h"

#include <algorithm>

#include "control_space/writer.h"

namespace carreau {

ControlSpace ControlSpace::build(const SampledDomain& domain, const MetricSampler& sampler,
                                 const ControlSpaceOptions& options, Monitor& monitor) {
  const SurfaceSampler metrics_only = [&](std::span<const Vec2> uv, std::span<Metric2> metric,
                                          std::span<SurfaceTangents>) { sampler(uv, metric); };
  detail::ControlSpaceSampling sampling(domain, metrics_only, false, options, monitor);
  sampling.run();
  return ControlSpaceWriter(sampling, monitor).run();
}

ControlSpace ControlSpace::build_graded(const SampledDomain& domain, const SurfaceSampler& sampler, double slope,
                                        bool directed, const ControlSpaceOptions& options, Monitor& monitor) {
  ControlSpaceOptions graded = options;
  graded.thorough = true;
  detail::ControlSpaceSampling sampling(domain, sampler, true, graded, monitor);
  sampling.run();
  sampling.bound_slopes(slope, directed);
  return ControlSpaceWriter(sampling, monitor).run();
}

MetricSlopes ControlSpace::slopes_in(const Leaf& leaf, double s, double t) const noexcept {
  double root[3], by_s[3], by_t[3];
  for (int k = 0; k < 3; ++k) {
    const auto c = [&](int i) { return leaf.c[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)]; };
    const double p0 = (c(2) * s + c(1)) * s + c(0), p1 = (c(5) * s + c(4)) * s + c(3),
                 p2 = (c(8) * s + c(7)) * s + c(6);
    root[k] = (p2 * t + p1) * t + p0;
    by_t[k] = 2 * p2 * t + p1;
    by_s[k] = ((2 * c(8) * s + c(7)) * t + 2 * c(5) * s + c(4)) * t + 2 * c(2) * s + c(1);
  }
  // The symmetric part of the product of two symmetric matrices.
  const auto product = [&](const double* p, const double* q) {
    return Metric2{unit_.a * (p[0] * q[0] + p[1] * q[1]), 0.5 * unit_.b * (p[1] * (q[0] + q[2]) + q[1] * (p[0] + p[2])),
                   unit_.c * (p[1] * q[1] + p[2] * q[2])};
  };
  return {product(root, root), 2 * leaf.scale * scale_.x() * product(root, by_s),
          2 * leaf.scale * scale_.y() * product(root, by_t)};
}

MetricSlopes ControlSpace::slopes_at(const Vec2& uv) const noexcept {
  const Place at = place(uv);
  return slopes_in(*at.leaf, at.s, at.t);
}

bool ControlSpace::is_constant() const noexcept {
  constexpr std::array<double, 3> none{};
  return std::all_of(leaves_.begin(), leaves_.end(), [&](const Leaf& leaf) {
    return leaf.c[0] == leaves_[0].c[0] && std::all_of(leaf.c.begin() + 1, leaf.c.end(), [&](const auto& c) { return c == none; });
  });
}

double ControlSpace::largest_bend() const noexcept {
  double largest = 0;
  for (const Leaf& leaf : leaves_) largest = std::max(largest, bend_of_shapes(slopes_in(leaf, 0, 0)));
  return largest;
}

ControlSpace ControlSpace::constant(Metric2 metric) {
  ControlSpace space;
  // The root (0, 1; 1, 1) has the square (1, 1; 1, 2): at() returns exactly the metric.
  space.unit_ = {metric.a, metric.b, 0.5 * metric.c};
  space.leaves_[0].c[0] = {0, 1, 1};
  return space;
}

void ControlSpace::scale_lengths(double factor) noexcept {
  const double k = factor * factor;
  unit_ = k * unit_;
  measure_ *= k;
  for (double& measure : measures_) measure *= k;
}

}  // namespace carreau
