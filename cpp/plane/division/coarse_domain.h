// SPDX-License-Identifier: BSD-3-Clause
// A domain with fewer vertices on its curves, which keeps its shape.
#pragma once

#include <span>
#include <vector>

#include "control_space/control_space.h"
#include "mesh/plane_mesh.h"

namespace carreau::plane {

struct CoarseDomain {
  PlaneDomain domain;
  std::vector<int> fine;   ///< by vertex: its number in the domain that it was made of
  std::vector<int> first;  ///< by edge, and one more: the first of its edges in `edges`
  std::vector<int> edges;  ///< of the domain that it was made of, from end a of each coarse edge to its end b

  [[nodiscard]] std::span<const int> edges_of(std::size_t coarse) const noexcept {
    return std::span(edges).subspan(static_cast<std::size_t>(first[coarse]),
                                    static_cast<std::size_t>(first[coarse + 1] - first[coarse]));
  }
};

/// Edges that follow each other without turning much become one, as long as it has `length` units at most. Ends of
/// curves, imposed points, and degenerate sides stay as they are.
CoarseDomain make_coarse(const PlaneDomain& domain, const ControlSpace& metric, double length);

}  // namespace carreau::plane
