// SPDX-License-Identifier: BSD-3-Clause
#include "loose_edges.h"

#include <BRep_Tool.hxx>
#include <Precision.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <limits>
#include <optional>

namespace carreau_occ {

namespace {

Breaks breaks_of(const BRepAdaptor_Curve& curve) {
  const int n = curve.NbIntervals(GeomAbs_CN);
  TColStd_Array1OfReal at(1, n + 1);
  curve.Intervals(at, GeomAbs_CN);
  return {{at.begin(), at.end()}, curve.IsPeriodic() == Standard_True, curve.IsPeriodic() ? curve.Period() : 0};
}

/// Vertices by place.
class NearVertices {
 public:
  explicit NearVertices(const TopTools_IndexedMapOfShape& vertices) {
    for (int v = 1; v <= vertices.Extent(); ++v) {
      const TopoDS_Vertex vertex = TopoDS::Vertex(vertices(v));
      all_.push_back({BRep_Tool::Pnt(vertex), BRep_Tool::Tolerance(vertex), v});
      widest_ = std::max(widest_, all_.back().tolerance);
    }
    std::sort(all_.begin(), all_.end(), [](const Place& p, const Place& q) { return p.at.X() < q.at.X(); });
  }
  /// The smallest number of a vertex that is one with this one within both tolerances.
  [[nodiscard]] int first_at(const TopoDS_Vertex& vertex) const {
    const gp_Pnt at = BRep_Tool::Pnt(vertex);
    const double tolerance = BRep_Tool::Tolerance(vertex), reach = tolerance + widest_;
    auto near = std::lower_bound(all_.begin(), all_.end(), at.X() - reach,
                                 [](const Place& p, double x) { return p.at.X() < x; });
    int first = std::numeric_limits<int>::max();
    for (; near != all_.end() && near->at.X() <= at.X() + reach; ++near)
      if (near->at.Distance(at) <= tolerance + near->tolerance) first = std::min(first, near->number);
    return first;
  }

 private:
  struct Place {
    gp_Pnt at;
    double tolerance;
    int number;
  };
  std::vector<Place> all_;  // by x
  double widest_ = 0;
};

}  // namespace

std::vector<LooseEdge> find_loose_edges(const TopoDS_Shape& shape, const TopTools_IndexedMapOfShape& edges,
                                        const TopTools_IndexedMapOfShape& vertices) {
  TopTools_IndexedDataMapOfShapeListOfShape faces;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces);
  std::vector<LooseEdge> found;
  std::optional<NearVertices> near;
  for (int e = 1; e <= edges.Extent(); ++e) {
    if (!faces.Contains(edges(e)) || !faces.FindFromKey(edges(e)).IsEmpty()) continue;
    LooseEdge loose;
    loose.edge = TopoDS::Edge(edges(e).Oriented(TopAbs_FORWARD));
    loose.number = e;
    if (BRep_Tool::Degenerated(loose.edge) || !BRep_Tool::IsGeometric(loose.edge)) continue;
    const TopoDS_Vertex first = TopExp::FirstVertex(loose.edge), last = TopExp::LastVertex(loose.edge);
    if (first.IsNull() || last.IsNull()) continue;
    BRep_Tool::Range(loose.edge, loose.first, loose.last);
    if (Precision::IsInfinite(loose.first) || Precision::IsInfinite(loose.last) || !(loose.first < loose.last))
      continue;
    if (!near) near.emplace(vertices);
    loose.end1 = near->first_at(first), loose.end2 = near->first_at(last);
    if (loose.end1 == loose.end2 && !first.IsSame(last))
      loose.end1 = vertices.FindIndex(first), loose.end2 = vertices.FindIndex(last);
    found.push_back(std::move(loose));
  }
  return found;
}

void LooseCurves::set(const std::vector<LooseEdge>& edges) {
  for (const LooseEdge& each : edges) {
    edges_.push_back(each.edge);
    breaks_.push_back(breaks_of(BRepAdaptor_Curve(each.edge)));
  }
}

const BRepAdaptor_Curve& LooseCurves::mine(std::size_t edge) {
  auto& all = of_thread_.local();
  if (all.size() < edges_.size()) all.resize(edges_.size());
  if (!all[edge]) all[edge] = std::make_unique<BRepAdaptor_Curve>(edges_[edge]);
  return *all[edge];
}

void LooseCurves::evaluate(std::size_t edge, double t, int order, gp_Pnt& p, gp_Vec& d1, gp_Vec& d2) {
  const BRepAdaptor_Curve& curve = mine(edge);
  t = breaks_[edge].settle(t);
  if (order >= 2)
    curve.D2(t, p, d1, d2);
  else if (order == 1)
    curve.D1(t, p, d1);
  else
    curve.D0(t, p);
}

}  // namespace carreau_occ
