// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room, with their meaning, unit, reason and support.
#pragma once

namespace carreau::thresholds::embedding {

// In brackets: the tests of the threshold, in tests/cpp/embedding.

/// Share of the diagonal. A span of an embedded curve leaves the projection of its chord by at most this. [Embedding.GreatCircle]
inline constexpr double accuracy = 1e-8;
/// Share of the diagonal. Bisection of a chord ends here: the projection jumps to another face, or across a seam.
inline constexpr double jump = 1e-10;
/// Share of the diagonal. Places that are nearer are one: ends of pieces, crossings, points and curves of the model.
inline constexpr double same_place = 1e-7;
/// Degrees. A polyline that turns more at a vertex has a corner there. [Embedding.CornersBecomePoints]
inline constexpr double corner = 15;
/// Share of the diagonal. Chords of a wire leave it by at most this.
inline constexpr double chord_of_wire = 1e-5;
/// Number of times that a chord is divided: of a wire, and at a curve between two faces.
inline constexpr int divisions = 9;
/// Number. A curve is searched for its closest point from so many samples.
inline constexpr int samples_of_curve = 65;

}  // namespace carreau::thresholds::embedding
