// SPDX-License-Identifier: BSD-3-Clause
// Edges of no face, symmetric about a plane.
#pragma once

#include <TopTools_DataMapOfShapeListOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Pln.hxx>

namespace carreau_occ {

/// Heights of the edges of no face over the plane.
struct EdgeHeights {
  double low = 0, high = 0;
};
EdgeHeights heights_of_loose(const TopoDS_Shape& shape, const gp_Pln& plane);

struct MirroredEdges {
  TopTools_ListOfShape edges;                  ///< pieces, then their images
  TopTools_DataMapOfShapeListOfShape images;   ///< by edge of the shape
};

/// Cuts the edges of no face by the plane and adds the mirror images of their pieces on one side (`above`: of the normal). Edges in the plane stay.
/// `whole`: the edges on the other side must be the images, within the distance `within`. `near`: distance that counts as none. Throws
/// std::runtime_error with the place of an edge without an image.
MirroredEdges mirror_loose(const TopoDS_Shape& shape, const gp_Pln& plane, bool above, bool whole, double near, double within);

}  // namespace carreau_occ
