// SPDX-License-Identifier: BSD-3-Clause
#include "zero_edges.h"

#include <StepGeom_BSplineCurve.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_Circle.hxx>
#include <StepGeom_Curve.hxx>
#include <StepGeom_HArray1OfCartesianPoint.hxx>
#include <StepGeom_Line.hxx>
#include <StepGeom_Polyline.hxx>
#include <StepGeom_SurfaceCurve.hxx>
#include <StepGeom_TrimmedCurve.hxx>
#include <StepShape_EdgeCurve.hxx>
#include <StepShape_EdgeLoop.hxx>
#include <StepShape_HArray1OfOrientedEdge.hxx>
#include <StepShape_OrientedEdge.hxx>
#include <StepShape_Vertex.hxx>
#include <StepShape_VertexPoint.hxx>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "entity_kinds.h"

namespace carreau_occ {
namespace {

using Vertex = Handle(StepShape_Vertex);

/// True for coordinates that differ by rounding of the printed numbers.
bool at_one_place(const Handle(StepGeom_CartesianPoint) & p, const Handle(StepGeom_CartesianPoint) & q) {
  constexpr double rounding = 1e-13;
  if (p.IsNull() || q.IsNull() || p->NbCoordinates() != 3 || q->NbCoordinates() != 3) return false;
  double size = 0, gap = 0;
  for (int i = 1; i <= 3; ++i) {
    size = std::max({size, std::abs(p->CoordinatesValue(i)), std::abs(q->CoordinatesValue(i))});
    gap = std::max(gap, std::abs(p->CoordinatesValue(i) - q->CoordinatesValue(i)));
  }
  return gap <= rounding * size;
}

Handle(StepGeom_CartesianPoint) place_of(const Vertex& vertex) {
  const auto point = Handle(StepShape_VertexPoint)::DownCast(vertex);
  return point.IsNull() ? nullptr : Handle(StepGeom_CartesianPoint)::DownCast(point->VertexGeometry());
}

bool are_one_place(const Handle(StepGeom_HArray1OfCartesianPoint) & points) {
  if (points.IsNull() || points->Length() == 0) return false;
  for (const Handle(StepGeom_CartesianPoint) & point : *points)
    if (!at_one_place(points->First(), point)) return false;
  return true;
}

/// Between two ends at one place. Other curves may come back to where they began.
bool is_a_point(const Handle(StepGeom_Curve) & curve) {
  if (const auto on_surface = Handle(StepGeom_SurfaceCurve)::DownCast(curve); !on_surface.IsNull())
    return is_a_point(on_surface->Curve3d());
  if (const auto trimmed = Handle(StepGeom_TrimmedCurve)::DownCast(curve); !trimmed.IsNull())
    return is_a_point(trimmed->BasisCurve());
  if (!Handle(StepGeom_Line)::DownCast(curve).IsNull()) return true;
  if (const auto polyline = Handle(StepGeom_Polyline)::DownCast(curve); !polyline.IsNull())
    return are_one_place(polyline->Points());
  if (const auto spline = Handle(StepGeom_BSplineCurve)::DownCast(curve); !spline.IsNull())
    return are_one_place(spline->ControlPointsList());
  const auto circle = Handle(StepGeom_Circle)::DownCast(curve);
  return !circle.IsNull() && circle->Radius() == 0;
}

class ZeroEdges {
 public:
  explicit ZeroEdges(const Handle(Interface_InterfaceModel) & model) : model_(model) {}

  void run() {
    for_each<StepShape_EdgeCurve>([&](const Handle(StepShape_EdgeCurve) & edge) {
      const Vertex from = edge->EdgeStart(), to = edge->EdgeEnd();
      if (!at_one_place(place_of(from), place_of(to)) || !is_a_point(edge->EdgeGeometry())) return;
      edges_.insert(edge.get());
      if (from != to) stands_for_[representative(to).get()] = representative(from);
    });
    if (edges_.empty()) return;
    for_each<StepShape_EdgeLoop>([&](const Handle(StepShape_EdgeLoop) & loop) { shorten(loop); });
    for_each<StepShape_EdgeCurve>([&](const Handle(StepShape_EdgeCurve) & edge) {
      edge->SetEdgeStart(representative(edge->EdgeStart()));
      edge->SetEdgeEnd(representative(edge->EdgeEnd()));
    });
  }

 private:
  template <typename Type, typename Visit>
  void for_each(Visit&& visit) {
    for (int i = 1; i <= model_->NbEntities(); ++i)
      if (const auto entity = as<Type>(model_->Value(i)); !entity.IsNull()) visit(entity);
  }

  [[nodiscard]] Vertex representative(Vertex vertex) const {
    for (auto found = stands_for_.find(vertex.get()); found != stands_for_.end() && found->second != vertex;
         found = stands_for_.find(vertex.get()))
      vertex = found->second;
    return vertex;
  }

  void shorten(const Handle(StepShape_EdgeLoop) & loop) const {
    const Handle(StepShape_HArray1OfOrientedEdge) all = loop->EdgeList();
    if (all.IsNull()) return;
    std::vector<Handle(StepShape_OrientedEdge)> kept;
    for (const Handle(StepShape_OrientedEdge) & each : *all)
      if (each.IsNull() || !edges_.contains(each->EdgeElement().get())) kept.push_back(each);
    if (kept.empty() || static_cast<int>(kept.size()) == all->Length()) return;
    const Handle(StepShape_HArray1OfOrientedEdge) left =
        new StepShape_HArray1OfOrientedEdge(1, static_cast<int>(kept.size()));
    for (int i = 1; i <= left->Length(); ++i) left->SetValue(i, kept[static_cast<std::size_t>(i - 1)]);
    loop->SetEdgeList(left);
  }

  Handle(Interface_InterfaceModel) model_;
  std::set<const Standard_Transient*> edges_;
  std::map<const Standard_Transient*, Vertex> stands_for_;
};

}  // namespace

void take_out_zero_edges(const Handle(Interface_InterfaceModel) & model) {
  if (!model.IsNull()) ZeroEdges(model).run();
}

}  // namespace carreau_occ
