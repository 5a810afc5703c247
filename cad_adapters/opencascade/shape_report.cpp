// SPDX-License-Identifier: BSD-3-Clause
#include "shape_report.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <GCPnts_AbscissaPoint.hxx>
#include <GProp_GProps.hxx>
#include <Geom2d_Curve.hxx>
#include <Precision.hxx>
#include <ShapeAnalysis_Curve.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gp_Pnt2d.hxx>
#include <map>

#include "extent.h"
#include "face_figures.h"
#include "faults.h"
#include "kinks.h"

namespace carreau_occ {
namespace {

constexpr int gap_samples = 9;

class Inspector {
 public:
  explicit Inspector(const ShapeFile& file) : shape_(file.shape) {
    TopExp::MapShapes(shape_, TopAbs_FACE, faces_);
    TopExp::MapShapes(shape_, TopAbs_EDGE, edges_);
  }

  ShapeReport run(double tiny) {
    report_.diagonal = diagonal_of(shape_);
    limit_ = tiny * report_.diagonal;
    count();
    for (int f = 1; f <= faces_.Extent(); ++f) guarded("face", f, 0, [&] { look_at_face(f); });
    for (int e = 1; e <= edges_.Extent(); ++e) guarded("edge", 0, e, [&] { look_at_edge(e); });
    for (const auto& [name, n] : kinds_) report_.surfaces.emplace_back(name, n);
    std::stable_sort(report_.dangers.begin(), report_.dangers.end(), [](const Danger& a, const Danger& b) {
      if (a.kind != b.kind) return a.kind < b.kind;
      const bool largest_first = a.kind == "gap" || a.kind == "kink" || a.kind == "wide tolerance";
      return largest_first ? a.value > b.value : a.value < b.value;
    });
    return std::move(report_);
  }

  std::vector<Danger> kinks() {
    for (int f = 1; f <= faces_.Extent(); ++f)
      guarded("face", f, 0, [&] { look_for_kinks(f, TopoDS::Face(faces_(f))); });
    std::erase_if(report_.dangers, [](const Danger& danger) { return danger.kind != "kink"; });
    return std::move(report_.dangers);
  }

  Gaps gaps() {
    uses_.assign(static_cast<std::size_t>(edges_.Extent()) + 1, {});
    for (int f = 1; f <= faces_.Extent(); ++f)
      for (TopExp_Explorer e(faces_(f).Oriented(TopAbs_FORWARD), TopAbs_EDGE); e.More(); e.Next())
        uses_[static_cast<std::size_t>(edges_.FindIndex(e.Current()))].push_back(f);
    Gaps gaps;
    for (int e = 1; e <= edges_.Extent(); ++e)
      guarded("edge", 0, e, [&] {
        const TopoDS_Edge edge = TopoDS::Edge(edges_(e));
        if (BRep_Tool::Degenerated(edge)) return;
        const auto [gap, face] = gap_of(e, edge, BRepAdaptor_Curve(edge));
        if (gap > 2 * BRep_Tool::Tolerance(edge)) ++gaps.beyond;
        if (gap > gaps.largest) gaps.largest = gap, gaps.edge = e, gaps.face = face;
      });
    return gaps;
  }

 private:
  template <typename Body>
  void guarded(const char* what, int face, int edge, Body&& body) {
    try {
      carreau_occ::guarded(body);
    } catch (const Standard_Failure& failure) {
      add({std::string("broken ") + what, face, edge, 0, std::string("OpenCASCADE: ") + failure.GetMessageString()});
    }
  }
  void add(Danger danger) { report_.dangers.push_back(std::move(danger)); }

  void count() {
    const auto number_of = [&](TopAbs_ShapeEnum kind) {
      TopTools_IndexedMapOfShape map;
      TopExp::MapShapes(shape_, kind, map);
      return map.Extent();
    };
    report_.solids = number_of(TopAbs_SOLID), report_.shells = number_of(TopAbs_SHELL);
    report_.faces = faces_.Extent(), report_.edges = edges_.Extent(), report_.vertices = number_of(TopAbs_VERTEX);
    report_.shortest_edge = report_.diagonal;
    uses_.assign(static_cast<std::size_t>(edges_.Extent()) + 1, {});
    for (TopExp_Explorer e(shape_, TopAbs_SOLID); e.More(); e.Next())
      guarded("solid", 0, 0, [&] {
        GProp_GProps properties;
        BRepGProp::VolumeProperties(e.Current(), properties);
        report_.volume += properties.Mass();
      });
  }

  void look_at_face(int number) {
    const TopoDS_Face face = TopoDS::Face(faces_(number));
    int wires = 0;
    double around = 0;
    for (TopExp_Explorer w(face, TopAbs_WIRE); w.More(); w.Next()) ++wires;
    report_.inner_wires += std::max(0, wires - 1);
    std::map<int, int> times;
    for (TopExp_Explorer e(face.Oriented(TopAbs_FORWARD), TopAbs_EDGE); e.More(); e.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(e.Current());
      const int index = edges_.FindIndex(edge);
      if (edge.Orientation() == TopAbs_INTERNAL)
        ++report_.internal_edges;
      else if (edge.Orientation() != TopAbs_EXTERNAL && ++times[index] == 2)
        ++report_.seams;
      uses_[static_cast<std::size_t>(index)].push_back(number);
      if (!BRep_Tool::Degenerated(edge)) around += GCPnts_AbscissaPoint::Length(BRepAdaptor_Curve(edge), 1e-6);
    }
    const BRepAdaptor_Surface surface(face, Standard_False);
    ++kinds_[kind_name(surface.GetType())];
    GProp_GProps properties;
    BRepGProp::SurfaceProperties(face, properties);
    report_.area += properties.Mass();
    const double width = around > 0 ? 2 * std::abs(properties.Mass()) / around : report_.diagonal;
    if (!(width >= limit_)) add({"sliver face", number, 0, width, "about as narrow"});
    const BRepCheck_Analyzer check(face);
    if (!check.IsValid()) add({"invalid face", number, 0, 0, "OpenCASCADE's own check rejects it"});
    look_for_kinks(number, face);
  }

  void look_for_kinks(int number, const TopoDS_Face& face) {
    const std::vector<Kink> kinks = kinks_of(face);
    if (kinks.empty()) return;
    const Kink& sharpest =
        *std::max_element(kinks.begin(), kinks.end(), [](const Kink& a, const Kink& b) { return a.angle < b.angle; });
    char text[120];
    std::snprintf(text, sizeof text, "degrees of bend inside it, at %s = %.6g%s", sharpest.of_u ? "u" : "v",
                  sharpest.at, kinks.size() > 1 ? " (the sharpest of several)" : "");
    add({"kink", number, 0, sharpest.angle, text});
  }

  void look_at_edge(int number) {
    const TopoDS_Edge edge = TopoDS::Edge(edges_(number));
    const std::vector<int>& uses = uses_[static_cast<std::size_t>(number)];
    const double tolerance = BRep_Tool::Tolerance(edge);
    report_.largest_tolerance = std::max(report_.largest_tolerance, tolerance);
    if (tolerance > limit_) add({"wide tolerance", 0, number, tolerance, "is the tolerance of the edge"});
    if (BRep_Tool::Degenerated(edge)) {
      ++report_.poles;
      return;
    }
    const BRepAdaptor_Curve curve(edge);
    const double length = GCPnts_AbscissaPoint::Length(curve, 1e-6);
    report_.shortest_edge = std::min(report_.shortest_edge, length);
    if (length < limit_) add({"tiny edge", 0, number, length, "long"});
    TopoDS_Vertex first, last;
    TopExp::Vertices(edge, first, last);
    if (!first.IsNull() && first.IsSame(last)) ++report_.closed_edges;
    if (uses.empty())
      add({"loose edge", 0, number, 0, "belongs to no face: its mesh has edges alone"});
    else if (uses.size() == 1)
      add({"free edge", uses.front(), number, 1, "has one face only"});
    else if (uses.size() > 2)
      add({"crowded edge", 0, number, static_cast<double>(uses.size()), "faces share it"});
    measure_gap(number, edge, curve);
  }

  void measure_gap(int number, const TopoDS_Edge& edge, const BRepAdaptor_Curve& curve) {
    const auto [gap, where] = gap_of(number, edge, curve);
    report_.largest_gap = std::max(report_.largest_gap, gap);
    if (gap > limit_ || gap > 2 * BRep_Tool::Tolerance(edge))
      add({"gap", where, number, gap, "between the curve of the edge and its image on the face"});
  }

  /// Largest distance, and the face where it is.
  std::pair<double, int> gap_of(int number, const TopoDS_Edge& edge, const BRepAdaptor_Curve& curve) const {
    double gap = 0;
    int where = 0;
    for (const int f : uses_[static_cast<std::size_t>(number)]) {
      const TopoDS_Face face = TopoDS::Face(faces_(f));
      double a = 0, b = 0;
      const Handle(Geom2d_Curve) image = BRep_Tool::CurveOnSurface(edge, face, a, b);
      if (image.IsNull()) continue;
      const BRepAdaptor_Surface surface(face, Standard_False);
      const double from = curve.FirstParameter(), to = curve.LastParameter();
      for (int i = 0; i <= gap_samples; ++i) {
        const double w = static_cast<double>(i) / gap_samples;
        const gp_Pnt2d uv = image->Value(a + w * (b - a));
        const gp_Pnt place = surface.Value(uv.X(), uv.Y());
        double distance = place.Distance(curve.Value(from + w * (to - from)));
        if (distance > gap && distance > BRep_Tool::Tolerance(edge)) {
          // The two may run along each other at different paces, which leaves no gap.
          gp_Pnt nearest;
          double at = 0;
          distance =
              std::min(distance, ShapeAnalysis_Curve().Project(curve, place, Precision::Confusion(), nearest, at));
        }
        if (distance > gap) gap = distance, where = f;
      }
    }
    return {gap, where};
  }

  TopoDS_Shape shape_;
  double limit_ = 0;
  TopTools_IndexedMapOfShape faces_, edges_;
  std::vector<std::vector<int>> uses_;  // [edge number]: faces, one entry a use
  std::map<std::string, int> kinds_;
  ShapeReport report_;
};

}  // namespace

Gaps measure_gaps(const ShapeFile& file) { return Inspector(file).gaps(); }

std::vector<Danger> find_kinks(const ShapeFile& file) { return Inspector(file).kinks(); }

ShapeReport inspect(const ShapeFile& file, double tiny) { return Inspector(file).run(tiny); }

}  // namespace carreau_occ
