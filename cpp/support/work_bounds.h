// SPDX-License-Identifier: BSD-3-Clause
// Bounds of loops that end by themselves, for all rooms. They hold only where input gives changes that undo each other.
#pragma once

namespace carreau::work_bounds {

/// Rounds over a mesh or a face, each of which changes what the round before has left. [MeshPlane, FreeElementsAtCurves.AreValidWhereEdgesTurn,
/// Staggering.StripsAreOfIsoscelesTriangles, SampledNormals]
inline constexpr int rounds = 8;
/// Passes over the places of a mesh that are still wrong: most end after a few. [UnevenParameters.NeighboursAndImposed,
/// SelfOverlap.ElementsThatHaveMetGo, ProjectedMeshes, CarriedMesh.RenumberedFacesAreFound]
inline constexpr int passes = 20;

}  // namespace carreau::work_bounds
