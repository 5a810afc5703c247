// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room, with their meaning, unit, reason and support.
#pragma once

namespace carreau::thresholds::adapt {

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

// Transfer
/// Ratio. Fields linear in (u, v) are carried over exactly: the place in (u, v) counts unless the old mesh has
/// triangles so many times nearer elsewhere. The surface leaves them by an amount of second order, and so does this.
/// [TransferField.IsOfSecondOrderAroundPoles]
inline constexpr double as_near = 4;
/// Coordinates of the reference. Distance beside its element up to which a field's polynomial is taken: the sagitta of
/// a curved border. An edge of 90 degrees has a fifth. [CurvedTransfer.IsOfThirdOrderOnSurfaces]
inline constexpr double max_beside = 0.2;

}  // namespace carreau::thresholds::adapt
