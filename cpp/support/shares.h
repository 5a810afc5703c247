// SPDX-License-Identifier: BSD-3-Clause
// Shares of a length, size, extent or tolerance that mean one thing in all rooms.
#pragma once

namespace carreau::shares {

/// No mesh shows a difference so small, although it is no rounding: steps end, and sizes, widths and gains count as equal.
/// [TinyEdges.InALoopBecomePoints, SizeRules.PolesTakeTheRadiusBesideThem, Narrow.ChamferOfABoxCollapses, DeviationBounds.NarrowBumpIsFound,
/// Gradation.NoEdgeIsSteeperByDirection]
inline constexpr double negligible = 1e-3;
/// Such an error is allowed for a value that is interpolated, or found along the surface. [CrossPatchElements.
/// AreaConvergesAsThePolynomialsPromise, gradation_test; doubled, 1 of 15 graded meshes changes]
inline constexpr double small = 0.01;
/// Such an error is left by polylines and trapezoids: lengths of curves and gradations along them.
/// [DeliveredPlane.GradationsBetweenTwoCurvesAreForced, tests/cabi/periodic_test]
inline constexpr double of_polylines = 0.02;
/// A larger difference is a change: of sizes, of a surface, of places that should be one. [Verification.SampledDetailsCostNothing,
/// BadModels.SurfaceThatJumpsInManyPlaces, CarriedMesh.RenumberedFacesAreFound, ControlSpace.IsDefiniteEverywhereInTheBox; chart_tolerance
/// of .08: worst of swirl at 51 : 1 .36 to .07]
inline constexpr double notable = 0.1;
/// Reserve of an estimate against curved sides, metrics that vary and samples that took part in it. [Closeness.EndsAtACusp,
/// ControlSpace.ErrorsFollowTheTolerance, Waists, Poles]
inline constexpr double reserve = 0.25;

}  // namespace carreau::shares
