// SPDX-License-Identifier: BSD-3-Clause
// Cuts the regions between sharp lines into charts: pieces that a projection shows without folds.
#pragma once

#include <cstdint>
#include <vector>

#include "support/monitor.h"
#include "surface/remesh/planes/flat_atlas.h"

namespace carreau {

struct ProjectedCharts {
  std::vector<std::int32_t> chart;  ///< by triangle of the atlas
  std::vector<Vec3> axis;           ///< by chart: of its projection, unit
  std::vector<char> exact;  ///< by triangle: borders of its chart are edges of the atlas, since cuts by the sizes would cross. 1: long
                            ///< edges are cut by the sizes; 2: edges stay as they are
  std::vector<char> kept;   ///< by triangle: its chart is not meshed, its triangles stay as they are
};

/// Each chart is connected, and its normals lean against its axis by no more than `loose_cosine` allows. Triangles that
/// lean more are kept.
ProjectedCharts find_charts(const FlatAtlas& atlas, Monitor& monitor);

/// Makes kept charts of the triangles that `which` marks, one each. Returns whether a triangle was not kept before.
bool keep_triangles(const FlatAtlas& atlas, const std::vector<char>& which, ProjectedCharts& charts);

/// Cuts charts in two between their ends, if they have two triangles. Returns whether a chart was cut.
bool split_charts(const FlatAtlas& atlas, const std::vector<char>& which, ProjectedCharts& charts, Monitor& monitor);

/// Joins charts that one axis shows, the smallest first: the cosine of normals and axis is at least `cosine`. `which`:
/// the charts to join to a neighbour, by chart; empty: all.
void merge_charts(const FlatAtlas& atlas, double cosine, std::vector<char> which, ProjectedCharts& charts,
                  Monitor& monitor);

}  // namespace carreau
