// SPDX-License-Identifier: BSD-3-Clause
// Faces of different solids that lie on each other, and the area that they have in common.
#pragma once

#include <array>
#include <vector>

#include "shape_file.h"
#include "solids.h"

namespace carreau_occ {

/// Two solids whose faces lie on each other.
struct FaceContact {
  std::array<int, 2> solids{};     ///< from 1, ascending
  double area = 0;                 ///< that they have in common
  int pairs = 0;                   ///< of faces
  std::array<int, 2> faces{};      ///< the pair with the largest area, from 1, in the order of the solids
  std::array<double, 3> place{};   ///< a point of that pair
};

/// Compares faces of different solids whose boxes meet and whose surfaces coincide, with opposite outsides. The area is
/// exact on planes with straight borders, and where one face covers the other; otherwise its error is about a hundredth.
/// Work on free-form surfaces is bounded: beyond 20 000 projections their faces are not compared. Faces between two solids
/// are no contact. By solids. Nothing is thrown: faces that OpenCASCADE fails on have none.
std::vector<FaceContact> find_face_contacts(const ShapeFile& file, const Solids& solids);

}  // namespace carreau_occ
