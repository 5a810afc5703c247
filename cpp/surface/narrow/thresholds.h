// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room, with their units, their reasons and the tests that support them.
#pragma once

#include <cstddef>

namespace carreau::thresholds::narrow {

// In brackets: the tests that rest on it, all of tests/cpp/surface/narrow.

/// Widths. A round or bent end of a strip is longer than the strip is wide: half a circle has 1.57 times its diameter.
/// [Narrow.WedgeCollapses]
inline constexpr double longest_end_cap = 2;
/// Places on a loop that decide the sense in which the other loop runs. [Narrow.RingBetweenCylindersCollapses]
inline constexpr int probes = 12;
/// Gaps. A face is without width if its surface, halfway between two uses of a curve, is within this distance from
/// them, [Folded.FaceWithoutWidthIsNoFailure]
inline constexpr double folded_gap = 4;
/// Widths. Vertices on two sides stand for one place if their distance along the sides is less. If they are farther
/// apart, triangles between them would become worse, and a collapse would move them more than it must.
/// [Narrow.ChainOfSliversHasOneLayerEach]
inline constexpr double same_place = 3;
/// Share of the sides. Vertices as near as this are at one place too, whatever the width. Lengths of supports are
/// accurate to 1e-6, and each round of matching would take smaller differences for new places.
/// [Narrow.RingNarrowerThanItsSupportsAreAccurateHasTheEdgesOfOneCircle]
inline constexpr double place_accuracy = 1e-5;

}  // namespace carreau::thresholds::narrow
