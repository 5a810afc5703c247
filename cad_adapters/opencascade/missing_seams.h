// SPDX-License-Identifier: BSD-3-Clause
// Faces that go round a closed surface without an edge that opens them.
#pragma once

#include <TopoDS_Face.hxx>
#include <vector>

#include "wire_periods.h"

namespace carreau_occ {

/// Adds a seam between two loops that go once round a periodic surface in opposite directions, or between one such loop
/// and the pole that it surrounds. The seam is a straight line of the parameter plane that meets no other curve. Loops
/// that close stay as they are, and so does a face without such a line. New edges have vertices of the face, and a pole
/// gets a vertex. `wires`: of the face taken forward, each in any order. May throw Standard_Failure.
void add_missing_seams(std::vector<std::vector<EdgeImage>>& wires, const TopoDS_Face& face);

}  // namespace carreau_occ
