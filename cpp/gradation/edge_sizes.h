// SPDX-License-Identifier: BSD-3-Clause
// Sizes that grow from the edges of a boundary.
#pragma once

#include <vector>

#include "support/box_tree.h"
#include "support/infinity.h"
#include "support/vec.h"

namespace carreau {

/// The size at x is the least h(e) + slope |x - e| over edges e of space (Borouchaki, Hecht, Frey, from edges in place
/// of vertices). So triangles grow from short edges of a boundary to the size prescribed inside. Straight distances:
/// sizes are never larger than sizes by distances on the surface. at() is safe from several threads.
class EdgeSizes {
 public:
  /// An edge and the desired size beside it.
  struct Source {
    Vec3 a, b;
    double h = 0;
  };

  EdgeSizes() = default;
  EdgeSizes(std::vector<Source> sources, double slope);

  [[nodiscard]] bool empty() const noexcept { return sources_.empty(); }
  [[nodiscard]] double smallest() const noexcept;
  /// Number of unit triangles in the growth zones within `extent` of each edge, in a plane. Each ring counts its area
  /// over the area of its triangles; edges beside each other share rings. An upper bound.
  [[nodiscard]] double triangles_within(double extent) const noexcept;
  /// Copies the edges with sizes of at least h.
  [[nodiscard]] EdgeSizes bounded_below(double h) const;
  /// The smaller of the size at p and `most`. Logarithmic in the number of edges where few of them are near.
  [[nodiscard]] double at(const Vec3& p, double most = infinity) const noexcept;

 private:
  std::vector<Source> sources_;  // in the order of the tree
  BoxTree tree_;
  std::vector<double> least_;  // by node: the smallest size of its edges
  double slope_ = 0;
};

}  // namespace carreau
