// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room, with their meaning, unit, reason and support.
#pragma once

#include <algorithm>
#include <cstddef>

namespace carreau::thresholds::adapt {

// In brackets: the tests that rest on it, all of tests/cpp/adapt.

// Recovery of derivatives
/// Ratio of the smallest to the largest diagonal entry of the triangular factor, below which a fit is not determined.
/// [Recovery.NamesThePlaceOfTooFewNeighbours]
inline constexpr double min_pivot = 0.02;
/// The same ratio for quadrics on the graph: four neighbours nearly in a cross do not determine the mixed term.
/// [Quadric.FindsTheCurvatureOfASphere]
inline constexpr double min_quadric_pivot = 0.2;
/// Rings of neighbours that a fit may take. [Recovery.IsExactOnQuadraticsUpToTheBorder]
inline constexpr int max_rings = 3;

// Functions of the host (differences)
/// Share of the diagonal. Largest step of differences. [EstimateFunction.IsExactForQuadratics]
inline constexpr double largest_step = 1e-4;
/// Ratio. An edge is blind if the function makes it so many times longer at its middle than at its ends.
/// [EstimateFunction.SeesBetweenVertices]
inline constexpr double blind = 2;

// Pieces of work that threads and processes share [time only]
/// Rows at a time of `n`: few enough that each of 64 takers has some, and enough that handing them out costs nothing.
inline constexpr std::size_t min_at_once = 256, max_at_once = 16384;
inline constexpr std::size_t at_once(std::size_t n) noexcept { return std::clamp(n / 64, min_at_once, max_at_once); }
/// One point of so many is evaluated by each process, so that different functions are found: 1.6 % more calls.
inline constexpr std::size_t points_of_one_compared = 64;
/// Vertices between two looks for a stop.
inline constexpr std::size_t between_checkpoints = 256;

// Transfer
/// Ratio. Fields linear in (u, v) are carried over exactly: the place in (u, v) counts unless the old mesh has
/// triangles so many times nearer elsewhere. The surface leaves them by an amount of second order, and so does this.
/// [TransferField.IsOfSecondOrderAroundPoles]
inline constexpr double as_near = 4;
/// Share of coordinates. Nearer places count as equal. [TransferField.KeepsValuesAtVerticesThatStay]
inline constexpr double place_rounding = 1e-14;
/// Places in curved elements: steps of Newton's method at most, coordinates of the reference below which they end.
/// [CurvedTransfer.IsExactForQuadraticsInAPlane]
inline constexpr int max_newton_steps = 20;
inline constexpr double newton_rounding = 1e-14;
/// Coordinates: if the last step is larger, the method has not converged. On surfaces steps shrink by a factor each,
/// not quadratically. [CurvedTransfer.ComponentsStayTogetherAndQuadrilateralsAreExactForLinearFields]
inline constexpr double newton_arrived = 1e-3;
/// Coordinates of the reference. Distance beside its element up to which a field's polynomial is taken: the sagitta of
/// a curved border. An edge of 90 degrees has a fifth. [CurvedTransfer.IsOfThirdOrderOnSurfaces]
inline constexpr double max_beside = 0.2;

}  // namespace carreau::thresholds::adapt
