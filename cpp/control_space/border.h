// SPDX-License-Identifier: BSD-3-Clause
// Values near the boundary of the domain, where nodes outside of it cannot be sampled. Private to the builder.
#pragma once

#include <vector>

#include "control_space/lattice.h"

namespace carreau::detail {

/// Samples at vertices of the boundary, and values fitted to them and to sampled nodes.
class BorderSamples {
 public:
  explicit BorderSamples(const Lattice& lattice);

  /// A sample at a position in units of the finest grid.
  void add(Vec2 position, Metric2 root);
  /// Replaces the value of a sample, in the order of add().
  void set(std::size_t sample, Metric2 root) noexcept { samples_[sample].root = root; }
  [[nodiscard]] std::size_t size() const noexcept { return samples_.size(); }

  /// The value at `position` of a quadratic polynomial that fits samples and sampled nodes (moving least squares,
  /// larger weights for nearer ones). The neighbourhood reaches a few times `size` (units of the finest grid). It grows
  /// until it holds a sample, and the degree falls if it holds too few. Positive definite when all samples are. Needs
  /// at least one sample of either kind.
  [[nodiscard]] Metric2 fit(Vec2 position, std::int32_t size);

 private:
  struct Sample {
    Vec2 position;
    Metric2 root;
  };
  void collect(Vec2 centre, double reach, std::int32_t spacing, std::vector<Sample>& found);
  void sort_nodes();

  const Lattice& lattice_;
  int columns_, rows_;
  std::vector<Sample> samples_;
  std::vector<std::vector<std::int32_t>> in_cell_;  // by coarsest cells
  // While samples are few: the sampled nodes, row by row.
  struct NodeAt {
    GridPoint p;
    std::int32_t node;
  };
  std::vector<NodeAt> nodes_;
};

}  // namespace carreau::detail
