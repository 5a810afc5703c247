// SPDX-License-Identifier: BSD-3-Clause
// After assembly: neighbouring edges and sizes that differ by more than the gradation allows.
#pragma once

#include "surface/result.h"

namespace carreau {

/// Lengths of edges at a vertex differ by the gradation times this factor at most.
inline constexpr double adjacent_lengths = 1.6;
/// Sizes along the chord of an edge at its ends differ by gradation^length times this factor at most.
inline constexpr double tolerated_gradation = 1.02;

/// Improves vertices whose longest edge is more than `limit` times as long as the shortest edge (in space, over all
/// faces). It moves vertices inside faces, swaps edges, and at last divides edges. Requires sizes that are the same in
/// all directions. Vertices and edges on curves stay. A change leaves only triangles that are well-shaped or better
/// than before. The number of edges that are too long or too short for the sizes does not rise. Most meshes stay as
/// they are, without a call. Keeps vertex_size up to date. If `kept` has any limit, no change leaves a triangle that exceeds it.
///
/// The slope of sizes may jump. Then the best mesh in the metric may have a long edge on one side of a vertex and a
/// short edge on the other side. Gradation makes such kinks (HDR fig. 1.6).
void even_out_lengths(double limit, const GeometricLimits& kept, const SizeRules& rules, Cad& cad, CompositeResult& result,
                      Monitor& monitor);

/// Improves edges inside faces whose sizes along their chords differ by more than the factor `limit` for each unit of
/// their length, by the control spaces. Moves vertices or swaps edges on the same terms, for sizes that differ by
/// direction. If directions turn, few edges of a place keep the gradation. The number of triangles stays. No change
/// leaves a triangle worse in the metric than 0.5 and worse than before, or a triangle that exceeds `kept`. No change
/// leaves more edges out of [1/sqrt 2, sqrt 2] (at last, of [0.5, 1.6]). Costs an evaluation of the surface for each
/// vertex, and some dozens for each edge that is improved.
void even_out_sizes(double limit, const GeometricLimits& kept, const SizeRules& rules, Cad& cad,
                    CompositeResult& result, Monitor& monitor);

}  // namespace carreau
