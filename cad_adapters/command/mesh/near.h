// SPDX-License-Identifier: BSD-3-Clause
// Sizes near entities of a geometry: attractors.
#pragma once

#include <carreau.h>

#include <string>

#include "inputs/base/cad_input.h"
#include "mesh/mesh_options.h"

namespace command {

/// A rule of --near: "entities=size:reach".
struct NearRule {
  std::string entities, size, reach;  ///< the last two are lengths
};

/// Throws Failure, which begins with `option`.
NearRule parse_near(const std::string& rule, const std::string& option);

/// Gives a session the attractors of the rules of --near. The session has its parameters: hphydef is the size around all
/// attractors. Faces of a rule are meshed alone for their shape, as closely as the slope of the sizes requires. Throws
/// Failure.
void add_attractors(carreau_session* session, const MeshOptions& options, CadInput& input);

}  // namespace command
