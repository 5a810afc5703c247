// SPDX-License-Identifier: BSD-3-Clause
// Cells of periodic faces: images of the cells of their masters.
#pragma once

#include <vector>

#include "periodic/match_faces.h"
#include "surface/quads/face_quads.h"

namespace carreau {

/// A slave on its way beside its master.
struct SlaveQuads {
  const FacePair* pair = nullptr;
  FaceQuads *master = nullptr, *slave = nullptr;
  std::vector<std::int32_t> image;  ///< local vertices of the slave by local vertices of the master; -1: none yet
};

/// Gives the slave the cells of its master; vertices that it lacks are added without a place.
void copy_cells(SlaveQuads& quads);

/// Both have been cut (halve_cells()): images of the new vertices. `corners`: of the master's cells before.
void match_halves(const std::vector<int>& corners, SlaveQuads& quads);

/// Moves vertices inside the slave to the images of the master's.
void place_cells(const ElementWork& work, SlaveQuads& quads);

/// After put_back(): the slave has the master's elements, diagonals and all.
void carry_back(const SlaveQuads& quads, SurfaceMesh& mesh);

}  // namespace carreau
