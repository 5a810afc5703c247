// SPDX-License-Identifier: BSD-3-Clause
#include "quick_healing.h"

#include <ShapeAlgo.hxx>
#include <ShapeAlgo_AlgoContainer.hxx>
#include <ShapeBuild_ReShape.hxx>
#include <ShapeExtend.hxx>
#include <ShapeFix_Shape.hxx>
#include <TopoDS_Iterator.hxx>
#include <unordered_set>

namespace carreau_occ {
namespace {

/// OpenCASCADE's record of replaced shapes. Its own Apply() copies each shape before it looks for replaced parts, and
/// throws the copy away if there are none; healing calls it for every edge, wire and face. Shapes without replaced
/// parts come back at once here.
class Replacements final : public ShapeBuild_ReShape {
 public:
  using ShapeBuild_ReShape::Apply;
  using ShapeBuild_ReShape::Status;

  TopoDS_Shape Apply(const TopoDS_Shape& shape, const TopAbs_ShapeEnum until) override {
    if (shape.IsNull() || holds_replaced(shape)) return ShapeBuild_ReShape::Apply(shape, until);
    myStatus = ShapeExtend::EncodeStatus(ShapeExtend_OK);
    return shape;
  }
  void Clear() override {
    ShapeBuild_ReShape::Clear();
    replaced_.clear();
  }

 protected:
  void replace(const TopoDS_Shape& shape, const TopoDS_Shape& by, const TReplacementKind kind) override {
    if (!shape.IsNull()) replaced_.insert(shape.TShape().get());
    ShapeBuild_ReShape::replace(shape, by, kind);
  }

 private:
  /// True if the shape or a part of it may be replaced, in whatever place and orientation.
  [[nodiscard]] bool holds_replaced(const TopoDS_Shape& shape) const {
    if (replaced_.empty()) return false;
    if (replaced_.contains(shape.TShape().get())) return true;
    for (TopoDS_Iterator parts(shape, Standard_False, Standard_False); parts.More(); parts.Next())
      if (holds_replaced(parts.Value())) return true;
    return false;
  }

  std::unordered_set<const TopoDS_TShape*> replaced_;  // the record of the base class keeps them alive
};

class Tools final : public ShapeAlgo_ToolContainer {
 public:
  explicit Tools(const Handle(ShapeAlgo_ToolContainer) & inner) : inner_(inner) {}

  [[nodiscard]] Handle(ShapeFix_Shape) FixShape() const override {
    const Handle(ShapeFix_Shape) tool = inner_->FixShape();
    const Handle(ShapeBuild_ReShape) record = new Replacements;
    record->ModeConsiderLocation() = Standard_True;  // as ShapeFix_Shape sets it for a record of its own
    tool->SetContext(record);
    return tool;
  }
  [[nodiscard]] Handle(ShapeFix_EdgeProjAux) EdgeProjAux() const override { return inner_->EdgeProjAux(); }

 private:
  Handle(ShapeAlgo_ToolContainer) inner_;
};

}  // namespace

QuickHealing::QuickHealing() {
  ShapeAlgo::Init();
  before_ = ShapeAlgo::AlgoContainer()->ToolContainer();
  ShapeAlgo::AlgoContainer()->SetToolContainer(new Tools(before_));
}
QuickHealing::~QuickHealing() { ShapeAlgo::AlgoContainer()->SetToolContainer(before_); }

}  // namespace carreau_occ
