// SPDX-License-Identifier: BSD-3-Clause
// Groups of faces, edges, vertices and solids, for files that hold groups.
#pragma once

#include <carreau.h>

#include <string>
#include <vector>

#include "inputs/base/cad_input.h"

namespace command {

/// Names faces by their solid ("part"), their colour ("color") or their layer ("layer"). "face" removes the names of
/// parts, so that each face without a name is a group. "name" and "": a face has its name, or the name of its part.
/// Then names the entities that each rule "group=selector" selects (selection.h). A face around a solid that a rule
/// selects gets the group's name, too, unless a rule selects the face itself. The session has the geometry of `input`.
/// Returns sentences about entities that two rules select: the last rule counts. Throws Failure.
std::vector<std::string> set_groups(carreau_session* session, const CadInput& input, const std::string& group_by,
                                    const std::vector<std::string>& rules);

}  // namespace command
