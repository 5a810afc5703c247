// SPDX-License-Identifier: BSD-3-Clause
// Narrow faces that vanish from a mesh.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "support/monitor.h"
#include "surface/result.h"

namespace carreau {

/// A face that is to vanish, with the sets of vertices that are merged.
struct FaceCollapse {
  int face = 0;                                ///< index in SurfaceMesh::faces
  double width = 0;                            ///< model length
  double size = 0;                             ///< prescribed there
  std::vector<std::vector<std::int32_t>> one;  ///< local vertices of that face
  std::vector<int> curves;                     ///< indices of curves all of whose vertices become one
};

/// Lets faces vanish from a mesh. A set of vertices becomes its first one, so that corners stay in place. Curves that
/// coincide become one curve, with the reference of the first and the uses of all. Statuses and sentences of faces are
/// set.

/// Collapses all faces whose neighbours were meshed without their end caps. Returns false and does nothing if the mesh
/// would have a defect, or a triangle would be turned over.
bool collapse_together(std::span<const FaceCollapse> faces, CompositeResult& result);

/// Collapses the faces, the narrowest first, if the mesh stays as sound as it was. It must keep its Euler
/// characteristic, and no triangle of other faces may be turned over. The others keep their triangles.
void collapse_one_by_one(std::span<const FaceCollapse> faces, CompositeResult& result, Monitor& monitor);

}  // namespace carreau
