// SPDX-License-Identifier: BSD-3-Clause
#include "changes/mirror_edges.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRep_Tool.hxx>
#include <Geom_Curve.hxx>
#include <TopExp.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gp_Ax2.hxx>
#include <gp_Trsf.hxx>
#include <stdexcept>
#include <string>
#include <vector>

#include "changes/shape_images.h"

namespace carreau_occ {
namespace {

// Places of an edge where its side of the plane is looked at, and halvings of an interval in which it changes.
constexpr int places = 64, halvings = 60;

TopTools_ListOfShape loose_edges(const TopoDS_Shape& shape) {
  TopTools_ListOfShape all, loose;
  add_parts(shape, TopAbs_EDGE, TopAbs_FACE, all);
  for (const TopoDS_Shape& edge : all)
    if (!BRep_Tool::Degenerated(TopoDS::Edge(edge))) loose.Append(edge);
  return loose;
}

class EdgeMirror {
 public:
  EdgeMirror(const gp_Pln& plane, bool above, double near) : plane_(plane), sign_(above ? 1 : -1), near_(near) {
    map_.SetMirror(gp_Ax2(plane.Location(), plane.Axis().Direction()));
  }

  MirroredEdges run(const TopoDS_Shape& shape, bool whole, double within) {
    MirroredEdges made;
    TopTools_ListOfShape mirrored, others;
    for (const TopoDS_Shape& each : loose_edges(shape)) {
      TopTools_ListOfShape images;
      for (const TopoDS_Edge& piece : pieces_of(TopoDS::Edge(each))) {
        const EdgeHeights heights = heights_of(piece);
        if (heights.low < -near_) {
          if (!whole) throw std::runtime_error("an edge of no face has a part on the side that the mirror images get");
          others.Append(piece);
          continue;
        }
        made.edges.Append(piece), images.Append(piece);
        if (heights.high <= near_) continue;  // in the plane
        const TopoDS_Shape image = BRepBuilderAPI_Transform(piece, map_, Standard_True).Shape();
        mirrored.Append(image), images.Append(image);
      }
      made.images.Bind(each, images);
    }
    if (whole) require_on(others, mirrored, within), require_on(mirrored, others, within);
    made.edges.Append(mirrored);
    return made;
  }

  [[nodiscard]] EdgeHeights heights_of(const TopoDS_Edge& edge) const {
    const BRepAdaptor_Curve curve(edge);
    EdgeHeights heights{height(curve, 0), height(curve, 0)};
    for (int i = 1; i <= places; ++i) {
      const double h = height(curve, i);
      heights.low = std::min(heights.low, h), heights.high = std::max(heights.high, h);
    }
    return heights;
  }

 private:
  [[nodiscard]] double height(const gp_Pnt& p) const { return sign_ * gp_Vec(plane_.Location(), p).Dot(gp_Vec(plane_.Axis().Direction())); }
  static double at(const BRepAdaptor_Curve& curve, int i) {
    return curve.FirstParameter() + (curve.LastParameter() - curve.FirstParameter()) * i / places;
  }
  [[nodiscard]] double height(const BRepAdaptor_Curve& curve, int i) const { return height(curve.Value(at(curve, i))); }

  // Parameters where the edge passes the plane, away from its ends.
  [[nodiscard]] std::vector<double> cuts_of(const BRepAdaptor_Curve& curve) const {
    std::vector<double> cuts;
    double last = 0, from = curve.FirstParameter();  // the last height off the plane, and its parameter
    for (int i = 0; i <= places; ++i) {
      const double h = height(curve, i);
      if (std::abs(h) <= near_) continue;
      if (last * h < 0) {
        double low = from, high = at(curve, i);
        for (int k = 0; k < halvings; ++k) {
          const double middle = (low + high) / 2;
          (height(curve.Value(middle)) * last > 0 ? low : high) = middle;
        }
        cuts.push_back((low + high) / 2);
      }
      last = h, from = at(curve, i);
    }
    return cuts;
  }

  [[nodiscard]] std::vector<TopoDS_Edge> pieces_of(const TopoDS_Edge& edge) const {
    double first = 0, last = 0;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
    const BRepAdaptor_Curve adaptor(edge);
    const std::vector<double> cuts = curve.IsNull() ? std::vector<double>{} : cuts_of(adaptor);
    if (cuts.empty()) return {edge};
    std::vector<TopoDS_Edge> pieces;
    TopoDS_Vertex begin = TopExp::FirstVertex(edge);
    for (std::size_t k = 0; k <= cuts.size(); ++k) {
      const bool is_last = k == cuts.size();
      const double from = k == 0 ? first : cuts[k - 1], to = is_last ? last : cuts[k];
      const TopoDS_Vertex end = is_last ? TopExp::LastVertex(edge) : vertex_in_plane(curve->Value(to));
      BRepBuilderAPI_MakeEdge piece(curve, begin, end, from, to);
      if (!piece.IsDone()) throw std::runtime_error("OpenCASCADE cannot cut an edge of no face by the mirror plane");
      pieces.push_back(TopoDS::Edge(piece.Edge()));
      begin = end;
    }
    return pieces;
  }

  [[nodiscard]] TopoDS_Vertex vertex_in_plane(const gp_Pnt& p) const {
    return BRepBuilderAPI_MakeVertex(p.Translated(-sign_ * height(p) * gp_Vec(plane_.Axis().Direction())));
  }

  void require_on(const TopTools_ListOfShape& edges, const TopTools_ListOfShape& images, double within) const {
    if (edges.IsEmpty()) return;
    const TopoDS_Shape all = compound_of(images);
    for (const TopoDS_Shape& edge : edges) {
      const BRepAdaptor_Curve curve(TopoDS::Edge(edge));
      for (const int i : {places / 5, places / 2, places - places / 7}) {
        const gp_Pnt p = curve.Value(at(curve, i));
        const bool none = images.IsEmpty();
        if (!none) {
          const TopoDS_Vertex vertex = BRepBuilderAPI_MakeVertex(p);
          const BRepExtrema_DistShapeShape distance(vertex, all);
          if (distance.IsDone() && distance.Value() <= within) continue;
        }
        char text[160];
        std::snprintf(text, sizeof text, "the body is not symmetric about the mirror plane: an edge of no face has no image at (%.6g, %.6g, %.6g)", p.X(), p.Y(), p.Z());
        throw std::runtime_error(text);
      }
    }
  }

  gp_Pln plane_;
  gp_Trsf map_;
  double sign_, near_;
};

}  // namespace

EdgeHeights heights_of_loose(const TopoDS_Shape& shape, const gp_Pln& plane) {
  EdgeHeights all;
  const EdgeMirror work(plane, true, 0);
  for (const TopoDS_Shape& edge : loose_edges(shape)) {
    const EdgeHeights one = work.heights_of(TopoDS::Edge(edge));
    all.low = std::min(all.low, one.low), all.high = std::max(all.high, one.high);
  }
  return all;
}

MirroredEdges mirror_loose(const TopoDS_Shape& shape, const gp_Pln& plane, bool above, bool whole, double near, double within) {
  return EdgeMirror(plane, above, near).run(shape, whole, within);
}

}  // namespace carreau_occ
