// SPDX-License-Identifier: BSD-3-Clause
// Meshes of surfaces given as triangles, against what was asked.
#pragma once

#include "geometry/discrete/discrete_cad.h"
#include "measure/mesh_evaluation.h"
#include "surface/options.h"
#include "surface/result.h"

namespace carreau {

/// What mesh_discrete() delivered, against the sizes that governed it: linear in the triangles of the atlas.
MeshEvaluation evaluate_discrete(const discrete::DiscreteCad& surface, Cad& cad, const CompositeOptions& options,
                                 const CompositeResult& result, Monitor& monitor);

/// The distances between a mesh of straight triangles and those that the surface was given, both ways, are added; other
/// elements have none. Throws Cancelled.
void bound_input_distances(const discrete::DiscreteSurface& surface, const SurfaceMesh& mesh, int threads,
                           Monitor& monitor, MeshEvaluation& delivered);

}  // namespace carreau
