// SPDX-License-Identifier: BSD-3-Clause
// Surface meshes of straight triangles as .meshb files, without a flat copy.
#pragma once

#include <string>

#include "mesh/flat_mesh.h"
#include "mesh/surface_mesh.h"

namespace carreau {

/// Writes the bytes that write_mesh() writes for flatten(mesh, ...). `frame` has the dimension, the references of vertices and the edges of the
/// flat mesh; its vertices and triangles are not read. The mesh has no elements but straight triangles. Throws Error if the file cannot be
/// written.
void write_surface(const SurfaceMesh& mesh, const FlatMesh& frame, const std::string& path);

}  // namespace carreau
