// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room: what they are, in which unit, why, and what supports them.
#pragma once

#include <cstddef>

namespace carreau::thresholds::grade {

// Supported by tests/cpp/surface/grade/gradation_test where nothing else is said.

// The graph
/// Prescribed sizes. Those that the graph is made with: distances on it are exact on coarse triangles too, and a mesh
/// of so many vertices costs a quarter of the evaluations.
inline constexpr double graph_factor = 2;
/// Of diag. Longest edges of the graph, where sizes are large.
inline constexpr double graph_share = 1. / 20;
/// Of a length. That of its control spaces: sizes and positions are asked at its vertices again.
inline constexpr double graph_tolerance = 0.1;
/// Cosine of normals that differ by rounding.
inline constexpr double parallel = 1 - 1e-9;

// What obeys
/// Of a size. Prescribed sizes are smooth where they are what linear interpolation in the graph promises, up to this.
inline constexpr double roughness = 0.01;
/// Of a size by direction. The same of samples, which are below the means of three metrics where directions turn.
inline constexpr double rough_metric = 0.1;
/// Of a size along a curve: what interpolation between its samples may be wrong by.
inline constexpr double interpolation_error = 0.02;
/// Size minima of a face that its control space is told of; each costs samples.
inline constexpr std::size_t most_size_minima = 50;

// Curves
/// Samples of a curve's sizes on each of its edges in the graph.
inline constexpr int samples_per_edge = 4;
/// Of an edge. Samples nearer to each other are one.
inline constexpr double one_sample = 1e-6;

// Rounds
/// Unit edges of the graded sizes. The graph is too coarse where an edge is longer.
inline constexpr double too_long = 3.2;
/// Graphs made, each with the sizes of the one before: three are enough for all fields seen.
inline constexpr int most_rounds = 5;
/// Edges a triangle that may be too long after the first round.
inline constexpr double few_edges = 0.01;
/// Of the triangles. A graph that changes less is the same, and its long edges stay.
inline constexpr double same_graph = 0.1;

}  // namespace carreau::thresholds::grade
