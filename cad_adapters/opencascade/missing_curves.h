// SPDX-License-Identifier: BSD-3-Clause
// Curves of the parameter plane that a file leaves out.
#pragma once

#include <TopoDS_Face.hxx>

namespace carreau_occ {

/// Gives the edges of a face their missing curves in its parameter plane, by projecting their curves in space. Moves
/// the curves by periods of the surface so that each wire closes. Changes the edges, wherever they are used; edges that
/// have all curves stay as they are. May throw Standard_Failure.
void add_missing_curves(const TopoDS_Face& face);

}  // namespace carreau_occ
