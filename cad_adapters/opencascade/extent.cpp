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
#include <optional>
#include <utility>
#include <vector>

#include "box_sides.h"
#include "elementary_box.h"
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

/// Box of a free-form face, made of its boundary and of a grid inside. Extremes of the grid climb to extremes of the
/// face if they may reach out of the known box. OpenCASCADE's own search (particle swarms) takes a tenth of a second a
/// face.
class FaceBox {
 public:
  FaceBox(const TopoDS_Face& face, const Bnd_Box& known, Bnd_Box& box)
      : face_(face), surface_(face, Standard_False), known_(sides_of(known)), box_(box) {}

  void run() {
    for (TopExp_Explorer e(face_, TopAbs_EDGE); e.More(); e.Next()) add_edge(TopoDS::Edge(e.Current()));
    for (int side = 0; side < 6; ++side) climb_edge(side);
    double u1 = 0, u2 = 0, v1 = 0, v2 = 0;
    BRepTools::UVBounds(face_, u1, u2, v1, v2);
    const int m = cells_of(surface_.NbUIntervals(GeomAbs_C2)), n = cells_of(surface_.NbVIntervals(GeomAbs_C2));
    const double du = (u2 - u1) / m, dv = (v2 - v1) / n;
    std::vector<Sample> samples;
    for (int i = 0; i <= m; ++i)
      for (int j = 0; j <= n; ++j) {
        const gp_Pnt2d uv(u1 + i * du, v1 + j * dv);
        samples.push_back({surface_.Value(uv.X(), uv.Y()), uv});
      }
    const double step = longest_step(samples, static_cast<std::size_t>(n) + 1);
    for (int side = 0; side < 6; ++side) take_highest(side, step, samples);
    for (int side = 0; side < 6; ++side)
      if (highest_[side].from_grid) climb(side, du, dv);
  }

 private:
  static constexpr int min_cells = 24, max_cells = 200, points_on_edge = 32, halvings = 16;
  static constexpr int max_moves = 1'000;  // real faces need up to 30
  struct Extreme {
    double value = -std::numeric_limits<double>::infinity();
    gp_Pnt2d uv = {};
    bool from_grid = false;
    Handle(Geom2d_Curve) curve = {};    // else, of the boundary
    double t = 0, first = 0, last = 0;  // place on it, and its ends
  };
  struct Sample {
    gp_Pnt at;
    gp_Pnt2d uv;
  };

  // A spline may have a hill in each of its intervals.
  static int cells_of(int intervals) { return std::clamp(4 * intervals, min_cells, max_cells); }
  // Finding the faces outside costs more than their places.
  bool is_inside(gp_Pnt2d uv) {
    if (!inside_) {
      inside_.emplace(face_, Precision::PConfusion());
      outside_ = inside_->PerformInfinitePoint();
    }
    return inside_->Perform(uv) != outside_;
  }
  static double longest_step(const std::vector<Sample>& samples, std::size_t row) {
    double longest = 0;
    for (std::size_t k = 0; k < samples.size(); ++k) {
      if (k % row > 0) longest = std::max(longest, samples[k].at.SquareDistance(samples[k - 1].at));
      if (k >= row) longest = std::max(longest, samples[k].at.SquareDistance(samples[k - row].at));
    }
    return std::sqrt(longest);
  }
  void take(const gp_Pnt& p, const Extreme& from) {
    box_.Add(p);
    for (int side = 0; side < 6; ++side)
      if (const double value = along(p, side); value > highest_[side].value) {
        highest_[side] = from;
        highest_[side].value = value;
      }
  }
  // Takes the highest sample that is inside, if the face may rise above the known box within a step of it.
  void take_highest(int side, double step, const std::vector<Sample>& samples) {
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < samples.size(); ++k)
      if (along(samples[k].at, side) > std::max(highest_[side].value, known_[side] - step)) order.push_back(k);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return along(samples[a].at, side) > along(samples[b].at, side);
    });
    for (const std::size_t k : order)
      if (is_inside(samples[k].uv)) return take(samples[k].at, {.uv = samples[k].uv, .from_grid = true});
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
    for (int halved = 0, moves = 0; halved < halvings && moves < max_moves; ++moves) {
      const gp_Pnt2d from = highest_[side].uv;
      bool higher = false;
      for (const auto& [i, j] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}) {
        const gp_Pnt2d uv(from.X() + i * du, from.Y() + j * dv);
        const gp_Pnt p = surface_.Value(uv.X(), uv.Y());
        if (along(p, side) > highest_[side].value && is_inside(uv))
          take(p, {.uv = uv, .from_grid = true}), higher = true;
      }
      if (!higher) du /= 2, dv /= 2, ++halved;
    }
  }

  TopoDS_Face face_;
  BRepAdaptor_Surface surface_;
  std::optional<BRepTopAdaptor_FClass2d> inside_;  // once asked
  TopAbs_State outside_ = TopAbs_OUT;              // IN when the loops are turned the wrong way
  BoxSides known_;
  Bnd_Box& box_;
  std::array<Extreme, 6> highest_;
};

bool holds(const Bnd_Box& outer, const Bnd_Box& inner) {
  if (outer.IsVoid() || inner.IsVoid()) return false;
  const gp_Pnt low = outer.CornerMin(), high = outer.CornerMax(), from = inner.CornerMin(), to = inner.CornerMax();
  return low.X() <= from.X() && low.Y() <= from.Y() && low.Z() <= from.Z() && to.X() <= high.X() &&
         to.Y() <= high.Y() && to.Z() <= high.Z();
}

}  // namespace

// Exact boxes cost much more than wide ones: only for faces whose wide box reaches out of the known box. Large faces
// first.
double diagonal_of(const TopoDS_Shape& shape) {
  const auto wide = [](const TopoDS_Shape& face, Bnd_Box& box) { BRepBndLib::Add(face, box, Standard_False); };
  std::vector<std::pair<TopoDS_Shape, Bnd_Box>> faces;
  for (TopExp_Explorer f(shape, TopAbs_FACE); f.More(); f.Next())
    faces.emplace_back(f.Current(), box_by(wide, f.Current()));
  const auto extent = [](const Bnd_Box& box) { return box.IsVoid() ? 0 : box.SquareExtent(); };
  std::stable_sort(faces.begin(), faces.end(),
                   [&](const auto& a, const auto& b) { return extent(a.second) > extent(b.second); });
  Bnd_Box box;
  for (const auto& face_and_box : faces) {
    const Bnd_Box& around = face_and_box.second;
    if (holds(box, around)) continue;
    const auto exact = [&](const TopoDS_Shape& shape_of_face, Bnd_Box& of_face) {
      const TopoDS_Face face = TopoDS::Face(shape_of_face);
      if (is_elementary(face))
        add_elementary(face, box, of_face);
      else
        FaceBox(face, box, of_face).run();
    };
    box.Add(box_by(exact, face_and_box.first));
  }
  return box.IsVoid() ? 0 : std::sqrt(box.SquareExtent());
}

}  // namespace carreau_occ
