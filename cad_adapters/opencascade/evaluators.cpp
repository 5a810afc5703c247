// SPDX-License-Identifier: BSD-3-Clause
#include "evaluators.h"

#include <TColStd_Array1OfReal.hxx>
#include <algorithm>
#include <cmath>
#include <limits>

namespace carreau_occ {
namespace {

std::vector<double> values_of(const TColStd_Array1OfReal& array) { return {array.begin(), array.end()}; }

Breaks breaks_in_u(const BRepAdaptor_Surface& surface) {
  const int n = surface.NbUIntervals(GeomAbs_CN);
  TColStd_Array1OfReal at(1, n + 1);
  surface.UIntervals(at, GeomAbs_CN);
  return {values_of(at), surface.IsUPeriodic() == Standard_True, surface.IsUPeriodic() ? surface.UPeriod() : 0};
}

Breaks breaks_in_v(const BRepAdaptor_Surface& surface) {
  const int n = surface.NbVIntervals(GeomAbs_CN);
  TColStd_Array1OfReal at(1, n + 1);
  surface.VIntervals(at, GeomAbs_CN);
  return {values_of(at), surface.IsVPeriodic() == Standard_True, surface.IsVPeriodic() ? surface.VPeriod() : 0};
}

Breaks breaks_of(const Geom2dAdaptor_Curve& curve) {
  const int n = curve.NbIntervals(GeomAbs_CN);
  TColStd_Array1OfReal at(1, n + 1);
  curve.Intervals(at, GeomAbs_CN);
  return {values_of(at), curve.IsPeriodic() == Standard_True, curve.IsPeriodic() ? curve.Period() : 0};
}

}  // namespace

Breaks::Breaks(std::vector<double> breaks, bool periodic, double period) : periodic_(periodic), period_(period) {
  // Planes, cylinders and single spans have only their ends: there is no other polynomial.
  if (breaks.size() > 2) breaks_ = std::move(breaks);
}

double Breaks::settle(double t) const noexcept {
  if (breaks_.empty()) return t;
  if (periodic_ && (t < breaks_.front() || t > breaks_.back()))
    t -= period_ * std::floor((t - breaks_.front()) / period_);
  const auto next = std::lower_bound(breaks_.begin(), breaks_.end(), t);
  // OpenCASCADE's search takes a parameter within one unit in the last place of a knot for the knot.
  const double rounding = 4 * std::numeric_limits<double>::epsilon() * std::abs(t);
  return next != breaks_.end() && *next - t <= rounding ? *next : t;
}

std::size_t Breaks::span_of(double t) const noexcept {
  if (breaks_.empty()) return 0;
  return static_cast<std::size_t>(std::upper_bound(breaks_.begin(), breaks_.end(), settle(t)) - breaks_.begin());
}

void Evaluators::set(std::size_t number, const TopoDS_Face& face, std::vector<Handle(Geom2d_Curve)> curves,
                     PartBox box) {
  Face entry{face, std::move(curves), {}, {}, {}, box, {}, {}};
  const BRepAdaptor_Surface surface(face, Standard_False);
  entry.u = breaks_in_u(surface), entry.v = breaks_in_v(surface);
  entry.closed = ElementarySurface(surface);
  for (const Handle(Geom2d_Curve) & curve : entry.curves) {
    const Geom2dAdaptor_Curve adaptor(curve);
    entry.t.push_back(breaks_of(adaptor));
    entry.closed_curves.emplace_back(adaptor);
  }
  faces_[number] = std::move(entry);
}

const Evaluators::Adaptors& Evaluators::mine(std::size_t face) {
  auto& all = of_thread_.local();
  if (all.size() < faces_.size()) all.resize(faces_.size());
  if (!all[face]) {
    auto made = std::make_unique<Adaptors>();
    made->surface.Initialize(faces_[face].face, Standard_False);
    made->curves.reserve(faces_[face].curves.size());
    for (const Handle(Geom2d_Curve) & curve : faces_[face].curves) made->curves.emplace_back(curve);
    all[face] = std::move(made);
  }
  return *all[face];
}

Evaluators::Surface Evaluators::surface(std::size_t face) {
  const Face& f = faces_[face];
  return {f.closed ? nullptr : &mine(face).surface, f.closed, f.u, f.v, f.box};
}

// Next to a line the adaptor may take the polynomials of either side: derivatives come from a little inside, and are
// carried to the place by Taylor's formula. The error is of second order in the distance in first
// derivatives, of first order in second ones.
void Evaluators::Surface::d2_beside(double u, double v, gp_Pnt& p, gp_Vec& su, gp_Vec& sv, gp_Vec& suu, gp_Vec& svv,
                                    gp_Vec& suv) const {
  u = std::clamp(u, box_->low_u, box_->high_u), v = std::clamp(v, box_->low_v, box_->high_v);
  const double a = std::clamp(u, box_->low_u + box_->step_u, box_->high_u - box_->step_u);
  const double b = std::clamp(v, box_->low_v + box_->step_v, box_->high_v - box_->step_v);
  smooth_d2(a, b, p, su, sv, suu, svv, suv);
  if (a == u && b == v) return;
  d0(u, v, p);
  su += suu * (u - a) + suv * (v - b);
  sv += suv * (u - a) + svv * (v - b);
}

Evaluators::Curve Evaluators::curve(std::size_t face, std::size_t curve) {
  const Face& f = faces_[face];
  const ElementaryCurve& closed = f.closed_curves[curve];
  return {closed ? nullptr : &mine(face).curves[curve], closed, f.t[curve]};
}

}  // namespace carreau_occ
