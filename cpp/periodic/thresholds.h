// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of periodic faces: meaning, unit, reason, support.
#pragma once

namespace carreau::thresholds::periodic {

// In brackets: the tests of tests/cabi/periodic_test.cpp that rest on it.

// Closest points (closest)
/// Gauss-Newton steps; six suffice from a neighbour's parameters.
inline constexpr int max_steps = 40;
/// Rounds in which steps that are too long are halved.
inline constexpr int halved_steps = 30;
/// Ratio of distances. A step that ends this little farther away has reached rounding.
inline constexpr double overshoot = 1 + 1e-6;
/// Square of the sine between both tangents of a surface that is not degenerate.
inline constexpr double min_independence = 1e-24;

// Pairs (match_faces)
/// Share of the model's diagonal by which an image may miss its face. [FacesThatDoNotMatchAreReported]
inline constexpr double max_gap = 1e-4;
/// Share of a curve's length that its image may be away where lengths are known by polylines only.
inline constexpr double polyline_gap = 0.02;
/// Corners that are tried when a map is found by three of them.
inline constexpr int max_corners = 24;

/// Share of the extent of (u, v) by which an affine map of parameters may miss. Its guesses are good beginnings beyond that, too.
inline constexpr double affine_share = 1e-3;

/// Share of the gap. An image this near to its surface is taken as it is: the two differ by rounding.
inline constexpr double exact_images = 1e-9;

/// Share of the gap. Corners this near to the image of their partner, and vertices this near to a mirror plane, move there: files give places
/// with six digits at least.
inline constexpr double rounding_of_places = 1e-3;

// Curves (shared_curves)
/// Share of a curve's length. Vertices this near are one.
inline constexpr double same_fraction = 1e-9;

}  // namespace carreau::thresholds::periodic
