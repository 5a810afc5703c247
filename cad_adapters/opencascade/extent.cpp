// SPDX-License-Identifier: BSD-3-Clause
#include "extent.h"

#include <BRepAdaptor_Surface.hxx>
#include <BRepBndLib.hxx>
#include <BRepTools.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Geom2d_Curve.hxx>
#include <Precision.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "face_check.h"
#include "faults.h"

namespace carreau_occ {
namespace {

/// A box of a face, by `add`; void when the face cannot be evaluated or is nowhere.
template <typename Add>
Bnd_Box box_by(Add&& add, const TopoDS_Shape& face) {
  Bnd_Box box;
  try {
    guarded([&] { add(face, box); });
  } catch (const Standard_Failure&) {
    return {};
  }
  return box.IsVoid() || usable(std::sqrt(box.SquareExtent())) ? box : Bnd_Box();
}

/// Box of a free-form face: of its boundary and of a grid inside it, whose extremes climb to those of the face.
/// OpenCASCADE's own search (particle swarms) takes a tenth of a second a face.
class FaceBox {
 public:
  FaceBox(const TopoDS_Face& face, Bnd_Box& box)
      : face_(face), surface_(face, Standard_False), inside_(face, Precision::PConfusion()), box_(box) {}

  void run() {
    for (TopExp_Explorer e(face_, TopAbs_EDGE); e.More(); e.Next()) add_edge(TopoDS::Edge(e.Current()));
    for (int side = 0; side < 6; ++side) climb_edge(side);
    double u1 = 0, u2 = 0, v1 = 0, v2 = 0;
    BRepTools::UVBounds(face_, u1, u2, v1, v2);
    const int m = cells_of(surface_.NbUIntervals(GeomAbs_C2)), n = cells_of(surface_.NbVIntervals(GeomAbs_C2));
    const double du = (u2 - u1) / m, dv = (v2 - v1) / n;
    for (int i = 0; i <= m; ++i)
      for (int j = 0; j <= n; ++j) {
        const gp_Pnt2d uv(u1 + i * du, v1 + j * dv);
        const gp_Pnt p = surface_.Value(uv.X(), uv.Y());
        if (reaches_out(p) && is_inside(uv)) take(p, {.uv = uv});
      }
    for (int side = 0; side < 6; ++side)
      if (highest_[side].curve.IsNull()) climb(side, du, dv);
  }

 private:
  static constexpr int least_cells = 24, most_cells = 200, points_on_edge = 32, halvings = 16;
  struct Extreme {
    double value = -std::numeric_limits<double>::infinity();
    gp_Pnt2d uv = {};
    Handle(Geom2d_Curve) curve = {};    // of the boundary, null: of the grid
    double t = 0, first = 0, last = 0;  // place on it, and its ends
  };

  // A spline may have a hill in each of its intervals.
  static int cells_of(int intervals) { return std::clamp(4 * intervals, least_cells, most_cells); }
  // Sides of the box: x, y, z upwards, then downwards.
  static double along(const gp_Pnt& p, int side) { return side < 3 ? p.Coord(side + 1) : -p.Coord(side - 2); }
  bool is_inside(gp_Pnt2d uv) { return inside_.Perform(uv) != TopAbs_OUT; }
  [[nodiscard]] bool reaches_out(const gp_Pnt& p) const {
    for (int side = 0; side < 6; ++side)
      if (along(p, side) > highest_[side].value) return true;
    return false;
  }
  void take(const gp_Pnt& p, const Extreme& from) {
    box_.Add(p);
    for (int side = 0; side < 6; ++side)
      if (const double value = along(p, side); value > highest_[side].value) {
        highest_[side] = from;
        highest_[side].value = value;
      }
  }
  void add_edge(const TopoDS_Edge& edge) {
    double a = 0, b = 0;
    const Handle(Geom2d_Curve) image = BRep_Tool::CurveOnSurface(edge, face_, a, b);
    if (image.IsNull()) return;
    for (int i = 0; i <= points_on_edge; ++i)
      take_on({.curve = image, .t = a + (b - a) * i / points_on_edge, .first = a, .last = b});
  }
  void take_on(Extreme place) {
    place.uv = place.curve->Value(place.t);
    take(surface_.Value(place.uv.X(), place.uv.Y()), place);
  }
  // Half a step of the samples, a quarter, ... on both sides of the best.
  void climb_edge(int side) {
    const Extreme sample = highest_[side];
    if (sample.curve.IsNull()) return;
    double step = (sample.last - sample.first) / points_on_edge;
    for (int halved = 0; halved < 2 * halvings; ++halved) {
      step /= 2;
      for (const double by : {-step, step}) {
        Extreme place = highest_[side];
        place.t = std::clamp(place.t + by, place.first, place.last);
        take_on(place);
      }
    }
  }
  void climb(int side, double du, double dv) {
    for (int halved = 0; halved < halvings;) {
      const gp_Pnt2d from = highest_[side].uv;
      bool higher = false;
      for (const auto& [i, j] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}) {
        const gp_Pnt2d uv(from.X() + i * du, from.Y() + j * dv);
        const gp_Pnt p = surface_.Value(uv.X(), uv.Y());
        if (along(p, side) > highest_[side].value && is_inside(uv)) take(p, {.uv = uv}), higher = true;
      }
      if (!higher) du /= 2, dv /= 2, ++halved;
    }
  }

  TopoDS_Face face_;
  BRepAdaptor_Surface surface_;
  BRepTopAdaptor_FClass2d inside_;
  Bnd_Box& box_;
  std::array<Extreme, 6> highest_;
};

bool is_elementary(const TopoDS_Face& face) {
  switch (BRepAdaptor_Surface(face, Standard_False).GetType()) {
    case GeomAbs_Plane:
    case GeomAbs_Cylinder:
    case GeomAbs_Cone:
    case GeomAbs_Sphere:
    case GeomAbs_Torus:
      return true;
    default:
      return false;
  }
}

bool holds(const Bnd_Box& outer, const Bnd_Box& inner) {
  if (outer.IsVoid() || inner.IsVoid()) return false;
  const gp_Pnt low = outer.CornerMin(), high = outer.CornerMax(), from = inner.CornerMin(), to = inner.CornerMax();
  return low.X() <= from.X() && low.Y() <= from.Y() && low.Z() <= from.Z() && to.X() <= high.X() &&
         to.Y() <= high.Y() && to.Z() <= high.Z();
}

}  // namespace

// Exact boxes cost much more than wide ones: only for faces whose wide box reaches out of what is known. Large faces
// first.
double diagonal_of(const TopoDS_Shape& shape) {
  const auto wide = [](const TopoDS_Shape& face, Bnd_Box& box) { BRepBndLib::Add(face, box, Standard_False); };
  const auto exact = [](const TopoDS_Shape& shape_of_face, Bnd_Box& box) {
    const TopoDS_Face face = TopoDS::Face(shape_of_face);
    if (is_elementary(face))
      BRepBndLib::AddOptimal(face, box, Standard_False, Standard_False);
    else
      FaceBox(face, box).run();
  };
  std::vector<std::pair<TopoDS_Shape, Bnd_Box>> faces;
  for (TopExp_Explorer f(shape, TopAbs_FACE); f.More(); f.Next())
    faces.emplace_back(f.Current(), box_by(wide, f.Current()));
  const auto extent = [](const Bnd_Box& box) { return box.IsVoid() ? 0 : box.SquareExtent(); };
  std::stable_sort(faces.begin(), faces.end(),
                   [&](const auto& a, const auto& b) { return extent(a.second) > extent(b.second); });
  Bnd_Box box;
  for (const auto& [face, around] : faces)
    if (!holds(box, around)) box.Add(box_by(exact, face));
  return box.IsVoid() ? 0 : std::sqrt(box.SquareExtent());
}

}  // namespace carreau_occ
