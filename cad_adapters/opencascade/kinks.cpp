// SPDX-License-Identifier: BSD-3-Clause
#include "kinks.h"

#include <BRepAdaptor_Surface.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>
#include <numbers>

#include "elementary_box.h"

namespace carreau_occ {
namespace {

constexpr double min_angle = 2;  // degrees
constexpr int places = 9;
constexpr double beside = 1e-7;  // of the interval on either side

struct Bend {
  double angle = 0;  // degrees
  bool torn = false;
};

/// Largest angle between the normals at both sides of a line, without places that have no normal. The surface is torn
/// where the sides are farther apart than the way between them is long.
Bend bend_at(const BRepAdaptor_Surface& surface, bool of_u, double before, double after, double from, double to) {
  constexpr double longer = 100, rounding = 1e-9;
  Bend bend;
  for (int i = 0; i < places; ++i) {
    const double along = from + (i + 0.5) / places * (to - from);
    gp_Pnt p, q;
    gp_Vec across;
    const auto normal = [&](double at, gp_Pnt& place) {
      gp_Vec du, dv;
      surface.D1(of_u ? at : along, of_u ? along : at, place, du, dv);
      across = of_u ? du : dv;
      return du.Crossed(dv);
    };
    const gp_Vec a = normal(before, p);
    double way = across.Magnitude() * std::abs(after - before);
    const gp_Vec b = normal(after, q);
    way = std::max(way, across.Magnitude() * std::abs(after - before));
    if (a.Magnitude() > gp::Resolution() && b.Magnitude() > gp::Resolution())
      bend.angle = std::max(bend.angle, a.Angle(b) * 180 / std::numbers::pi);
    const double far = std::max(p.XYZ().Modulus(), q.XYZ().Modulus());
    bend.torn = bend.torn || p.Distance(q) > longer * way + rounding * far;
  }
  return bend;
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
    const Bend bend = bend_at(surface, of_u, before, after, from, to);
    if (bend.angle > min_angle) kinks.push_back({of_u, ends(i), bend.angle, bend.torn});
  }
}

}  // namespace

std::vector<Kink> kinks_of(const TopoDS_Face& face) {
  if (is_elementary(face)) return {};  // the box of the face would take most of the time
  const BRepAdaptor_Surface surface(face);  // the box of the face, not of its surface
  std::vector<Kink> kinks;
  look_for(surface, true, kinks);
  look_for(surface, false, kinks);
  return kinks;
}

ClosingKink closing_kink_of(const TopoDS_Face& face) {
  if (is_elementary(face)) return {};
  const BRepAdaptor_Surface surface(face);
  ClosingKink kink{.low_u = surface.FirstUParameter(),
                   .high_u = surface.LastUParameter(),
                   .low_v = surface.FirstVParameter(),
                   .high_v = surface.LastVParameter()};
  const auto bends = [&](bool of_u, double low, double high, double period) {
    constexpr double rounding = 1e-9;
    if (std::abs(high - low - period) > rounding * period) return false;
    const double from = of_u ? kink.low_v : kink.low_u, to = of_u ? kink.high_v : kink.high_u;
    const double before = high - beside * period, after = low + beside * period;
    const Bend bend = bend_at(surface, of_u, before, after, from, to);
    return bend.angle > min_angle;
  };
  kink.of_u = surface.IsUPeriodic() && bends(true, kink.low_u, kink.high_u, surface.UPeriod());
  kink.of_v = surface.IsVPeriodic() && bends(false, kink.low_v, kink.high_v, surface.VPeriod());
  return kink;
}

}  // namespace carreau_occ
