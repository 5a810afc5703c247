// SPDX-License-Identifier: BSD-3-Clause
// Loops that have the face on their wrong side.
#pragma once

#include <vector>

#include "wire_periods.h"

namespace carreau_occ {

/// Turns the loops of a face round, if its outer loop runs clockwise in the parameter plane: a face is not the
/// outside of its boundary. Inner loops are turned with it unless they run clockwise already. Faces of closed or
/// periodic surfaces, where the outside of a loop is a face, stay, as do loops without an area that is beyond doubt.
/// `loops` of the face taken forward. May throw Standard_Failure.
void turn_wrong_loops(std::vector<std::vector<EdgeImage>>& loops, const TopoDS_Face& face);

}  // namespace carreau_occ
