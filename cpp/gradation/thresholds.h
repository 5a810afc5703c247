// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room, with their meaning, unit, reason and support.
#pragma once

#include <numbers>

namespace carreau::thresholds::gradation {

// In brackets: the tests of the threshold, in tests/cpp/gradation and tests/cpp/surface/grade.

// Fronts of one size (gradation, graded_field)
/// Cosine. Tangent planes that are turned farther, by 177 degrees, have no rolling between them.
/// [Gradation.ConeAcrossACreaseWhateverTheSidesOfTheFaces]
inline constexpr double min_unfolded = -0.999;

// Metrics (metric_grading)
/// Ratio. Paths run along edges and from the middles of edges, every 30 degrees. So they are up to 1 / cos(15 degrees)
/// = 1.035 times too long. Half of that is taken from the slope. [Gradation.NoEdgeIsSteeperByDirection]
inline constexpr double detour = 1.0175;

// Narrow zones and faces that face each other (boundary_sides, proximity, facing)
/// Cosine. A boundary that turns by less goes straight on: below it are arcs of a few edges, above it the corners of
/// polygons. [Proximity.NarrowZonesHoldTheRequestedLayers; 0.7: frame.step by angle with gradation changes]
inline constexpr double straight_on = std::numbers::sqrt2 / 2;
/// Cosine. Fronts, or normals of faces, that meet within this angle of head on. [as above]
inline constexpr double head_on = 0.8;
/// Radians. Angle of a corner whose sides are near each other because it is a corner,
/// [Proximity.WideDomainsAreLeftAlone]
inline constexpr double sharp_corner = 100 * std::numbers::pi / 180;
/// Gaps. and its reach. [Proximity.WideDomainsAreLeftAlone]
inline constexpr double reach_of_corner = 2;
/// Radians. Below, the reach in gaps does not hold the tip: there the gap is 2 tan(angle / 2) of the distance from it.
/// [Proximity.WedgesEndInATriangle]
inline constexpr double wedge = 28 * std::numbers::pi / 180;
/// Ratio. Ways of fronts near corners may be shorter by it than the ways between their closest points, which are
/// vertices. [models: corners are no zones]
inline constexpr double longer_between_feet = 1.05;

}  // namespace carreau::thresholds::gradation
