// SPDX-License-Identifier: BSD-3-Clause
// Boxes of faces of planes, cylinders, cones, spheres and tori.
#pragma once

#include <Bnd_Box.hxx>
#include <TopoDS_Face.hxx>

namespace carreau_occ {

bool is_elementary(const TopoDS_Face& face);

/// Adds the extreme points of an elementary face to a box, exact to rounding, as far as they are outside of `known`,
/// the present box of the shape. Passes exceptions of OpenCASCADE on.
void add_elementary(const TopoDS_Face& face, const Bnd_Box& known, Bnd_Box& box);

}  // namespace carreau_occ
