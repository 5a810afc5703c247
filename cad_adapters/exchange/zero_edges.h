// SPDX-License-Identifier: BSD-3-Clause
// Edges of a STEP file that are a point.
#pragma once

#include <Interface_InterfaceModel.hxx>

namespace carreau_occ {

/// Removes edges without length from the loops of a model that is not translated yet, and merges the vertices at their
/// ends. These are lines, and other curves that are a point, whose ends have the same coordinates. OpenCASCADE makes no
/// curve of some of them (a line along a vector of no length), and then loses their faces. A loop keeps its last edge.
/// Models of other formats stay as they are.
void take_out_zero_edges(const Handle(Interface_InterfaceModel) & model);

}  // namespace carreau_occ
