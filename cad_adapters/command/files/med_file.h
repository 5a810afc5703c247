// SPDX-License-Identifier: BSD-3-Clause
// Files .med (Salome, Code_Aster) through the MED library, where the program is built with it.
#pragma once

#include <string>

#include "files/mesh_file.h"

namespace command {

/// Throws Failure when the program has no MED library, or cannot load it.
void require_med();

/// Returns a mesh of a .med file as the text of a Gmsh file (version 2.2), which the library reads. A family of faces
/// with a group "face_7" has reference 7, the others have the numbers behind the largest one; further groups are the
/// name of the face. Families of edges have groups "curve_7". Throws Failure.
std::string med_as_gmsh(const std::string& path);

/// Writes a mesh with a family a face and a family a curve. Groups are "face_7" ("face_m7": -7) and the name of the
/// face, and "curve_7". Throws Failure.
void write_med(carreau_mesh* mesh, const std::string& path);

}  // namespace command
