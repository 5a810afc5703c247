// SPDX-License-Identifier: BSD-3-Clause
// The structure of a file as a tree: assemblies, parts, solids, and faces, edges and vertices with a name.
#pragma once

#include <string>
#include <vector>

#include "shape_file.h"
#include "solids.h"

namespace carreau_occ {

struct TreeRow {
  int depth = 0;
  std::string kind;  ///< "assembly", "part", "solid", "face", "edge", "vertex"
  int number = 0;    ///< of a solid, face, edge or vertex, from 1; 0: of others
  std::string name;  ///< its own; of a solid the distinct one; "": none
  int rgb = -1;      ///< its own colour, 0xRRGGBB; -1: none
  std::string layer; ///< its own; "": none
  int faces = 0;     ///< number of its faces
};

/// Rows in the order of the file: each is followed by the rows below it. Faces, edges and vertices are listed if they have
/// a name, a colour or a layer of their own. Solids that no part of the file has come last.
std::vector<TreeRow> part_tree(const ShapeFile& file, const Solids& solids);

}  // namespace carreau_occ
