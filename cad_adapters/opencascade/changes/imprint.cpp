// SPDX-License-Identifier: BSD-3-Clause
#include "changes/imprint.h"

#include <BOPAlgo_Builder.hxx>
#include <Message_Report.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <cmath>
#include <cstdio>
#include <string>

#include "changes/shape_images.h"
#include "thresholds.h"

namespace carreau_occ {
namespace {

/// The solids, then shells of no solid and faces of no shell. Edges of no face stay as they are: they may be sketches,
/// which would divide faces.
TopTools_ListOfShape parts_of(const TopoDS_Shape& shape) {
  TopTools_ListOfShape parts;
  add_parts(shape, TopAbs_SOLID, TopAbs_SHAPE, parts);
  add_parts(shape, TopAbs_SHELL, TopAbs_SOLID, parts);
  add_parts(shape, TopAbs_FACE, TopAbs_SHELL, parts);
  return parts;
}

std::string quoted(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

/// The fuse of the parts of a file, and the images of each of its shapes.
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

std::string name_of(const ShapeFile& file, const TopoDS_Shape& part, int number) {
  for (const ShapeFile::Label& label : file.labels)
    if (label.part.IsSame(part) && !label.name.empty()) return "solid " + std::to_string(number) + " (" + label.name + ")";
  return "solid " + std::to_string(number);
}

/// A sentence about the first solid whose images do not have its volume; "" when all have. Surfaces may move by the
/// tolerance.
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
  file = with_images(file, fuse.shape(), [&fuse](const TopoDS_Shape& shape) { return fuse.images_of(shape); });
}

}  // namespace carreau_occ
