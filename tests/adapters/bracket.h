// SPDX-License-Identifier: BSD-3-Clause
// A part as people draw them: a plate of 60 x 40 x 8 with round corners, a boss on a fillet, a bore and four holes.
#pragma once

#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <string>

namespace shapes {

TopoDS_Shape bracket();

/// "bore", "hole", "fillet", "corner", "boss" or "plate".
std::string name_in_bracket(const TopoDS_Face& face);

}  // namespace shapes
