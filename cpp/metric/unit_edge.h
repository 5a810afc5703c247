// SPDX-License-Identifier: BSD-3-Clause
// Lengths of edges in the metric of a unit mesh, for all rooms.
#pragma once

#include <numbers>

namespace carreau::unit_edge {

/// Edges in range (HDR eq. 2.14 and sec. 4.5.5, RR-2818 sec. 4.5): others are collapsed and split. [DeliveredPlane.UniformLengthsAreExact]
inline constexpr double shortest = std::numbers::sqrt2 / 2, longest = std::numbers::sqrt2;
/// Edges that a change may make where nothing else helps. [improve/even_edges_test, guarantees_test, quads_test]
inline constexpr double shortest_at_last = 0.5, longest_at_last = 1.6;
/// Lengths are summed up from pieces no longer than this, and gradations are measured over no less: over a hundredth of a unit, sizes that
/// differ by an invisible tenth would have a gradation of 14 000. [DeliveredPlane.QuadratureHasItsOrder,
/// GradationOfTinyEdgesIsOverATenthOfAUnit]
inline constexpr double finest = 0.1;
/// First and last step of a search for a better place of a vertex. [quads_test, cross_patch_test]
inline constexpr double first_step = 0.2, last_step = 0.02;

}  // namespace carreau::unit_edge
