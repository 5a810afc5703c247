// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this folder: their meaning, unit, reason and evidence.
#pragma once

namespace carreau::thresholds::measure {

// In brackets: the tests that rest on it, all of tests/cpp/measure.

/// Share of a limit. of gradations, which are measured by trapezoids.
/// [DeliveredPlane.GradationsBetweenTwoCurvesAreForced]
inline constexpr double gradation_tolerance = 0.02;

// Meshes of triangles
/// Share of the size. A mesh that is farther from its input triangles has lost a feature, or its sizes do not resolve a
/// curvature: a chord of .8 radii is .1 of its length away. [command_triangles]
inline constexpr double max_share_of_size = 0.1;

// Bounds of A0 and A1 (deviation_bounds)

}  // namespace carreau::thresholds::measure
