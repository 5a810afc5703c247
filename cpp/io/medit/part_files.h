// SPDX-License-Identifier: BSD-3-Clause
// Files that several processes write together, each its part of the mesh.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "io/mesh_files.h"
#include "pipeline/parts/part_mesh.h"

namespace carreau {

/// Gets bytes of a file from a position on.
using PositionedSink = std::function<void(std::uint64_t position, std::string_view bytes)>;

/// Writes the bytes of a part, whose triangles are the triangles of `mesh`, in the file that write_mesh() would write of the whole mesh.
/// Positions ascend; the bytes of all parts are the file, without overlap. `.meshb`: GMF version 2 or 3, as one process chooses; 4 for
/// more than 2^31 - 1 vertices or triangles. Throws InvalidArgument for another format, or a coordinate that is not finite.
void write_part(const PartMesh& part, const FlatMesh& mesh, MeshFormat format, const PositionedSink& sink);

}  // namespace carreau
