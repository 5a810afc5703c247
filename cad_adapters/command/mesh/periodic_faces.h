// SPDX-License-Identifier: BSD-3-Clause
// Periodic faces: --periodic, and files of pairs.
#pragma once

#include <carreau.h>

#include <string>

#include "mesh/mesh_options.h"

namespace command {

/// Throws Failure for words that are no periodicity, before anything is read.
void check_periodic(const MeshOptions& options);

/// Hands the periodicities to a session that has the model.
void set_periodic(carreau_session* session, const MeshOptions& options);

/// Pairs of nodes as text: a line "# dimension slave master count" with the map for each pair of entities, then lines "slave master" of
/// nodes, from 1.
std::string pairs_text(carreau_mesh* mesh);

}  // namespace command
