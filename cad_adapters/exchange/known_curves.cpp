// SPDX-License-Identifier: BSD-3-Clause
#include "known_curves.h"

#include <BRep_Curve3D.hxx>
#include <BRep_CurveOnSurface.hxx>
#include <BRep_ListIteratorOfListOfCurveRepresentation.hxx>
#include <BRep_ListOfCurveRepresentation.hxx>
#include <BRep_TEdge.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Circle.hxx>
#include <Geom_Line.hxx>
#include <Geom_Plane.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <Transfer_FinderProcess.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSAlgo.hxx>
#include <array>
#include <vector>

namespace carreau_occ {
namespace {

/// An edge's curve in space as it is: later ones that differ in anything are others.
struct SpaceCurve {
  Handle(Geom_Curve) curve;
  double first = 0, last = 0;
  std::array<double, 13> numbers{};

  bool operator==(const SpaceCurve& other) const {
    return curve == other.curve && first == other.first && last == other.last && numbers == other.numbers;
  }
};

void set(std::array<double, 13>& numbers, std::size_t from, const gp_XYZ& value) {
  for (int i = 0; i < 3; ++i) numbers[from + static_cast<std::size_t>(i)] = value.Coord(i + 1);
}

/// Null if the edge has no curve, or if the curve is placed, or neither a line nor a circle.
SpaceCurve curve_of(const BRep_TEdge& edge) {
  SpaceCurve space;
  for (BRep_ListIteratorOfListOfCurveRepresentation it(edge.Curves()); it.More(); it.Next()) {
    if (!it.Value()->IsCurve3D()) continue;
    const auto& found = static_cast<const BRep_Curve3D&>(*it.Value());
    if (found.Curve3D().IsNull() || !found.Location().IsIdentity()) return {};
    found.Range(space.first, space.last);
    const Handle(Standard_Type) type = found.Curve3D()->DynamicType();
    if (type == STANDARD_TYPE(Geom_Line)) {
      const auto& line = static_cast<const Geom_Line&>(*found.Curve3D());
      set(space.numbers, 0, line.Position().Location().XYZ());
      set(space.numbers, 3, line.Position().Direction().XYZ());
    } else if (type == STANDARD_TYPE(Geom_Circle)) {
      const auto& circle = static_cast<const Geom_Circle&>(*found.Curve3D());
      set(space.numbers, 0, circle.Position().Location().XYZ());
      set(space.numbers, 3, circle.Position().Direction().XYZ());
      set(space.numbers, 6, circle.Position().XDirection().XYZ());
      set(space.numbers, 9, circle.Position().YDirection().XYZ());
      space.numbers[12] = circle.Radius();
    } else {
      return {};
    }
    space.curve = found.Curve3D();
    return space;
  }
  return {};
}

/// An edge's curve in the parameters of a plane, visible only to BRep_Tool::CurveOnSurface() with this surface. Other
/// functions that go through the curves of an edge do not see it, and so they do not derive anything from it. It
/// becomes invisible for good when the edge gets another curve in space. Each answer is a copy, which the caller may
/// change, as it may change curves that OpenCASCADE makes.
class KnownCurve final : public BRep_CurveOnSurface {
 public:
  /// Makes a curve that is never visible.
  KnownCurve(const Handle(Geom2d_Curve) & curve, const Handle(Geom_Surface) & plane)
      : BRep_CurveOnSurface(curve, plane, TopLoc_Location()) {}
  KnownCurve(const BRep_TEdge& edge, const SpaceCurve& space, const Handle(Geom2d_Curve) & curve,
             const Handle(Geom_Surface) & plane, const Handle(KnownCurve) & none)
      : BRep_CurveOnSurface(curve, plane, TopLoc_Location()), edge_(&edge), space_(space), copy_(none) {
    SetRange(space.first, space.last);
  }

  using BRep_CurveOnSurface::PCurve;
  [[nodiscard]] Standard_Boolean IsCurveOnSurface() const override { return Standard_False; }
  [[nodiscard]] Standard_Boolean IsCurveOnSurface(const Handle(Geom_Surface) & surface,
                                                  const TopLoc_Location& place) const override {
    if (edge_ == nullptr || surface != Surface() || !place.IsIdentity()) return Standard_False;
    return First() == space_.first && Last() == space_.last && curve_of(*edge_) == space_;
  }
  [[nodiscard]] const Handle(Geom2d_Curve) & PCurve() const override {
    answer_ = Handle(Geom2d_Curve)::DownCast(BRep_CurveOnSurface::PCurve()->Copy());
    return answer_;
  }
  /// It has no points that must follow its range.
  void Update() override {}
  /// A copy of the edge does not see it.
  [[nodiscard]] Handle(BRep_CurveRepresentation) Copy() const override;
  /// Makes it invisible from now on.
  void forget() { edge_ = nullptr; }

 private:
  const BRep_TEdge* edge_ = nullptr;
  SpaceCurve space_;
  Handle(KnownCurve) copy_;  // of all of a shape, since healing makes many
  mutable Handle(Geom2d_Curve) answer_;
};

Handle(BRep_CurveRepresentation) KnownCurve::Copy() const {
  if (copy_.IsNull()) return new KnownCurve(BRep_CurveOnSurface::PCurve(), Surface());
  return copy_.get();
}

BRep_TEdge& edge_in(const TopoDS_Shape& edge) { return static_cast<BRep_TEdge&>(*edge.TShape()); }

/// Gives the edges of a shape their curves on its planes, and takes them back.
class KnownCurvesOfShape {
 public:
  explicit KnownCurvesOfShape(const TopoDS_Shape& shape) {
    for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next()) {
      TopLoc_Location place;
      const Handle(Geom_Surface) surface = BRep_Tool::Surface(TopoDS::Face(faces.Current()), place);
      if (surface.IsNull() || surface->DynamicType() != STANDARD_TYPE(Geom_Plane) || !place.IsIdentity()) continue;
      for (TopExp_Explorer edges(faces.Current(), TopAbs_EDGE); edges.More(); edges.Next())
        give(TopoDS::Edge(edges.Current()), surface);
    }
  }
  ~KnownCurvesOfShape() {
    for (const Given& each : given_) {
      each.curve->forget();
      take_back(each.edge);
    }
  }
  KnownCurvesOfShape(const KnownCurvesOfShape&) = delete;
  KnownCurvesOfShape& operator=(const KnownCurvesOfShape&) = delete;

  /// Removes known curves from edges that healing made of edges with known curves.
  void take_from(const TopoDS_Shape& healed) {
    if (given_.empty() || healed.IsNull()) return;
    TopTools_IndexedMapOfShape edges;
    TopExp::MapShapes(healed, TopAbs_EDGE, edges);
    for (int i = 1; i <= edges.Extent(); ++i) take_back(edges(i));
  }

 private:
  void give(const TopoDS_Edge& edge, const Handle(Geom_Surface) & plane) {
    BRep_TEdge& inner = edge_in(edge);
    const SpaceCurve space = curve_of(inner);
    if (space.curve.IsNull() || !edge.Location().IsIdentity()) return;
    for (BRep_ListIteratorOfListOfCurveRepresentation it(inner.Curves()); it.More(); it.Next())
      if (it.Value()->IsCurveOnSurface(plane, TopLoc_Location())) return;
    try {
      double first = 0, last = 0;
      const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnPlane(edge, plane, TopLoc_Location(), first, last);
      if (curve.IsNull() || first != space.first || last != space.last) return;
      if (none_.IsNull()) none_ = new KnownCurve(curve, plane);
      const Handle(KnownCurve) known = new KnownCurve(inner, space, curve, plane, none_);
      given_.push_back({edge, known});
      inner.ChangeCurves().Append(known);
    } catch (const Standard_Failure&) {
      return;  // other callers get the same exception
    }
  }

  static void take_back(const TopoDS_Shape& edge) {
    BRep_ListOfCurveRepresentation& curves = edge_in(edge).ChangeCurves();
    for (BRep_ListIteratorOfListOfCurveRepresentation it(curves); it.More();)
      if (dynamic_cast<const KnownCurve*>(it.Value().get()) != nullptr)
        curves.Remove(it);
      else
        it.Next();
  }

  struct Given {
    TopoDS_Edge edge;
    Handle(KnownCurve) curve;
  };
  Handle(KnownCurve) none_;
  std::vector<Given> given_;
};

/// The previous curves, with such curves while it heals.
class Healer final : public XSAlgo_AlgoContainer {
 public:
  explicit Healer(const Handle(XSAlgo_AlgoContainer) & inner) : inner_(inner) {
    SetToolContainer(inner->ToolContainer());
  }

  void PrepareForTransfer() const override { inner_->PrepareForTransfer(); }
  [[nodiscard]] TopoDS_Shape ProcessShape(const TopoDS_Shape& shape, Standard_Real precision, Standard_Real tolerance,
                                          Standard_CString file, Standard_CString sequence,
                                          Handle(Standard_Transient) & info, const Message_ProgressRange& progress,
                                          Standard_Boolean non_manifold) const override {
    KnownCurvesOfShape known(shape);
    TopoDS_Shape healed =
        inner_->ProcessShape(shape, precision, tolerance, file, sequence, info, progress, non_manifold);
    known.take_from(healed);
    return healed;
  }
  [[nodiscard]] Standard_Boolean CheckPCurve(const TopoDS_Edge& edge, const TopoDS_Face& face, Standard_Real precision,
                                             Standard_Boolean seam) const override {
    return inner_->CheckPCurve(edge, face, precision, seam);
  }
  void MergeTransferInfo(const Handle(Transfer_TransientProcess) & process, const Handle(Standard_Transient) & info,
                         Standard_Integer first) const override {
    inner_->MergeTransferInfo(process, info, first);
  }
  void MergeTransferInfo(const Handle(Transfer_FinderProcess) & process,
                         const Handle(Standard_Transient) & info) const override {
    inner_->MergeTransferInfo(process, info);
  }

 private:
  Handle(XSAlgo_AlgoContainer) inner_;
};

}  // namespace

KnownCurves::KnownCurves() : before_(XSAlgo::AlgoContainer()) { XSAlgo::SetAlgoContainer(new Healer(before_)); }
KnownCurves::~KnownCurves() { XSAlgo::SetAlgoContainer(before_); }

}  // namespace carreau_occ
