// SPDX-License-Identifier: BSD-3-Clause
// Measures of layers along curves.
#pragma once

#include <vector>

#include "mesh/layer_cell.h"
#include "mesh/surface_mesh.h"

namespace carreau {

/// The rows of one set of layers, over all faces. The height of a cell is its area over the mean of its two edges along
/// the row. Triangles at corners of curves count for cells and rows only.
struct LayerFigures {
  std::int64_t cells = 0;
  int rows = 0;        ///< the largest number above each other
  int fewest_rows = 0;  ///< the smallest number above an edge of the curve
  double first_min = 0, first_mean = 0, first_max = 0;     ///< heights of cells in the first row, model length
  double growth_min = 0, growth_mean = 0, growth_max = 0;  ///< heights of cells over the heights of cells below; 0: one row
};

/// Measures the cells that lie in `layers` (by face), whose indices are below `count`.
std::vector<LayerFigures> measure_layers(const SurfaceMesh& mesh, const std::vector<std::vector<LayerCell>>& layers,
                                         std::size_t count);

}  // namespace carreau
