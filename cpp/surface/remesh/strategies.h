// SPDX-License-Identifier: BSD-3-Clause
// Remeshing of a frame by the strategies of one list, until a mesh is accepted.
#pragma once

#include <span>
#include <string>

#include "surface/remesh/frame.h"

namespace carreau {

/// Shapes of the input mesh that a strategy keeps.
enum class KeptShapes : char {
  none,
  worst,           ///< no triangle becomes worse than the worst triangle
  worst_and_mean,  ///< and each edit spends no more shape than earlier edits have gained
};

/// Weights of lengths against shapes where the two conflict (ShapeBudget).
struct Strategy {
  double price;       ///< of an edge that comes into range where triangles span lines; it grows while shapes are kept
  bool weighs_moves;  ///< moves of vertices along lines have the price, too; otherwise they only make lengths even
  KeptShapes kept;    ///< if the mean is kept, collapses inside have the price, too
};

/// The strategies in their order. `triangles_pass`: shapes of the input mesh do not count, since no mesher made it or since its triangles
/// become other elements.
std::span<const Strategy> strategies(bool triangles_pass, double sharp_angle) noexcept;

/// Remeshes the mesh of `result` by CompositeResult::vertex_size: lengths, shapes, references, curves and (u, v) of its corners. Returns
/// the reason why no strategy was accepted; empty: the mesh is replaced.
std::string remesh_by_strategies(RemeshingFrame& frame, Cad& cad, const CompositeOptions& options, CompositeResult& result,
                                 Monitor& monitor);

/// Takes the mesh of frame.made, and remeshes around its seams; everywhere, if the mean of its shapes is below `min_mean`. Returns the
/// reason why the mesh was not accepted; empty: the mesh is replaced.
std::string remesh_from_planes(RemeshingFrame& frame, double min_mean, Cad& cad, const CompositeOptions& options,
                               CompositeResult& result, Monitor& monitor);

/// Keeps the triangles: only frame.elements changes them.
void make_elements_of_frame(RemeshingFrame& frame, Cad& cad, const CompositeOptions& options, CompositeResult& result,
                            Monitor& monitor);

}  // namespace carreau
