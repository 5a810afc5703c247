// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room, with their units, their reasons and the tests that support them.
// tests/cpp/geometry/discrete/projected_meshes_test and tests/cpp/surface/remesh/sheets_test rest on them.
#pragma once

#include <cstddef>

namespace carreau::thresholds::planes {

// Charts (find_charts). Cosines of the angle between normals and the axis of projection.
/// Charts grow up to this lean: the metric of the plane has a ratio of 1.6 there, and half a dozen charts cover a
/// sphere.
inline constexpr double usual_cosine = 0.55;
/// Neighbours become one chart if all normals lean less.
inline constexpr double merge_cosine = 0.42;
/// Largest value of ProjectedCharts::exact: 1 divides borders of edges of the atlas, 2 leaves them if their parts would cross, too.
inline constexpr char max_exact = 2;
/// Share of the triangles of the atlas that may be kept. Beyond, local remeshing of the whole mesh is as cheap. For
/// scans it is below .15.
inline constexpr double max_kept = 0.25;
/// Triangles left between charts may lean so far: a ratio of 3.
inline constexpr double loose_cosine = 0.3;
/// The search ignores triangles that lean more: there the projection turns over soon.
inline constexpr double min_cosine = 0.15;
/// Triangles: smaller pieces that are left between charts join one of them.
inline constexpr int small_piece = 16;
/// Times that charts are grown again from their middles, which makes their borders short.
inline constexpr int regrowths = 2;
/// Penalty on a path where normals differ from the axis, for each unit of 1 - cosine.
inline constexpr double price_of_leaning = 3;

// Cuts between charts
/// Sweeps that straighten a cut, and sweeps after the redistribution of its vertices.
inline constexpr int sweeps = 12, last_sweeps = 3;

// Meshes of charts
/// Cosine: if all normals of a chart are as near, the metric of the plane serves for the chart. Lengths are off by 1 %
/// at most.
inline constexpr double flat_cosine = 0.99;
/// Control space of a chart with one size: error of lengths, samples a vertex, least number of samples. More accuracy
/// is useless, since the normals of the chart's triangles are as inaccurate.
inline constexpr double length_tolerance = 0.03, samples_per_vertex = 0.3;
inline constexpr std::size_t least_samples = 40;
/// Share of the size. A vertex is lifted again if its lifted place is farther from its place in the plane.
inline constexpr double max_miss = 0.05;
/// Largest number of cells of the raster of a chart, and of triangles on a straight way to a place: one cell may contain many needles.
/// [ProjectedMeshes.FansOfNeedlesAreNotFolded]
inline constexpr int max_cells = 1 << 20;
/// Rings of triangles beyond the border of a chart in its raster: cuts are straightened.
inline constexpr int rings_beyond = 2;

}  // namespace carreau::thresholds::planes
