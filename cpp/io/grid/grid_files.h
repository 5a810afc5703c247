// SPDX-License-Identifier: BSD-3-Clause
// Readers of structured grids: PLOT3D, heights, cylindrical scans, lists of nodes.
#pragma once

#include <string>
#include <string_view>

#include "geometry/grid/grid.h"

namespace carreau {

enum class GridFormat {
  by_suffix,  ///< .fmt .p3d .x .grd .xyz: PLOT3D; .asc .dem .txt: heights; .cyl: a scan; .ijk: nodes
  plot3d,
  heights,
  scan,
  nodes
};

/// Throws FileError, with file and line or byte and the block: no such file or format, an invalid number, counts that
/// do not fit, a binary file in place of text. `step` is the step of heights and scans whose file does not contain it.
grid::Grid read_grid(const std::string& path, GridFormat format = GridFormat::by_suffix, double step = 1);

// The readers below take contents; `name` is for messages.

/// PLOT3D in text or binary: one block (three counts) or several (their number, three counts each). One of the three counts is 1, or the
/// block is a volume: its sides are the blocks, except sides that two volumes share. Then each block has all x, all y, all z and, if there
/// are that many numbers, an IBLANK for each node: 0 is a missing one. Binary files have Fortran records or none, either byte order and
/// either precision; the reader takes the form that fits the size of the file.
grid::Grid read_plot3d(std::string_view content, const std::string& name);
grid::Grid read_plot3d_text(std::string_view text, const std::string& name);
grid::Grid read_plot3d_binary(std::string_view bytes, const std::string& name);

/// Heights over a regular grid: ASCII grids of ESRI (`ncols`, `nrows`, `xllcorner` or `xllcenter`, `cellsize`,
/// `NODATA_value`, rows from the north), the DEM of USGS, or plain text. Plain text has rows of numbers from y = 0 up,
/// all of one length, with or without a first line `columns rows [dx [dy [x y]]]`. NaN: missing.
grid::Grid read_heights(std::string_view text, const std::string& name, double step = 1);
grid::Grid read_usgs_dem(std::string_view text, const std::string& name);

/// Distances r(z, theta) from the axis z. First line `angles heights [dz [z]]`, then for each height, from below, a
/// distance for each of the angles 2 pi k / angles. NaN: missing. The grid is closed.
grid::Grid read_scan(std::string_view text, const std::string& name, double step = 1);

/// Lines `i j x y z` or `block i j x y z`, in any order; indices count from the least that is there. Nodes that no line
/// has are missing.
grid::Grid read_nodes(std::string_view text, const std::string& name);

}  // namespace carreau
