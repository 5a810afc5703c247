// SPDX-License-Identifier: BSD-3-Clause
// Parameters of the rows and columns of grids.
#pragma once

#include <vector>

#include "geometry/grid/borders.h"

namespace carreau::grid {

struct Knots {
  std::vector<double> u, v;  ///< ascending, from 0
};

/// [block]: the integers, or cumulated lengths. An interval between two columns has the mean length of the edges across
/// it (HDR sec. 4.7.3). Intervals of blocks that have a border edge in common have one length, the mean of all edges of
/// both. So both blocks have the same curve along it.
std::vector<Knots> find_knots(const std::vector<Block>& blocks, const Borders& borders, bool lengths);

}  // namespace carreau::grid
