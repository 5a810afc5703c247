// SPDX-License-Identifier: BSD-3-Clause
#include "changes/shape_images.h"

#include <BRepGProp.hxx>
#include <BRep_Builder.hxx>
#include <GProp_GProps.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Iterator.hxx>
#include <cmath>

namespace carreau_occ {
namespace {

/// The images of solids and faces below a shape. OpenCASCADE's history knows neither shells nor compounds.
void add_images(const ImagesOf& images_of, const TopoDS_Shape& shape, TopTools_ListOfShape& images) {
  if (shape.ShapeType() == TopAbs_SOLID || shape.ShapeType() >= TopAbs_FACE) {
    TopTools_ListOfShape own = images_of(shape);
    images.Append(own);
    return;
  }
  for (TopoDS_Iterator it(shape); it.More(); it.Next()) add_images(images_of, it.Value(), images);
}

/// The images of a part; the images of a shell or a compound in one compound.
TopTools_ListOfShape follow(const ImagesOf& images_of, const TopoDS_Shape& part) {
  TopTools_ListOfShape images;
  add_images(images_of, part, images);
  if (part.ShapeType() == TopAbs_SOLID || part.ShapeType() >= TopAbs_FACE || images.IsEmpty()) return images;
  TopTools_ListOfShape whole;
  whole.Append(compound_of(images));
  return whole;
}

}  // namespace

TopoDS_Compound compound_of(const TopTools_ListOfShape& shapes) {
  TopoDS_Compound compound;
  const BRep_Builder builder;
  builder.MakeCompound(compound);
  for (const TopoDS_Shape& shape : shapes) builder.Add(compound, shape);
  return compound;
}

void add_parts(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind, TopAbs_ShapeEnum holder, TopTools_ListOfShape& parts) {
  TopTools_MapOfShape seen;
  for (TopExp_Explorer e(shape, kind, holder); e.More(); e.Next())
    if (seen.Add(e.Current())) parts.Append(e.Current());
}

ShapeFile with_images(const ShapeFile& file, const TopoDS_Shape& result, const ImagesOf& images_of, const TopTools_ListOfShape* loose) {
  ShapeFile changed = file;
  TopTools_ListOfShape shapes;
  if (result.ShapeType() == TopAbs_COMPOUND)
    for (TopoDS_Iterator it(result); it.More(); it.Next()) shapes.Append(it.Value());
  else
    shapes.Append(result);
  if (loose == nullptr)
    add_parts(file.shape, TopAbs_EDGE, TopAbs_FACE, shapes);
  else
    for (const TopoDS_Shape& edge : *loose) shapes.Append(edge);
  changed.shape = compound_of(shapes);
  changed.labels.clear();
  for (const ShapeFile::Label& label : file.labels)
    for (const TopoDS_Shape& image : follow(images_of, label.part)) changed.labels.emplace_back(label).part = image;
  changed.doubtful.clear();
  for (const auto& [face, why] : file.doubtful)
    for (const TopoDS_Shape& image : follow(images_of, face)) changed.doubtful.emplace_back(image, why);
  return changed;
}

double volume_of(const TopoDS_Shape& shape) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  return std::abs(properties.Mass());
}

double area_of(const TopoDS_Shape& shape) {
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(shape, properties);
  return properties.Mass();
}

}  // namespace carreau_occ
