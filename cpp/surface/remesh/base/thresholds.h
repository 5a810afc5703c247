// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room, with their units, their reasons and the tests that support them.
// All of tests/cpp/surface/remesh rests on them: sharp_edges_test, independent_test, divided_remeshing_test and by_direction_test.
#pragma once

#include <array>

namespace carreau::thresholds::remesh {

// Walks in the atlas (charts)
/// Triangles that a straight way may lead through; vertices move by an edge or so.
inline constexpr int max_steps = 200;
/// Gauss-Newton steps, including steps that end on a border. [8: meshes across patches of bottle.brep and frame.step change]
inline constexpr int max_newton_steps = 6;
/// Factor. Longer steps towards a place would leave the range of its derivatives.
inline constexpr double max_relaxation = 4;
/// Share of the way. The remainder along the surface: the result need not be the closest point of the target, since the
/// place itself is judged.
inline constexpr double near_enough = 0.3;

// Sharp edges (sharp_edges)
/// Degrees, added to the angle between tangents of curves that meet: supports have this accuracy.
inline constexpr double support_angle = 2;

// Edits (remeshing). Lengths are in the prescribed metric, shapes are Q2.
// Lines (line_remeshing)
/// Rounds of remeshing lines and then the mesh between them.
inline constexpr int max_line_rounds = 3;
/// Sweeps that even out the lengths of a line.
inline constexpr int line_sweeps = 6;

/// Shorter edges are collapsed where triangles are small, too. An edge of a fine mesh would become too long, but the
/// following moves distribute its length.
inline constexpr double short_when_dense = 0.95;
/// Area of unit equilateral triangles. The mean area that triangles around such an edge may have afterwards.
inline constexpr double max_mean_area = 1.02;
/// Shape that such a collapse may leave.
inline constexpr double min_shape_when_dense = 0.35;
/// Times that edges of a coarse mesh are halved in everywhere-remeshing.
inline constexpr int halvings = 2;
/// Lengths. Edges between middles of edges have about unit length, edges from a middle to the corner opposite about sqrt(3).
inline constexpr double longest_of_halves = 1.2;
/// No edit makes a longer edge, and no swap of the certification a longer edge from shorter ones.
inline constexpr double never_longer = 1.8;
/// Rounds of collapses, splits, swaps and moves.
inline constexpr int max_rounds = 8;
/// Passes of swaps and moves after them, if thorough; else as many as rounds.
inline constexpr int max_last_passes_thorough = 20;
/// Shape that a collapse or split, and an edit of a line, may leave where shapes were better: swaps and moves follow. [lines: with .05 the worst
/// triangle of frame.step falls from .139 to .06, with .3 short lines of bottle.brep stay]
inline constexpr double min_shape = 0.15;
/// Shape that the halving of an edge may leave that untangles triangles: swaps and moves follow.
inline constexpr double flat_shape = 0.02;
/// Shape. Remeshing works at triangles below, with two rings around.
inline constexpr double good_enough = 0.7;
/// Shape of the triangles of a square, whose diagonals are alike. If both triangles of an edge are better, the triangles of the other
/// diagonal are worse.
inline constexpr double shape_of_squares = 0.87;
/// Shape that a swap for the sake of degrees may leave, and rounds that have such swaps.
inline constexpr double min_shape_of_degrees = 0.55;
inline constexpr int max_rounds_of_degrees = 4;
/// Share of the size. Shorter moves are not worth an evaluation.
inline constexpr double min_move = 0.02, min_move_thorough = 0.01;
/// Shape. Gains below do not count.
inline constexpr double min_gain = 1e-4;

// Parts (division)
/// Triangles, among the triangles to remesh.
inline constexpr double min_divided = 65536, triangles_of_part = 16384;
/// Edges. Distance around cuts that is remeshed, and distance around a bad triangle at which work starts.
inline constexpr int rings_of_zone = 8, rings_at_work = 2;

// The worst triangles at the end (worst_first)
/// Passes over triangles that are worse than the worst one of the previous mesh.
inline constexpr int max_worst_passes = 6;
/// Directions of each step.
inline constexpr int worst_directions = 8;
/// Shape. In meshes from parametric remeshing worse triangles are improved.
inline constexpr double good_worst = 0.6;
/// Shape. Triangles so little above the worst triangle of the previous mesh are improved, too.
inline constexpr double above_worst = 0.03;

// Loss of shapes by collapses (collapse_price)
/// Shape of a triangle whose removal is not a loss: about the mean of a mesh. Edits of the certification do not lower a better mean below
/// this: in a coarse mesh a few edits are a large part.
inline constexpr double good_shape = 0.95;
/// Sum of differences of shapes that one more edge in range may cost, if no mesher made the input.
inline constexpr double high_price = 1;
/// The sum for meshes made patch by patch, and its growth each time that lines were remeshed while the mean is kept. The cheapest edits
/// come first.
inline constexpr double low_price = 0.2, price_growth = 3;
/// Shape. If the mean has fallen by less, smoothing recovers it (regained_below). A strategy is given up if it has fallen by twice as much
/// after the first round. [frame.step at 5 and 2 %, M6 screw at 5 %: .019 to .084; later rounds change it by less than .001]
inline constexpr double max_regained = 0.004;
/// Shapes. Recovery of the mean works at triangles below, at first below the first value.
inline constexpr std::array<double, 2> regained_below{0.9, 0.98};
/// Share of the sides of triangles. If more sides would come into range without kept shapes, shapes are not kept: patches that are small
/// and well shaped would stay. On the M6 screw and frame.step at a size of 5 % it is .21 and .20.
inline constexpr double max_range_for_shapes = 0.3;
/// Degrees. With a larger sharp_angle features are to vanish, and shapes carry no penalty.
inline constexpr double max_angle_of_price = 5;

// Triangles in (u, v) (reassembly)
/// Share of an edge in space. If the image of the edge by derivatives in (u, v) differs more, the corners do not belong
/// to one chart.
inline constexpr double max_distortion = 0.7;

// Agreement with the surface
/// Degrees: A1 where no geometric rule governs. A triangle of unit length on a sphere of this radius has this angle.
inline constexpr double usual_angle = 52;
/// Factor on squares of angles and distances beside triangles that crossed others in a previous strategy: as if
/// tolerances were a hundred times smaller.
inline constexpr double guarded_factor = 1e4;
/// Ratio of sizes in two directions. If all ratios of a model are below, sizes count as isotropic: control spaces have this accuracy.
inline constexpr double min_anisotropy = 1.05;
/// Degrees: A1 at least, where sizes differ by direction. Long edges of triangles that are shorter across let them lean
/// against the surface; patches bound it, too (pipeline/base/thresholds.h, max_lean: 26.6 degrees, and lengths vary).
inline constexpr double leaning_angle = 35;
/// Times that triangles beyond tolerances are edited, each time with the places of crossings guarded.
inline constexpr int max_certifications = 3;
/// Times that edges of triangles that cross are halved in a mesh from parametric remeshing.
inline constexpr int max_untanglings = 8;
/// Sizes around such a place that are guarded.
inline constexpr double guarded_sizes = 2;
/// Degrees. A larger sharp_angle does not let triangles stand upright.
inline constexpr double max_angle = 80;
/// Share of the size: A0 there.
inline constexpr double usual_deviation = 0.3;

}  // namespace carreau::thresholds::remesh
