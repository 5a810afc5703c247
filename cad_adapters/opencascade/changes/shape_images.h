// SPDX-License-Identifier: BSD-3-Clause
// Shapes that an operation of OpenCASCADE made of others, and measures of both.
#pragma once

#include <TopAbs_ShapeEnum.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Shape.hxx>
#include <functional>

#include "shape_file.h"

namespace carreau_occ {

/// The images of a solid, face, edge or vertex; the shape itself when it has not changed, none when it is gone.
using ImagesOf = std::function<TopTools_ListOfShape(const TopoDS_Shape&)>;

/// `result` in place of the shape of a file, with the edges of no face, or with `loose` in their place. Labels and doubts follow
/// the images of their parts. A part with several images gives its name to each.
ShapeFile with_images(const ShapeFile& file, const TopoDS_Shape& result, const ImagesOf& images_of, const TopTools_ListOfShape* loose = nullptr);

/// Appends each shape of a kind that no shape of kind `holder` holds, once. TopAbs_SHAPE: no kind holds it.
void add_parts(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind, TopAbs_ShapeEnum holder, TopTools_ListOfShape& parts);

TopoDS_Compound compound_of(const TopTools_ListOfShape& shapes);

double volume_of(const TopoDS_Shape& shape);
double area_of(const TopoDS_Shape& shape);

}  // namespace carreau_occ
