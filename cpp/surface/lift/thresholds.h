// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room: what they are, in which unit, why, and what supports them.
#pragma once

#include <cstddef>

namespace carreau::thresholds::lift {

// In brackets: the tests that rest on it, of tests/cpp/surface/lift where nothing else is said.

// True lengths (verification)
/// True length over promised length. An arc of 150 degrees is 1.36 times its chord.
/// [Verification.BumpsThatNoSampleHitsAreMeshedAtTheirSize]
inline constexpr double too_long = 1.3;
/// The same. Where a mesh is much too fine, as where it is too coarse. [Verification.WhatTheSamplesKnowCostsNothing]
inline constexpr double too_short = 0.65;
/// True length over promised length. Such edges are looked at for jumps: where the surface is continuous between their
/// ends, nothing becomes of it. [surface: BadModels.SurfaceThatJumpsByAFewEdges]
inline constexpr double excess = 8;
/// Relative length. A change of the control space that is worth another mesh. [Verification.WhatTheSamplesKnow...]
inline constexpr double notable_change = 0.1;
/// Ratio of lengths. An edge that is so much shorter than another of its triangle is a point of space: triangles of
/// prescribed metrics are some ten thousand times longer than wide at most. [surface: Poles]
inline constexpr double one_point = 1e-6;
/// Places. Looked at in one face: spread over all of them, more cost and tell no more. [surface: BadModels.
/// SurfaceThatJumpsInManyPlaces]
inline constexpr std::size_t most_places = 500;
/// Triangles. Of a part that one thread looks at between two looks at the monitor. [tests/cpp/measure: stops; time only]
inline constexpr std::size_t triangles_a_part = 1 << 14;
/// Parts. Below, each process that makes the patch looks at all of them: it would wait longer for the others. [time only]
inline constexpr std::size_t least_shared_parts = 8;

// Steep places of space (steep_places)
/// Steps. Of Gauss and Newton from the nearest point of the mesh to that of the surface; they are of second order.
/// [SteepPlaces.SpotsOfABackgroundInSpaceAreMeshed]
inline constexpr int most_steps = 8;
/// Share of a place's reach. Shorter steps are the last. [as above]
inline constexpr double last_step = 1e-3;
/// sin^2 of the angle between the derivatives, below which there is no step. [rounding]
inline constexpr double no_step = 1e-12;

// Agreement (surface_agreement)
/// Share of the area. What exceeds that of the surface is told from here on; unit meshes by curvature have some 1e-4.
/// [surface: AgreementBesideChords]
inline constexpr double notable_area = 0.05;
/// Cosine of a triangle's normal and that of what it stands for: 85 degrees, as for triangles that are divided
/// (surface/improve). [surface: AgreementBesideChords.AreNotDividedForEver]
inline constexpr double least_agreement = 0.08;
/// Parts along each side in which a triangle of (u, v) is looked at. [surface: SurfaceAgreement]
inline constexpr int parts = 4;

}  // namespace carreau::thresholds::lift
