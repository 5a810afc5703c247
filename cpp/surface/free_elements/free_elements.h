// SPDX-License-Identifier: BSD-3-Clause
// Quadrilaterals and elements of second order on meshes that are free of patches, and on surfaces given as triangles.
#pragma once

#include <vector>

#include "surface/free_elements/crossing_places.h"
#include "surface/independent/frame.h"
#include "surface/independent/reassembly.h"
#include "surface/options.h"

namespace carreau {

struct ElementCrossings {
  std::vector<CrossingPlace> all, fresh;  ///< where they do, and where triangles did not
};

/// For RemeshingFrame::elements: makes the elements that options.element wants of a mesh of straight triangles in space, on the surface under it, and a mesh of
/// faces of them. With has_quads_only() the sizes that the mesh was made with were twice those asked for; those of `made` are the latter. What stays invalid is told, and its face `mended`.
/// Where straight halves of elements cross, of p2 nobody looks. Throws what the host throws, and Cancelled.
ElementCrossings make_free_elements(const SurfaceMesh& before, const RemeshingFrame& frame, const CompositeOptions& options,
                                    Cad& cad, FreedMesh& made, Monitor& monitor);

}  // namespace carreau
