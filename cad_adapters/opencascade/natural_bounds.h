// SPDX-License-Identifier: BSD-3-Clause
// Faces that are the whole of a closed or bounded surface, which files may give without a wire.
#pragma once

#include <TopoDS_Shape.hxx>

namespace carreau_occ {

/// Gives each face of a shape that has no wire the bounds of its surface, wherever the face is used. Faces of unbounded
/// surfaces stay without.
void add_natural_bounds(const TopoDS_Shape& shape);

}  // namespace carreau_occ
