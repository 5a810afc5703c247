// SPDX-License-Identifier: BSD-3-Clause
// The sides of domains: boundaries between two corners.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gradation/gradation.h"

namespace carreau {

/// Numbers the boundaries of all faces by sides. Edges that follow one another in a face and turn by less than 45
/// degrees, in space, are of one side, whatever curves they belong to. `on_boundary[t]` has bit i set when the side of
/// triangle t from corner i to the next one lies on a boundary.
class BoundarySides {
 public:
  BoundarySides(const GradationGraph& graph, const std::vector<std::uint8_t>& on_boundary);

  /// Sides that meet at a place, one entry for each edge: both ends of a side that closes there.
  [[nodiscard]] std::span<const int> at_place(int place) const noexcept;
  /// Sides at all places of a vertex.
  [[nodiscard]] const std::vector<int>& at_vertex(int vertex) const noexcept { return at_vertex_[vertex]; }
  /// Side of the edge on a boundary between two places.
  [[nodiscard]] std::span<const int> of_edge(int a, int b) const noexcept;

 private:
  void number(const GradationGraph& graph);

  std::vector<std::array<int, 2>> edges_;  // places, the smaller first, ascending
  std::vector<int> side_;                  // of edges
  std::vector<std::size_t> first_;         // of places: where theirs begin in at_place_
  std::vector<int> at_place_;              // sides
  std::vector<std::vector<int>> at_vertex_;
};

}  // namespace carreau
