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
/// Share of a length. Tolerance of its control spaces: sizes and positions are evaluated at its vertices again. [9, 9]
inline constexpr double graph_tolerance = 0.1;

// Sizes that obey
/// Share of a size. Largest difference between smooth prescribed sizes and linear interpolation in the graph. [1, 1]
inline constexpr double roughness = 0.01;
/// Share of a size by direction. Largest difference for samples, which lie below the means of three metrics where
/// directions turn. [0, 1]
inline constexpr double rough_metric = 0.1;
/// Share of a size along a curve. Error of the interpolation between its samples. [2, 0]
inline constexpr double interpolation_error = 0.02;

// Curves
/// Samples of a curve's sizes on each of its edges in the graph. [11, 11]
inline constexpr int samples_per_edge = 4;

// Rounds
/// Unit edges of the graded sizes. The graph is too coarse if an edge is longer. [4, 8]
inline constexpr double too_long = 3.2;
/// Graphs, each with the sizes of the previous graph. [0, 2]
inline constexpr int max_rounds = 5;
/// Edges a triangle that may be too long after the first round. [0, 2]
inline constexpr double few_edges = 0.01;
/// Share of the triangles. A graph that changes less is the same, and its long edges stay. [0, 0; without it
/// bottle.brep by direction takes another round]
inline constexpr double same_graph = 0.1;

}  // namespace carreau::thresholds::grade
