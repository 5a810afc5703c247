// SPDX-License-Identifier: BSD-3-Clause
// The parameter domain of a face, bounded by curves of the host.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "cad/cad.h"
#include "support/box_tree.h"
#include "support/vec.h"

namespace carreau {

/// Decides whether points lie in the closed domain. The polygon of the samples decides for most points; close to an edge
/// the curve itself decides: a point between the curve and its chord changes sides. Searches are safe from several threads.
class ParameterDomain {
 public:
  /// A point of curve ic at t.
  using Curve = std::function<Vec2(int ic, double t)>;

  ParameterDomain() = default;
  explicit ParameterDomain(std::vector<BoundaryCurve> boundary);

  [[nodiscard]] bool empty() const noexcept { return edges_.empty(); }
  /// True if the boundary may pass through the box [low, high]; never false if it does.
  [[nodiscard]] bool may_cross(Vec2 low, Vec2 high) const;
  /// True if p is in the closed domain, with a tolerance of 1e-14 of its largest coordinate.
  [[nodiscard]] bool contains(Vec2 p, const Curve& curve) const;

 private:
  struct Edge {
    int ic = 0;
    double t0 = 0, t1 = 0;
    Vec2 a, b;
  };
  enum class Side { same, other, on };
  [[nodiscard]] Side side_of(const Edge& edge, Vec2 p, const Curve& curve) const;

  std::vector<Edge> edges_;
  BoxTree tree_;
  double tolerance_ = 0;
};

}  // namespace carreau
