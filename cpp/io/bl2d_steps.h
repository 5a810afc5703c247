// SPDX-License-Identifier: BSD-3-Clause
// Files between the steps of BL2D (RR-2818 sec. 6), read only.
#pragma once

#include <string>
#include <string_view>

#include "mesh/flat_mesh.h"

namespace carreau {

/// SMOOTH (.smo) or C (.mc): vertices and edges of dimension 2, whose references are the ranks of their curves, from 1; the
/// edges of a curve stand one after the other, in its direction. Throws FileError with the line.
FlatMesh read_mesh_smo(std::string_view text, const std::string& name);
/// MS (.ms): triangles of subdomains, without the triangles outside and the corners of the frame around them. Edges bound
/// the subdomains. Throws FileError with the line.
FlatMesh read_mesh_ms(std::string_view text, const std::string& name);

}  // namespace carreau
