// SPDX-License-Identifier: BSD-3-Clause
// The distance between two faces over triangles that cross. Private to pipeline/.
#pragma once

#include "cad/cad.h"
#include "pipeline/inspect/face_triangle.h"
#include "support/vec.h"

namespace carreau {

/// The gap at a place at which two triangles cross.
struct FaceGap {
  double width = 0;    ///< least distance found between the two pieces of the faces; 0: they meet
  double sagitta = 0;  ///< largest distance between the triangles and their faces, at the place and at centroids
  double slope = 0;    ///< sine between both normals there
  Vec3 place;          ///< between the points of that distance
};

/// Looks for a common point first, by Newton's method on both tangent planes. If the two triangles have no common
/// point, projects points from one face to the other in turn. Throws the host's exceptions.
FaceGap measure_gap(Cad& cad, const FaceTriangle& s, const FaceTriangle& t, const Vec3& place);

}  // namespace carreau
