// SPDX-License-Identifier: BSD-3-Clause
// After assembly: edges along which sizes that differ by direction change too much.
#pragma once

#include "surface/result.h"

namespace carreau {

/// Of the sizes along an edge's chord at its ends no one exceeds the other by more than gradation^length, and this.
inline constexpr double tolerated_gradation = 1.02;

/// Looks for edges inside faces whose sizes along their chords, by the control spaces, differ by more than the factor
/// `limit` for each unit of their length, and moves their ends, or swaps them, where that mends it: where directions
/// turn, few edges of a place do. Vertices and edges on curves stay, and so does the number of triangles. Nothing is
/// done that would leave a triangle worse in the metric than 0.5 and worse than those before, more edges out of [1/sqrt
/// 2, sqrt 2] (at last, of [0.5, 1.6]), or one that exceeds `kept`. Costs an evaluation of the surface a vertex, and
/// some dozens for each edge that is mended. Keeps vertex_size up to date. For sizes that differ by direction: others
/// obey.
void even_out_sizes(double limit, const GeometricLimits& kept, const SizeRules& rules, Cad& cad,
                    CompositeResult& result, Monitor& monitor);

}  // namespace carreau
