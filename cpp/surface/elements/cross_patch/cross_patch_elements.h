// SPDX-License-Identifier: BSD-3-Clause
// Quadrilaterals and elements of second order on meshes that are free of patches, and on surfaces given as triangles.
#pragma once

#include <vector>

#include "surface/elements/cross_patch/crossing_places.h"
#include "surface/remesh/frame.h"
#include "surface/remesh/reassembly.h"
#include "surface/options.h"

namespace carreau {

struct ElementCrossings {
  std::vector<CrossingPlace> all, fresh;  ///< where they do, and where triangles did not
};

/// For RemeshingFrame::elements: makes the elements of type options.element out of a mesh of straight triangles in space. Makes also a mesh
/// of faces of these elements, on the surface under the triangles. With has_quads_only() the mesh was made with twice the prescribed sizes;
/// `made` has the prescribed sizes. Reports elements that stay invalid, and marks their faces as `mended`. Returns the places where
/// straight halves of elements cross; elements p2 are not checked. Throws the exceptions of the host, and Cancelled.
ElementCrossings make_cross_patch_elements(const SurfaceMesh& before, const RemeshingFrame& frame, const CompositeOptions& options,
                                    Cad& cad, CrossPatchResult& made, Monitor& monitor);

}  // namespace carreau
