// SPDX-License-Identifier: BSD-3-Clause
// The C1 or C2 surface through the nodes of each block, and common data of blocks on their borders.
#pragma once

#include <vector>

#include "geometry/grid/borders.h"
#include "geometry/grid/coons_surface.h"
#include "geometry/grid/parameters.h"
#include "geometry/grid/smoothing.h"

namespace carreau::grid {

/// A surface for each block. The derivative along a common border is equal in all its blocks, the best of them, so that
/// the border is one curve. If `join_angle` (radians) is positive and the normals of two blocks differ by less all
/// along a chain, derivatives across it are central differences over both blocks, or the mean of both splines. Their
/// normals then agree; `joined` counts such chains.
std::vector<CoonsSurface> interpolate(const std::vector<Block>& blocks, const Borders& borders,
                                      const std::vector<Knots>& knots, const std::vector<Closed>& closed,
                                      const Options& options, std::size_t* joined = nullptr);

}  // namespace carreau::grid
