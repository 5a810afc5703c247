// SPDX-License-Identifier: BSD-3-Clause
#include "changes/units.h"

#include <BRepBuilderAPI_Transform.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Iterator.hxx>
#include <algorithm>
#include <gp_Trsf.hxx>
#include <utility>

namespace carreau_occ {
namespace {

const LengthUnit* unit_of(const std::string& sign) {
  const auto* const found = std::find_if(length_units.begin(), length_units.end(), [&](const LengthUnit& unit) { return sign == unit.sign; });
  return found == length_units.end() ? nullptr : found;
}

double factor_to(const ShapeFile& file, const std::string& unit) {
  if (unit.empty()) return 1;
  const LengthUnit* const to = unit_of(unit);
  if (to == nullptr) throw UnknownUnit("'" + unit + "' is not a unit of length: nm, um, mm, cm, dm, m, km, mil, in, ft or yd");
  if (file.unit.empty()) throw UnknownUnit("the file has no unit, so its lengths cannot become " + unit + "; a scale can be given");
  return unit_of(file.unit)->millimetres / to->millimetres;
}

/// Scales one compound of the shape and of the parts of labels and doubts, so that shared entities stay shared.
void scale_shape(ShapeFile& file, double factor) {
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  std::vector<TopoDS_Shape*> shapes{&file.shape};
  for (ShapeFile::Label& label : file.labels) shapes.push_back(&label.part);
  for (auto& doubt : file.doubtful) shapes.push_back(&doubt.first);
  for (const TopoDS_Shape* shape : shapes) builder.Add(all, *shape);
  gp_Trsf scaling;
  scaling.SetScaleFactor(factor);
  BRepBuilderAPI_Transform transform(all, scaling, Standard_True);
  std::size_t k = 0;
  const TopoDS_Shape scaled = transform.Shape();
  for (TopoDS_Iterator it(scaled); it.More(); it.Next()) *shapes[k++] = it.Value();
}

}  // namespace

void change_lengths(ShapeFile& file, const std::string& unit, double scale) {
  const double factor = factor_to(file, unit) * scale;
  if (factor != 1) scale_shape(file, factor);
  if (!unit.empty()) file.unit = unit;
  if (scale != 1) file.unit.clear();
}

}  // namespace carreau_occ
