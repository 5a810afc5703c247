// SPDX-License-Identifier: BSD-3-Clause
// Bodies that are symmetric about a plane: whole bodies are cut by it, halves get their other half.
#pragma once

#include <array>

#include "shape_file.h"

namespace carreau_occ {

/// A plane by a point and a normal of any length but 0.
struct MirrorPlane {
  std::array<double, 3> point{}, normal{};
};

/// Makes a body symmetric about the plane to rounding. If it has faces on both sides, the plane cuts the faces that lie across it, and
/// the half on the side of the normal stays; the other half must be its image, and is replaced by it. A body on one side loses the
/// faces in the plane. Then each face gets its mirror image: in each solid, shell or list of faces the images follow the faces, in their order.
/// Both halves share their edges in the plane. Names and doubts follow, also from the half that is replaced. Edges of no face are cut and mirrored, too.
///
/// Throws std::runtime_error with a sentence: no face off the plane, halves that differ (which face, where), faces that OpenCASCADE cannot cut.
void mirror(ShapeFile& file, const MirrorPlane& plane);

}  // namespace carreau_occ
