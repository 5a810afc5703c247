// SPDX-License-Identifier: BSD-3-Clause
#include "imprint.h"

#include <BOPAlgo_Builder.hxx>
#include <BRepGProp.hxx>
#include <BRep_Builder.hxx>
#include <GProp_GProps.hxx>
#include <Message_Report.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Iterator.hxx>
#include <cmath>
#include <cstdio>
#include <string>

#include "thresholds.h"

namespace carreau_occ {
namespace {

/// Each shape of this kind that no shape of kind `holder` holds, once.
void add_parts(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind, TopAbs_ShapeEnum holder, TopTools_ListOfShape& parts) {
  TopTools_MapOfShape seen;
  for (TopExp_Explorer e(shape, kind, holder); e.More(); e.Next())
    if (seen.Add(e.Current())) parts.Append(e.Current());
}

/// The solids, then shells of no solid and faces of no shell. Edges of no face stay as they are: they may be sketches,
/// which would divide faces.
TopTools_ListOfShape parts_of(const TopoDS_Shape& shape) {
  TopTools_ListOfShape parts;
  add_parts(shape, TopAbs_SOLID, TopAbs_SHAPE, parts);
  add_parts(shape, TopAbs_SHELL, TopAbs_SOLID, parts);
  add_parts(shape, TopAbs_FACE, TopAbs_SHELL, parts);
  return parts;
}

TopoDS_Compound compound_of(const TopTools_ListOfShape& shapes) {
  TopoDS_Compound compound;
  const BRep_Builder builder;
  builder.MakeCompound(compound);
  for (const TopoDS_Shape& shape : shapes) builder.Add(compound, shape);
  return compound;
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

std::string quoted(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

/// The fuse of the parts of a file, and what became of each of its shapes.
class Fuse {
 public:
  Fuse(const TopTools_ListOfShape& parts, double tolerance) {
    builder_.SetArguments(parts);
    builder_.SetNonDestructive(Standard_True);  // the file stays as it is when the fuse fails
    builder_.SetFuzzyValue(tolerance);
    builder_.SetUseOBB(Standard_True);
  }

  [[nodiscard]] bool run(const Message_ProgressRange& progress) {
    builder_.Perform(progress);
    return !builder_.HasErrors() && !builder_.Shape().IsNull();
  }

  /// The images of a solid, face, edge or vertex; the shape itself when it has not changed.
  [[nodiscard]] TopTools_ListOfShape images_of(const TopoDS_Shape& shape) {
    TopTools_ListOfShape images = builder_.Modified(shape);
    if (images.IsEmpty() && !builder_.IsDeleted(shape)) images.Append(shape);
    return images;
  }

  [[nodiscard]] const TopoDS_Shape& shape() const { return builder_.Shape(); }

  /// OpenCASCADE's own words for a failure.
  [[nodiscard]] std::string errors() const {
    const Message_ListOfAlert& alerts = builder_.GetReport()->GetAlerts(Message_Fail);
    return alerts.IsEmpty() ? "no result" : alerts.First()->DynamicType()->Name();
  }

 private:
  BOPAlgo_Builder builder_;
};

/// The images of solids and faces below a shape. OpenCASCADE's history knows neither shells nor compounds.
void add_images(Fuse& fuse, const TopoDS_Shape& shape, TopTools_ListOfShape& images) {
  if (shape.ShapeType() == TopAbs_SOLID || shape.ShapeType() >= TopAbs_FACE) {
    TopTools_ListOfShape own = fuse.images_of(shape);
    images.Append(own);
    return;
  }
  for (TopoDS_Iterator it(shape); it.More(); it.Next()) add_images(fuse, it.Value(), images);
}

/// The images of a part; those of a shell or a compound in one compound.
TopTools_ListOfShape follow(Fuse& fuse, const TopoDS_Shape& part) {
  TopTools_ListOfShape images;
  add_images(fuse, part, images);
  if (part.ShapeType() == TopAbs_SOLID || part.ShapeType() >= TopAbs_FACE || images.IsEmpty()) return images;
  TopTools_ListOfShape whole;
  whole.Append(compound_of(images));
  return whole;
}

std::string name_of(const ShapeFile& file, const TopoDS_Shape& part, int number) {
  for (const ShapeFile::Label& label : file.labels)
    if (label.part.IsSame(part) && !label.name.empty()) return "solid " + std::to_string(number) + " (" + label.name + ")";
  return "solid " + std::to_string(number);
}

/// A sentence about the first solid whose images do not have its volume; "" when there is none.
/// Surfaces may move by the tolerance.
std::string find_wrong_volume(const ShapeFile& file, Fuse& fuse, double tolerance) {
  TopTools_IndexedMapOfShape solids;
  TopExp::MapShapes(file.shape, TopAbs_SOLID, solids);
  for (int s = 1; s <= solids.Extent(); ++s) {
    const TopTools_ListOfShape images = fuse.images_of(solids(s));
    if (images.Size() == 1 && images.First().IsSame(solids(s))) continue;
    double after = 0;
    for (const TopoDS_Shape& image : images) after += volume_of(image);
    const double before = volume_of(solids(s)), moved = tolerance > 0 ? tolerance * area_of(solids(s)) : 0;
    if (std::abs(after - before) > thresholds::imprint_volume * before + moved)
      return name_of(file, solids(s), s) + " would change its volume from " + quoted(before) + " to " + quoted(after);
  }
  return "";
}

/// The fuse with the edges of no face, and the labels and doubts of its shapes. A part with several images gives its
/// name to each.
ShapeFile follow(const ShapeFile& file, Fuse& fuse) {
  ShapeFile fused = file;
  TopTools_ListOfShape shapes;
  for (TopoDS_Iterator it(fuse.shape()); it.More(); it.Next()) shapes.Append(it.Value());
  add_parts(file.shape, TopAbs_EDGE, TopAbs_FACE, shapes);
  fused.shape = compound_of(shapes);
  fused.labels.clear();
  for (const ShapeFile::Label& label : file.labels)
    for (const TopoDS_Shape& image : follow(fuse, label.part)) fused.labels.emplace_back(label).part = image;
  fused.doubtful.clear();
  for (const auto& [face, why] : file.doubtful)
    for (const TopoDS_Shape& image : follow(fuse, face)) fused.doubtful.emplace_back(image, why);
  return fused;
}

}  // namespace

void imprint(ShapeFile& file, double tolerance, const Message_ProgressRange& progress) {
  const TopTools_ListOfShape parts = parts_of(file.shape);
  if (parts.Size() < 2) return;
  Fuse fuse(parts, tolerance);
  std::string failure;
  if (!fuse.run(progress))
    failure = "OpenCASCADE cannot fuse the parts (" + fuse.errors() + ")";
  else
    failure = find_wrong_volume(file, fuse, tolerance);
  if (!failure.empty()) {
    file.losses.push_back("the parts are not imprinted: " + failure);
    return;
  }
  file = follow(file, fuse);
}

}  // namespace carreau_occ
