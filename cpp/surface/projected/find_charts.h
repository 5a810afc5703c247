// SPDX-License-Identifier: BSD-3-Clause
// Cuts the regions between sharp lines into charts: pieces that a projection shows without folds.
#pragma once

#include <cstdint>
#include <vector>

#include "support/monitor.h"
#include "surface/projected/flat_atlas.h"

namespace carreau {

struct ProjectedCharts {
  std::vector<std::int32_t> chart;  ///< by triangle of the atlas
  std::vector<Vec3> axis;           ///< by chart: of its projection, unit
  std::vector<char> exact;  ///< by triangle: borders of its chart are edges of the atlas, not those that sizes want,
                            ///< which would cross: 1: cut by the sizes, where they are long; 2: as they are
  std::vector<char> kept;   ///< by triangle: its chart is not meshed, its triangles stay as they are
};

/// Each chart is connected, and its normals lean against its axis by no more than `loose_cosine` allows. Triangles that
/// lean more are kept.
ProjectedCharts find_charts(const FlatAtlas& atlas, Monitor& monitor);

/// Makes kept charts of the triangles that `which` marks, one each. Whether any was not kept before.
bool keep_triangles(const FlatAtlas& atlas, const std::vector<char>& which, ProjectedCharts& charts);

/// Cuts those in two between their ends, where they have two triangles. Whether any was.
bool split_charts(const FlatAtlas& atlas, const std::vector<char>& which, ProjectedCharts& charts, Monitor& monitor);

/// Joins charts that one axis shows, the smallest first: no normal leans more than `cosine` tells. `which`: those that
/// are to join another one, by chart; empty: all.
void merge_charts(const FlatAtlas& atlas, double cosine, std::vector<char> which, ProjectedCharts& charts,
                  Monitor& monitor);

}  // namespace carreau
