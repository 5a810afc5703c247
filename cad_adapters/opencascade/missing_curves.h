// SPDX-License-Identifier: BSD-3-Clause
// Curves of the parameter plane that a file leaves out.
#pragma once

#include <TopoDS_Face.hxx>

namespace carreau_occ {

/// Gives the edges of a face the curves in its parameter plane that they lack, by projecting their curves in space, and
/// moves them by periods of the surface so that each wire closes. Changes the edges, wherever they are used; those that
/// have all curves stay as they are. May throw Standard_Failure.
void add_missing_curves(const TopoDS_Face& face);

}  // namespace carreau_occ
