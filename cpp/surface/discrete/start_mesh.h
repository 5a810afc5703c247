// SPDX-License-Identifier: BSD-3-Clause
// Triangles of a discrete surface as a mesh of the engine, fine enough for the prescribed sizes.
#pragma once

#include <numbers>

#include "surface/discrete/discrete_sizes.h"
#include "surface/remesh/frame.h"
#include "surface/result.h"

namespace carreau {

/// Cuts triangles until edges are short enough for their sizes: edges of sharp lines at most 1 size, others at most
/// sqrt(2) sizes. Throws LimitError when there would be too many. `longest_of_lines`, `longest` replace these limits.
discrete::RefinedMesh refine_by_sizes(const discrete::DiscreteSurface& surface, const DiscreteSizes& sizes,
                                      const CompositeOptions& options, Monitor& monitor, double longest = std::numbers::sqrt2,
                                      double longest_of_lines = 1);

/// Each triangle has (u, v) on the tile of its patch; curves are the sharp lines. Faces as in the model.
SurfaceMesh start_mesh(const Model& model, const discrete::DiscreteCad& surface, const discrete::RefinedMesh& refined);

/// RemeshingFrame::angle_slack.
double angle_slack_of(const CompositeOptions& options);

/// Keeps references to `mesh` and `cad` until the frame is done with. `refined`: the triangles that `mesh` was made of; `sizes`: on it.
RemeshingFrame start_frame(const discrete::DiscreteCad& surface, const discrete::RefinedMesh& refined,
                           const SurfaceMesh& mesh, const MeshSizes& sizes, const CompositeOptions& options, Cad& cad,
                           Monitor& monitor);

}  // namespace carreau
