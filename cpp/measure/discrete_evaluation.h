// SPDX-License-Identifier: BSD-3-Clause
// Compares meshes of surfaces given as triangles with their prescriptions.
#pragma once

#include "geometry/discrete/discrete_cad.h"
#include "measure/mesh_evaluation.h"
#include "mesh/distance/surface_distance.h"
#include "surface/options.h"
#include "surface/result.h"

namespace carreau {

/// Measures the mesh of mesh_discrete() against the sizes that governed it: linear in the triangles of the atlas.
MeshEvaluation evaluate_discrete(const discrete::DiscreteCad& surface, Cad& cad, const CompositeOptions& options,
                                 const CompositeResult& result, Monitor& monitor);

/// Adds the distances between a mesh of straight triangles and the input triangles of the surface, both ways; other
/// elements have none. Throws Cancelled.
void bound_input_distances(const discrete::DiscreteSurface& surface, const SurfaceMesh& mesh, int threads,
                           Monitor& monitor, MeshEvaluation& delivered);

/// A place at which a mesh and its input triangles are apart.
struct FarPlace {
  Vec3 at{};
  double distance = 0;
  double size = 0;  ///< mean length of the edges of the mesh's triangle there
};

/// Returns the place whose distance is the largest share of the size. `of_made`, `of_given`: by bound_distance().
FarPlace farthest_by_size(const TrianglesOfSpace& made, std::span<const FarPoint> of_made,
                          std::span<const FarPoint> of_given);

/// Warns with the place when a mesh is farther from the triangles that it was made of than its sizes resolve.
void warn_of_distance(const FarPlace& place, Monitor& monitor);

}  // namespace carreau
