// SPDX-License-Identifier: BSD-3-Clause
// What a command says of its geometry besides the name of the file.
#pragma once

#include <string>

#include "grid_input.h"
#include "molecule_input.h"
#include "triangles_input.h"

namespace command {

struct InputChoice {
  std::string host;           ///< shared library, of a .pardom
  MoleculeChoice molecule;    ///< of a molecule; its surface also of an atlas
  GridChoice grid;            ///< of a structured grid
  TrianglesChoice triangles;  ///< of a surface given as triangles
  bool loose_edges = false;   ///< of a CAD file: edges of no face are meshed, too
  std::string domain;         ///< of a surface by formulas; empty: usual_domain
};

}  // namespace command
