// SPDX-License-Identifier: BSD-3-Clause
// How large a shape is.
#pragma once

#include <TopoDS_Shape.hxx>

namespace carreau_occ {

/// Diagonal of the box of the faces of a shape that OpenCASCADE can evaluate; 0: no such face. Exact to rounding for
/// planes and quadrics, to a millionth or so for others.
double diagonal_of(const TopoDS_Shape& shape);

}  // namespace carreau_occ
