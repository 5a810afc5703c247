// SPDX-License-Identifier: BSD-3-Clause
// Faces whose width leaves no place for triangles of a good shape. Private to session/.
#pragma once

#include <string>

#include "mesh/surface_mesh.h"

namespace carreau {

/// A sentence that names the strips of one layer of triangles whose mean quality is low, with their widths; "" without
/// such strips.
std::string describe_strips(const SurfaceMesh& mesh);

}  // namespace carreau
