// SPDX-License-Identifier: BSD-3-Clause
// Loops whose curves do not meet at their vertices.
#pragma once

#include <Geom2d_Curve.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <string>
#include <vector>

#include "brep_state.h"

namespace carreau_occ {

/// The faces of a host, their curves, and the maps that number faces, edges and vertices.
struct LoopsOfFaces {
  std::vector<HostFace>& faces;
  Evaluators& evaluators;
  const TopTools_IndexedMapOfShape& shapes;
  TopTools_IndexedMapOfShape &edges, &vertices;
  std::vector<int>& uses;
};

/// Closes gaps between consecutive curves of a loop that are wide beside the shape or beside the curves. If the image
/// of an edge is off its curve in space, and that curve lies on the surface, the image is made anew. Elsewhere the
/// vertex is divided, and a straight line of the parameter plane becomes an edge between its parts, which faces share
/// that have this gap. A "degenerate" edge that has a length in space becomes such an edge, too. Returns a sentence
/// about the changes, "": no change. Faces on which OpenCASCADE fails stay as they are.
std::string close_loop_gaps(const LoopsOfFaces& loops);

}  // namespace carreau_occ
