// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this folder: their meaning, unit, reason and evidence.
#pragma once

namespace carreau::thresholds::association {

/// Ratio of distances. References whose entities are so much farther apart than entities of like shapes were renumbered. [CarriedMesh.RenumberedFacesAreFound]
inline constexpr double renumbered = 2;

// Refinement (refine_mesh)
/// Evaluations of the middle of an edge.
inline constexpr int middle_steps = 3;
/// Cosine of the turn that a swap may make.
inline constexpr double swap_cosine = 0.8;
/// Shape (Q2). Triangles are restored whose shape is lower than the parent's, or than a good one, by the loss.
/// [Refine.HalvingKeepsShapesBesideCurves]
inline constexpr double shape_loss = 0.05;
/// Share of the worst shape of a face before. A worse one is reported.
inline constexpr double reported_loss = 0.5;

}  // namespace carreau::thresholds::association
