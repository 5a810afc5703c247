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

/// Gives the true metric at points of the domain; may return a tensor that is not definite (a degenerate side): it is
/// clamped. Called in batches, never for a point outside the domain given to the builder.
using MetricSampler = std::function<void(std::span<const Vec2> uv, std::span<Metric2> metric)>;

struct ControlSpaceOptions {
  /// Relative error of a squared length below which a cell is not refined further.
  double tolerance = 0.004;
  /// Samples for each vertex of the mesh to come: accuracy beyond that costs more calls than it is worth.
  double samples_per_vertex = 1.5;
  std::size_t min_samples = 81;
  std::size_t max_samples = 400'000;
};

/// The closed parameter domain in which sampling is allowed: discretised loops, any orientation.
struct SampledDomain {
  std::vector<Vec2> vertices;
  std::vector<std::pair<int, int>> edges;  ///< boundary only
};

/// Control space of RR-2928 sec. 2: bilinear interpolation of the tensor on a balanced quadtree over the domain's box.
/// Continuous, symmetric positive definite. Copies and calls of at() are safe from several threads.
class ControlSpace {
 public:
  /// Samples `sampler` inside `domain` and refines where interpolation is off. Throws what the sampler throws, and
  /// Cancelled.
  static ControlSpace build(const SampledDomain& domain, const MetricSampler& sampler,
                            const ControlSpaceOptions& options, Monitor& monitor);
  /// The same metric everywhere.
  static ControlSpace constant(Metric2 metric);

  /// Metric at (u, v). Points outside the box take the value of its nearest point.
  [[nodiscard]] Metric2 at(Vec2 uv) const noexcept {
    const double x = into_unit((uv.x - low_.x) * scale_.x), y = into_unit((uv.y - low_.y) * scale_.y);
    std::int32_t cell = table_[static_cast<std::size_t>(y * table_size_) * static_cast<std::size_t>(table_size_) +
                               static_cast<std::size_t>(x * table_size_)];
    while (cells_[static_cast<std::size_t>(cell)].child >= 0) {
      const Cell& c = cells_[static_cast<std::size_t>(cell)];
      cell = c.child + (x * c.scale - c.x >= 0.5 ? 1 : 0) + (y * c.scale - c.y >= 0.5 ? 2 : 0);
    }
    const Cell& c = cells_[static_cast<std::size_t>(cell)];
    const double fx = x * c.scale - c.x, fy = y * c.scale - c.y;
    const double w11 = fx * fy, w10 = fx - w11, w01 = fy - w11, w00 = 1 - fx - w01;
    const Metric2 &m00 = nodes_[static_cast<std::size_t>(c.node[0])],
                  &m10 = nodes_[static_cast<std::size_t>(c.node[1])],
                  &m01 = nodes_[static_cast<std::size_t>(c.node[2])],
                  &m11 = nodes_[static_cast<std::size_t>(c.node[3])];
    return {w00 * m00.a + w10 * m10.a + w01 * m01.a + w11 * m11.a,
            w00 * m00.b + w10 * m10.b + w01 * m01.b + w11 * m11.b,
            w00 * m00.c + w10 * m10.c + w01 * m01.c + w11 * m11.c};
  }

  /// Number of triangles of unit edges that the domain holds.
  [[nodiscard]] double measure() const noexcept { return measure_; }
  /// Points at which the sampler was called.
  [[nodiscard]] std::size_t samples() const noexcept { return samples_; }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return nodes_.capacity() * sizeof(Metric2) + cells_.capacity() * sizeof(Cell) +
           table_.capacity() * sizeof(std::int32_t);
  }

 private:
  friend class ControlSpaceBuilder;

  /// A square of the unit square: [x, x + 1] / scale times [y, y + 1] / scale.
  struct Cell {
    double scale = 1, x = 0, y = 0;
    std::int32_t child = -1;              ///< first of four, -1: a leaf
    std::int32_t node[4] = {0, 0, 0, 0};  ///< corners of a leaf: 00, 10, 01, 11
  };
  static double into_unit(double x) noexcept {
    constexpr double below_one = 1 - 1e-15;
    return x > 0 ? (x < below_one ? x : below_one) : 0;
  }

  Vec2 low_{}, scale_{1, 1};
  double table_size_ = 1;
  std::vector<std::int32_t> table_{0};  ///< cells by a uniform grid, so that most points find their leaf at once
  std::vector<Cell> cells_{Cell{}};
  std::vector<Metric2> nodes_{Metric2{}};
  double measure_ = 0;
  std::size_t samples_ = 0;
};

}  // namespace carreau
