// SPDX-License-Identifier: BSD-3-Clause
// The walk over a graph that sizes and metrics share: its fans of places, its normals and Dijkstra's order.
#pragma once

#include <utility>
#include <vector>

#include "gradation/gradation.h"
#include "gradation/place_fans.h"
#include "gradation/smallest_first.h"
#include "support/monitor.h"

namespace carreau::detail {

/// `m`, a normal of either side, on the side of `n`.
inline Vec3 facing(const Vec3& n, const Vec3& m) noexcept { return dot(n, m) < 0 ? Vec3(-1 * m) : m; }

/// Keeps a reference to the graph. `Value` is a size of a vertex, with its line, or a metric of a place; values grow by `slope` at most.
template <typename Value>
class GraphWalk {
 protected:
  GraphWalk(const GradationGraph& graph, std::vector<Value> values, double slope, Monitor& monitor)
      : graph_(graph), values_(std::move(values)), slope_(slope), monitor_(monitor), fans_(graph) {}

  [[nodiscard]] int vertex(int place) const noexcept { return graph_.places[place].vertex; }
  [[nodiscard]] const Vec3& position(int place) const noexcept { return graph_.xyz[vertex(place)]; }
  [[nodiscard]] const Vec3& normal(int place) const noexcept { return graph_.places[place].normal; }

  /// Calls step(beside, to) for both ends `to` of the side opposite `from` in each of its triangles.
  template <typename Step>
  void step_from(int from, const Step& step) const {
    for (const auto& [a, b] : fans_.triangles(from)) {
      step(b, a);
      step(a, b);
    }
  }

  const GradationGraph& graph_;
  std::vector<Value> values_;
  double slope_;
  Monitor& monitor_;
  PlaceFans fans_;
  SmallestFirst queue_;
};

}  // namespace carreau::detail
