// The metric field of one parameter domain, sampled once and then evaluated without callbacks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "metric/metric2.h"
#include "support/monitor.h"

namespace carreau {

/// Gives the true metric at points of the domain. Never called for a point outside the domain given to the builder.
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

/// Control space of RR-2928 sec. 2: bilinear interpolation of the tensor on a grid over the domain's box.
class ControlSpace {
 public:
  static ControlSpace build(const SampledDomain& domain, const MetricSampler& sampler,
                            const ControlSpaceOptions& options, Monitor& monitor);
  /// The same metric everywhere.
  static ControlSpace constant(Metric2 metric);

  /// Metric at (u, v): symmetric positive definite, continuous. Points outside the box take the value of its nearest
  /// point.
  [[nodiscard]] Metric2 at(Vec2 uv) const noexcept {
    const double last = static_cast<double>(n_) - 1e-9;
    double x = (uv.x - low_.x) * scale_.x, y = (uv.y - low_.y) * scale_.y;
    x = x > 0 ? (x < last ? x : last) : 0;
    y = y > 0 ? (y < last ? y : last) : 0;
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const double fx = x - i, fy = y - j;
    const Metric2* p = nodes_.data() + static_cast<std::size_t>(j) * (n_ + 1) + i;
    const Metric2* q = p + n_ + 1;
    return (1 - fy) * ((1 - fx) * p[0] + fx * p[1]) + fy * ((1 - fx) * q[0] + fx * q[1]);
  }
  /// Expected number of triangles of unit edges in the domain.
  [[nodiscard]] double measure() const noexcept { return measure_; }
  [[nodiscard]] std::size_t samples() const noexcept { return samples_; }
  [[nodiscard]] std::size_t bytes() const noexcept { return nodes_.capacity() * sizeof(Metric2); }

 private:
  friend class ControlSpaceBuilder;
  Vec2 low_{}, scale_{1, 1};
  int n_ = 1;
  std::vector<Metric2> nodes_;
  double measure_ = 0;
  std::size_t samples_ = 0;
};

}  // namespace carreau
