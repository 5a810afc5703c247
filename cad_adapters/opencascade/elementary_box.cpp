// SPDX-License-Identifier: BSD-3-Clause
#include "elementary_box.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepBndLib.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <ElSLib.hxx>
#include <Precision.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "box_sides.h"

namespace carreau_occ {
namespace {

/// Box of an elementary face. Coordinates of planes, cylinders and cones have their extremes on the boundary of the
/// face, since they are stationary only along whole lines. Coordinates of spheres and tori also have an extreme where
/// the normal is along the axis. OpenCASCADE's search (particle swarms for tori) takes hundreds of times as long.
class ElementaryBox {
 public:
  ElementaryBox(const TopoDS_Face& face, const Bnd_Box& known, Bnd_Box& box)
      : face_(face), surface_(face, Standard_False), reached_(sides_of(known)), box_(box) {}

  void run() {
    int edges = 0;
    for (TopExp_Explorer e(face_, TopAbs_EDGE); e.More(); e.Next(), ++edges) add_edge(TopoDS::Edge(e.Current()));
    if (edges == 0) return BRepBndLib::AddOptimal(face_, box_, Standard_False, Standard_False);
    if (surface_.GetType() == GeomAbs_Sphere) add_sphere();
    if (surface_.GetType() == GeomAbs_Torus) add_torus();
  }

 private:
  static constexpr int parts_of_edge = 32, halvings = 32;

  [[nodiscard]] bool reaches_out(const gp_Pnt& p) const {
    for (int side = 0; side < 6; ++side)
      if (along(p, side) > reached_[side]) return true;
    return false;
  }
  void take(const gp_Pnt& p) {
    box_.Add(p);
    for (int side = 0; side < 6; ++side) reached_[side] = std::max(reached_[side], along(p, side));
  }

  void add_edge(const TopoDS_Edge& edge) {
    const BRepAdaptor_Curve curve(edge);
    const double first = curve.FirstParameter(), last = curve.LastParameter();
    take(curve.Value(first));
    take(curve.Value(last));
    if (curve.GetType() == GeomAbs_Line) return;
    std::array<gp_Pnt, parts_of_edge + 1> samples;
    double longest = 0;
    for (int i = 0; i <= parts_of_edge; ++i) {
      samples[i] = curve.Value(i < parts_of_edge ? first + (last - first) * i / parts_of_edge : last);
      if (i > 0) longest = std::max(longest, samples[i].Distance(samples[i - 1]));
    }
    for (int side = 0; side < 6; ++side) {
      const auto best = std::max_element(samples.begin(), samples.end(), [side](const gp_Pnt& a, const gp_Pnt& b) {
        return along(a, side) < along(b, side);
      });
      // Between two samples no smooth edge rises by more than a step.
      if (along(*best, side) + longest > reached_[side])
        climb(curve, side, first + (last - first) * static_cast<double>(best - samples.begin()) / parts_of_edge);
    }
  }
  void climb(const BRepAdaptor_Curve& curve, int side, double t) {
    const double first = curve.FirstParameter(), last = curve.LastParameter();
    double step = (last - first) / parts_of_edge;
    gp_Pnt highest = curve.Value(t);
    for (int halved = 0; halved < halvings; ++halved) {
      step /= 2;
      const double from = t;
      for (const double by : {-step, step}) {
        const double at = std::clamp(from + by, first, last);
        const gp_Pnt p = curve.Value(at);
        if (along(p, side) > along(highest, side)) highest = p, t = at;
      }
    }
    if (reaches_out(highest)) take(highest);
  }

  void add_sphere() {
    const gp_Sphere sphere = surface_.Sphere();
    for (int side = 0; side < 6; ++side) {
      const gp_Pnt p = sphere.Location().Translated(direction(side).Multiplied(sphere.Radius()));
      double u = 0, v = 0;
      ElSLib::Parameters(sphere, p, u, v);
      take_if_inside(p, u, v);
    }
  }
  void add_torus() {
    const gp_Torus torus = surface_.Torus();
    const gp_Vec axis(torus.Axis().Direction());
    for (int side = 0; side < 6; ++side) {
      const gp_Vec d = direction(side);
      gp_Vec outwards = d - axis.Multiplied(axis.Dot(d));
      if (outwards.Magnitude() < 1e-12) continue;  // the axis: a whole circle, which the boundary crosses
      outwards.Normalize();
      for (const double sign : {1.0, -1.0}) {
        const gp_Pnt p = torus.Location().Translated(outwards * (sign * torus.MajorRadius()) + d * torus.MinorRadius());
        double u = 0, v = 0;
        ElSLib::Parameters(torus, p, u, v);
        take_if_inside(p, u, v);
      }
    }
  }
  void take_if_inside(const gp_Pnt& p, double u, double v) {
    if (!reaches_out(p)) return;
    if (!inside_) inside_.emplace(face_, Precision::PConfusion());
    if (inside_->Perform(gp_Pnt2d(u, v)) != TopAbs_OUT) take(p);
  }

  TopoDS_Face face_;
  BRepAdaptor_Surface surface_;
  std::optional<BRepTopAdaptor_FClass2d> inside_;  // once asked
  BoxSides reached_;
  Bnd_Box& box_;
};

}  // namespace

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

void add_elementary(const TopoDS_Face& face, const Bnd_Box& known, Bnd_Box& box) {
  ElementaryBox(face, known, box).run();
}

}  // namespace carreau_occ
