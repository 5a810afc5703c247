// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room, with their units, their reasons and the tests that support them.
#pragma once

namespace carreau::thresholds::refine {

// Brackets name the tests that rest on a threshold, by default tests of tests/cpp/surface/refine.

// Crossings and balance (boundary_refinement)
/// Rounds. Around a true crossing the edges that cross become shorter with every halving, and curves that only come
/// near each other stop crossing. If this number of halvings changes nothing, the curves lie on each other, and would
/// be cut for ever. [Refinement.CurvesThatLieOnEachOtherAreNotCutForEverNorForTheNeighbour]
inline constexpr int max_fruitless_halvings = 6;
/// Share of the length that crossed before. A halving without effect leaves more. [as above]
inline constexpr double fruitless_share = 0.75;
/// Ratio. Assumed ratio of lengths in the metric of a curved surface to straight distances in space.
/// [Refinement.BordersWithTheOutsideBetweenThemAreNoNarrowZone]
inline constexpr double straight_reserve = 2;
/// Ratio of lengths. From here on the balance of edges is checked in the metric, whose chords differ from the curves'
/// lengths; there it may be 2. [Refinement.BalanceOfEdgesAtACornerEndsWhereverMetricsTurn]
inline constexpr double balance_to_look_at = 1.6;

// Strips without neighbours (face_closeness)
/// CoefRectangle there: edges of 1.4 to 2.9 widths, whose triangles have a Q2 of .98 to .70. Strips have a smaller mean
/// width, in sizes: wider faces are narrow in places alone, where short edges leave bad triangles beside them.
/// [Refinement.StripsWithoutNeighboursAreCutToTheirWidth]
inline constexpr double coefficient_alone = 0.35;

// Staggering
/// Edges. Sides farther apart leave place for a row of vertices between them. [Staggering.WideFacesAndSharpCorners...]
inline constexpr double widest = 1.2;
/// Segments. Halves at both ends of shorter curves would be most of them. [Staggering.RingsToo]
inline constexpr int fewest_segments = 3;
/// Sum of qualities. Least gain of a curve: the half edges at its ends cost as much in the faces beside it.
/// [Staggering.StripsAreOfIsoscelesTriangles]
inline constexpr double min_curve_gain = 1;
/// Share of the worst quality, below which it must not fall, whatever the gain elsewhere. If vertices come to lie on
/// the chords of arcs that bulge across the strip, triangles become flat. [Staggering.RingsToo]
inline constexpr double largest_fall = 0.5;
/// Cosine of an angle. At a sharper corner a half edge beside a whole edge leaves a triangle worse than 0.75 (Q2; 0.95
/// between two whole edges). [Staggering.WideFacesAndSharpCornersStayAsTheyAre]
inline constexpr double sharp_cosine = 0.6;

}  // namespace carreau::thresholds::refine
