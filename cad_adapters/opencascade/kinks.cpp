#include "kinks.h"

#include <BRepAdaptor_Surface.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <algorithm>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>
#include <numbers>

namespace carreau_occ {
namespace {

constexpr double least_angle = 2;  // degrees
constexpr int places = 9;
constexpr double beside = 1e-7;  // of the interval on either side

/// Largest angle between the normals at both sides of a line; places without a normal say nothing.
double angle_at(const BRepAdaptor_Surface& surface, bool of_u, double before, double after, double from, double to) {
  double largest = 0;
  for (int i = 0; i < places; ++i) {
    const double along = from + (i + 0.5) / places * (to - from);
    const auto normal = [&](double across) {
      gp_Pnt p;
      gp_Vec du, dv;
      surface.D1(of_u ? across : along, of_u ? along : across, p, du, dv);
      return du.Crossed(dv);
    };
    const gp_Vec a = normal(before), b = normal(after);
    if (a.Magnitude() > gp::Resolution() && b.Magnitude() > gp::Resolution()) largest = std::max(largest, a.Angle(b));
  }
  return largest * 180 / std::numbers::pi;
}

void look_for(const BRepAdaptor_Surface& surface, bool of_u, std::vector<Kink>& kinks) {
  const int n = of_u ? surface.NbUIntervals(GeomAbs_C1) : surface.NbVIntervals(GeomAbs_C1);
  if (n < 2) return;
  TColStd_Array1OfReal ends(1, n + 1);
  if (of_u)
    surface.UIntervals(ends, GeomAbs_C1);
  else
    surface.VIntervals(ends, GeomAbs_C1);
  const double from = of_u ? surface.FirstVParameter() : surface.FirstUParameter();
  const double to = of_u ? surface.LastVParameter() : surface.LastUParameter();
  for (int i = 2; i <= n; ++i) {
    const double before = ends(i) - beside * (ends(i) - ends(i - 1)),
                 after = ends(i) + beside * (ends(i + 1) - ends(i));
    const double angle = angle_at(surface, of_u, before, after, from, to);
    if (angle > least_angle) kinks.push_back({of_u, ends(i), angle});
  }
}

}  // namespace

std::vector<Kink> kinks_of(const TopoDS_Face& face) {
  const BRepAdaptor_Surface surface(face);  // the box of the face, not of its surface
  std::vector<Kink> kinks;
  look_for(surface, true, kinks);
  look_for(surface, false, kinks);
  return kinks;
}

}  // namespace carreau_occ
