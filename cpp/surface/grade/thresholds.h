// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room: unit, reason, support.
#pragma once

namespace carreau::thresholds::grade {

// Brackets give the number of 15 meshes that change if the value is doubled and halved. The meshes are STEP files, the teapot, formulas and
// size maps; graded, by direction, with proximity. tests/cpp/surface/grade/gradation_test rests on all of them.

// The graph
/// Prescribed sizes. Sizes of the graph: distances on it are exact on coarse triangles, and its mesh costs a quarter of
/// the evaluations. [10, 10]
inline constexpr double graph_factor = 2;
/// Of diag. Longest edges of the graph. [11, 11]
inline constexpr double graph_share = 1. / 20;

// Curves
/// Samples of a curve's sizes on each of its edges in the graph. [11, 11]
inline constexpr int samples_per_edge = 4;

// Rounds
/// Unit edges of the graded sizes. The graph is too coarse if an edge is longer. [4, 8]
inline constexpr double too_long = 3.2;

}  // namespace carreau::thresholds::grade
