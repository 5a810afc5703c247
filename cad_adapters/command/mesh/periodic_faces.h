// SPDX-License-Identifier: BSD-3-Clause
// Periodic faces: --periodic, and files of pairs.
#pragma once

#include <carreau.h>

#include <string>
#include <vector>

#include "files/mesh_file.h"
#include "inputs/base/cad_input.h"
#include "mesh/mesh_options.h"

namespace command {

/// Throws Failure for words that are no periodicity, before anything is read.
void check_periodic(const MeshOptions& options);

/// Hands the periodicities and mirror planes to a session that has the model. Throws Failure if a face lies across a mirror plane, or if
/// the geometry lies on one side of it.
void set_periodic(carreau_session* session, const MeshOptions& options, const CadInput& input);

/// Throws Failure if a face of the mesh has no image under a reflection of --mirror.
void require_mirrored(carreau_mesh* mesh, const MeshOptions& options, const CadInput& input, const std::vector<FaceResult>& faces);

/// Pairs of nodes as text: a line "# dimension slave master count" with the map for each pair of entities, then lines "slave master" of
/// nodes, from 1.
std::string pairs_text(carreau_mesh* mesh);

}  // namespace command
