// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room, with their meaning, unit, reason and support.
#pragma once

#include <cstddef>
#include <cstdint>

namespace carreau::thresholds::control_space {

// In brackets: the tests of the threshold, in tests/cpp/control_space/control_space_test ("ControlSpace") and
// The first look at the field (survey)
/// Points. Asked on the boundary. [SmoothFields.AreReproducedFromFewSamples]
inline constexpr std::size_t max_border_points = 8;
/// Points. Samples inside, along each side of the box. [as above]
inline constexpr int inner_points = 3;
/// Points. Along each side of the box, to find the domain's share of it; no sample is taken. [Limits.AThinSliver...]
inline constexpr int share_points = 16;
/// Ratio. How far the cells may differ from squares of the metric where the field varies more in one direction.
/// [Limits. AspectRatiosUpToAMillionAreKept]
inline constexpr double max_stretch = 6;
/// Edges. Least length of the whole box in any direction: metrics are clamped where the parametrisation is degenerate
/// (HDR sec. 4.5.4), [Limits.DegenerateSidesAreClamped]
inline constexpr double min_box_length = 1e-2;

// The tree (tree, sampling)
/// Vertices. A cell of the first grid for so many, [samples: SmoothFields.AreReproducedFromFewSamples, as all below]
inline constexpr double usual_vertices_per_cell = 10;
/// Vertices. beyond which the number of cells grows with the square root only.
inline constexpr double many_vertices = 10'000;
/// Cells. Least number in the first grid.
inline constexpr double min_cells = 25;
/// Samples. Cost of a cell of a uniform grid: a node, its centre, its share of the border.
inline constexpr double samples_per_cell = 2.4;
/// Cells. Number along a side of the first grid.
inline constexpr int min_side = 3;
/// Vertices desired in a cell. A cell that holds so many times more is split without a test.
inline constexpr double crowded = 1.6;

// Errors (sampling)
/// Edges. Lengths of a cell below do not matter. [ControlSpace.ErrorsFollowTheTolerance, as all below]
inline constexpr double negligible_length = 0.03;
/// Tolerances. The error allowed where prediction is checked, of cells wider than an edge of the mesh, and than half an
/// edge; smaller cells may have the whole tolerance.
inline constexpr double allowed_edge = 0.5;
/// Edges. Smaller cells serve no purpose. [ControlSpace.SharpSizesAreFollowedDownToTheEdgesOfTheMesh]
inline constexpr double min_width = 0.25;
/// Edges. In cells at least so wide, errors above the tolerance are refined at any cost. Below, the tolerated error
/// grows with the inverse square of the width: an edge feels the mean along it, and few edges pass a small cell.
inline constexpr double plain_width = 2.5;
/// Ratio of sizes. From here on a field is sampled thoroughly: cells as wide as an edge is on the average are many of
/// the shortest edges wide. [ControlSpace.SizesMayVaryAThousandfold]
inline constexpr double much_stretched = 30;

// Budgets (sampling)
/// Samples. Cost of splitting a cell: usually, and at most (4 middles, 4 centres, 8 boundary vertices); cost of testing
/// it. [Limits.NoiseAndJumpsCostAtMostTheSamplesAllowed, as all below]
inline constexpr double usual_cost = 7;
/// Samples. Allowance beyond the samples for each vertex where errors are no larger than edges can show;
inline constexpr double spare_samples = 100;
/// Vertices. in a large mesh only so many count,
inline constexpr double vertices_that_count = 1500;
/// Samples, and samples a vertex. Limits where the tolerance is violated.
inline constexpr double max_spare_samples = 800, max_samples_per_vertex = 4;
/// Samples a vertex. Gradation leaves more kinks, and bounds each of them. [surface: GradedModel.
/// ControlSpacesObeyTheGradation]
inline constexpr double max_graded_samples_per_vertex = 6;

// Along borders (border, quadratic_fit)
/// Samples. Wanted before a quadratic is fitted, which has six coefficients. [QuadraticFit]
inline constexpr std::size_t enough_neighbours = 10;
/// Sizes. Reach of the neighbourhood, [ControlSpace.IsDefiniteEverywhereInTheBoxAndTakesTheNearestValueOutside, as
/// below]
inline constexpr double reach_in_sizes = 2.2;
/// Share of the reach, and squared reaches. and share from which the weights prefer near samples.
inline constexpr double near_share = 0.5, softness = 0.04;
/// Ratio. Eigenvalues of the fit over eigenvalues of its samples,
inline constexpr double max_extrapolation = 2;
/// Shares of the sum of weights. Regularisation of slopes and curvatures: has no effect if the samples determine the
/// polynomial, and pulls undetermined coefficients to zero. [QuadraticFit.AConstantComesBackFromSamplesOnALine]
inline constexpr double ridge_slope = 1e-6, ridge_curvature = 1e-4;

// Gradation of samples (sample_gradation)
/// Smaller changes by direction are rounding: far below the change by polynomials between the samples.
/// [BoundSlopesByDirection.GentleSizesStay]
inline constexpr double directed_rounding = 1e-4;

// Normals at samples (sampled_normals)
/// Samples. More do not extend the reach. [SampledNormals.ConvergeAtSecondOrder, as all below]
inline constexpr std::size_t max_normals = 16'384;
/// Ratio. Ratio from one reach to the next, if the samples are too few or on a line,
inline constexpr double reach_growth = 1.5;

// Polynomials (writer)
/// Steps. Number of steps in which a side or a cell is straightened. [as above]
inline constexpr int straightening_steps = 8;
/// Points. Number along each side of a cut leaf; they determine its part inside. [ControlSpace.MeasureIsTheArea...]
inline constexpr int cut_leaf_points = 4;

// Even grids (even_space)
/// Edges. Width of a cell, and least number of cells along a side. [EvenSpace, as below]
inline constexpr double even_cell = 1.25;
inline constexpr int min_even_side = 2;
/// Edges. Length of a side of the box, and squared edges: its area. In larger boxes the tree takes fewer samples.
inline constexpr double max_even_edges = 40, max_even_edges2 = 200;

// Undersampled regions
/// Vertices of a unit mesh. Smaller squares may contain none. [surface: Verification, as all below]
inline constexpr double crowd = 4;
/// Share of the vertices. A mesh whose edges are twice as long as prescribed has a quarter; if sizes change much within
/// an edge good meshes have half of them.
inline constexpr double min_share = 0.25;

}  // namespace carreau::thresholds::control_space
