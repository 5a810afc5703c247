// SPDX-License-Identifier: BSD-3-Clause
// Files of tetrahedra with groups of solids and faces.
#pragma once

#include <string>
#include <vector>

#include "volume/volume_mesh.h"

namespace command {

/// Suffixes that hold tetrahedra: Gmsh 4.1 and 2.2 (dolfinx, ElmerGrid), CalculiX and Abaqus, SU2, VTK, Medit (MMG3D).
inline const std::vector<std::string> volume_suffixes{".msh", ".msh2", ".inp", ".su2", ".vtu", ".mesh"};

/// Throws Failure when the format of a file has no elements of order 2, and the mesh has.
void refuse_order(const std::vector<std::string>& paths, bool quadratic);

/// The content of a file with this suffix. Each solid and each face is a group: its name, or "solid_1" and "face_3". Solids or faces of
/// one name are one group. CalculiX gets sets of elements for solids, and a set of nodes and a surface for each face and each group of faces.
std::string volume_text(const VolumeMesh& volume, const std::string& suffix);

}  // namespace command
