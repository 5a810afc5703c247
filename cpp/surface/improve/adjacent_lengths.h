// SPDX-License-Identifier: BSD-3-Clause
// After assembly: edges that meet at a vertex and differ too much in length.
#pragma once

#include "surface/result.h"

namespace carreau {

/// Lengths of edges at a vertex differ by what the gradation allows, and as much again as this.
inline constexpr double adjacent_lengths = 1.6;

/// Looks for vertices whose longest edge is more than `limit` times as long as the shortest one (in space, over all
/// faces), and moves vertices inside faces, swaps edges or divides one of them where that mends it. Sizes are to be the
/// same in all directions. Vertices and edges on curves stay. Nothing is done that would leave a triangle worse than
/// well-shaped and worse than those before, or more edges that are too long or too short for the sizes. Most meshes are
/// left as they are, without a call. Keeps vertex_size up to date.
///
/// Where the slope of sizes changes at once (HDR fig. 1.6: gradation makes such kinks), what is best in the metric may
/// be a long edge on one side of a vertex and a short one on the other.
void even_out_lengths(double limit, const SizeRules& rules, Cad& cad, CompositeResult& result, Monitor& monitor);

}  // namespace carreau
