// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room, with their units, their reasons and the tests that support them.
#pragma once

#include <cstddef>

namespace carreau::thresholds::lift {

// Brackets name the tests that rest on a threshold, by default tests of tests/cpp/surface/lift.

// True lengths (verification)
/// True length over promised length. An arc of 150 degrees is 1.36 times its chord.
/// [Verification.BumpsThatNoSampleHitsAreMeshedAtTheirSize]
inline constexpr double too_long = 1.3;
/// True length over promised length. Limit for a mesh that is much too fine.
/// [Verification.SampledDetailsCostNothing]
inline constexpr double too_short = 0.65;
/// True length over promised length. Such edges are examined for jumps; a surface that is continuous between their ends
/// has none. [surface: BadModels.SurfaceThatJumpsByAFewEdges]
inline constexpr double excess = 8;
/// Places. Examined in one face, spread over all of them: more places cost more without new information. [surface:
/// BadModels. SurfaceThatJumpsInManyPlaces]
inline constexpr std::size_t max_places = 500;

// Agreement (surface_agreement)
/// Share of the area. A larger excess over the surface's area is reported; unit meshes by curvature have some 1e-4.
/// [surface: AgreementBesideChords]
inline constexpr double notable_area = 0.05;
/// Parts along each side into which a triangle of (u, v) is divided for the test. [surface: SurfaceAgreement]
inline constexpr int parts = 4;

}  // namespace carreau::thresholds::lift
