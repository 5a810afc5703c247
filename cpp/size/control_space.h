// The metric field of one parameter domain, sampled once and then evaluated without callbacks.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "metric/metric2.h"
#include "support/monitor.h"

namespace carreau {

/// Gives the true metric at points of the domain. Batches are as large as the refinement allows.
/// Never called for a point outside the domain given to the builder.
using MetricSampler = std::function<void(std::span<const Vec2> uv, std::span<Metric2> metric)>;

struct ControlSpaceOptions {
  double tolerance = 0.02;            ///< largest relative error of a length where the space is checked
  std::size_t max_samples = 200'000;  ///< calls of the sampler, points
  std::size_t min_samples = 0;
};

/// The closed parameter domain in which sampling is allowed: discretised loops, any orientation.
struct SampledDomain {
  std::vector<Vec2> vertices;
  std::vector<std::pair<int, int>> edges;  ///< boundary only
};

/// Control space of RR-2928 sec. 2 on an adaptive grid.
class ControlSpace {
 public:
  /// Samples `sampler` inside `domain` and refines until interpolation is within the tolerance.
  /// Throws what the sampler throws, and Cancelled.
  static ControlSpace build(const SampledDomain& domain, const MetricSampler& sampler,
                            const ControlSpaceOptions& options, Monitor& monitor);
  /// The same metric everywhere.
  static ControlSpace constant(Metric2 metric);

  /// Metric at (u, v): symmetric positive definite, continuous. Points outside the box take the value of its nearest
  /// point.
  [[nodiscard]] Metric2 at(Vec2 uv) const noexcept;

  [[nodiscard]] std::size_t samples() const noexcept;
  [[nodiscard]] std::size_t bytes() const noexcept;
};

}  // namespace carreau
