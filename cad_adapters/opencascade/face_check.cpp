#include "face_check.h"

#include <BRepAdaptor_Surface.hxx>
#include <BRepBndLib.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Pnt.hxx>
#include <gp_Pnt2d.hxx>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "faults.h"

namespace carreau_occ {
namespace {

constexpr int samples = 4;  // intervals of an edge

bool is_near(const gp_Pnt& p) { return usable(p.X()) && usable(p.Y()) && usable(p.Z()); }

bool usable_poles(const Geom_BSplineSurface& surface) {
  for (int i = 1; i <= surface.NbUPoles(); ++i)
    for (int j = 1; j <= surface.NbVPoles(); ++j)
      if (!is_near(surface.Pole(i, j)) || !usable(surface.Weight(i, j))) return false;
  return true;
}

}  // namespace

bool usable(double x) noexcept { return std::abs(x) <= largest_coordinate; }

void refuse_unusable(const TopoDS_Face& face) {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::runtime_error(std::string(what) + " is not finite, or beyond 1e15");
  };
  for (TopExp_Explorer v(face, TopAbs_VERTEX); v.More(); v.Next()) {
    const TopoDS_Vertex vertex = TopoDS::Vertex(v.Current());
    require(is_near(BRep_Tool::Pnt(vertex)), "a vertex");
    require(usable(BRep_Tool::Tolerance(vertex)), "the tolerance of a vertex");
  }
  const auto spline = Handle(Geom_BSplineSurface)::DownCast(BRep_Tool::Surface(face));
  require(spline.IsNull() || usable_poles(*spline), "a pole of the surface");
  const BRepAdaptor_Surface surface(face, Standard_False);
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
    double a = 0, b = 0;
    const Handle(Geom2d_Curve) image = BRep_Tool::CurveOnSurface(TopoDS::Edge(e.Current()), face, a, b);
    for (int i = 0; i <= samples && !image.IsNull(); ++i) {
      const gp_Pnt2d uv = image->Value(a + (b - a) * i / samples);
      require(usable(uv.X()) && usable(uv.Y()) && is_near(surface.Value(uv.X(), uv.Y())), "the boundary");
    }
  }
}

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

bool holds(const Bnd_Box& outer, const Bnd_Box& inner) {
  if (outer.IsVoid() || inner.IsVoid()) return false;
  const gp_Pnt low = outer.CornerMin(), high = outer.CornerMax(), from = inner.CornerMin(), to = inner.CornerMax();
  return low.X() <= from.X() && low.Y() <= from.Y() && low.Z() <= from.Z() && to.X() <= high.X() &&
         to.Y() <= high.Y() && to.Z() <= high.Z();
}

}  // namespace

// Exact boxes are searched for by OpenCASCADE, at a thousand times the cost of wide ones: only for faces whose wide box
// reaches out of what is known. Large faces first.
double diagonal_of(const TopoDS_Shape& shape) {
  const auto wide = [](const TopoDS_Shape& face, Bnd_Box& box) { BRepBndLib::Add(face, box, Standard_False); };
  const auto exact = [](const TopoDS_Shape& face, Bnd_Box& box) {
    BRepBndLib::AddOptimal(face, box, Standard_False, Standard_False);
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
