// SPDX-License-Identifier: BSD-3-Clause
// From the options of `carreau mesh` to the parameters of a session.
#pragma once

#include <carreau.h>

#include <string>
#include <vector>

#include "inputs/base/cad_input.h"
#include "mesh/mesh_options.h"
#include "mesh/size_map.h"

namespace command {

/// Throws Failure for words that mean nothing, before the input is read.
void check_words(const MeshOptions& options);

/// The sizes that the command chooses for a CAD file when none is given; "": it chooses none.
std::string chosen_sizes(const MeshOptions& options, const CadInput& input);

/// A sentence for each size that was typed and that --min or --max changes.
std::vector<std::string> sizes_beyond_bounds(const MeshOptions& options, double diagonal);

/// A sentence for each two rules of --face-size that name a face and differ.
std::vector<std::string> contradicting_face_sizes(const MeshOptions& options, const CadInput& input);

/// Gives face sizes to the input, and parameters and the size map to the session: first the defaults of this command,
/// then the env file, then the options, --set last. Throws Failure.
void set_parameters(carreau_session* session, const MeshOptions& options, CadInput& input, SizeMap& map);

}  // namespace command
