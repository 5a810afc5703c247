// SPDX-License-Identifier: BSD-3-Clause
// Planes, cylinders, cones, spheres, tori, lines, circles and ellipses by their closed forms: without adaptors, which
// each thread would need, and without a guard, since nothing can fail.
#pragma once

#include <BRepAdaptor_Surface.hxx>
#include <ElCLib.hxx>
#include <ElSLib.hxx>
#include <Geom2dAdaptor_Curve.hxx>
#include <type_traits>
#include <variant>

namespace carreau_occ {

/// Empty if the surface is of another kind. Values are identical to the adaptor's.
class ElementarySurface {
 public:
  ElementarySurface() = default;
  explicit ElementarySurface(const BRepAdaptor_Surface& surface) {
    const gp_Trsf& placing = surface.Trsf();  // parameters of surfaces do not follow a scale
    if (placing.ScaleFactor() != 1) return;
    switch (surface.GetType()) {
      case GeomAbs_Plane:
        of_ = surface.Plane();
        break;
      case GeomAbs_Cylinder:
        of_ = surface.Cylinder();
        break;
      case GeomAbs_Cone:
        of_ = surface.Cone();
        break;
      case GeomAbs_Sphere:
        of_ = surface.Sphere();
        break;
      case GeomAbs_Torus:
        of_ = surface.Torus();
        break;
      default:
        break;
    }
  }
  explicit operator bool() const noexcept { return of_.index() != 0; }

  void d0(double u, double v, gp_Pnt& p) const {
    visit([&](const auto& s) { ElSLib::D0(u, v, s, p); });
  }
  void d1(double u, double v, gp_Pnt& p, gp_Vec& su, gp_Vec& sv) const {
    visit([&](const auto& s) { ElSLib::D1(u, v, s, p, su, sv); });
  }
  void d2(double u, double v, gp_Pnt& p, gp_Vec& su, gp_Vec& sv, gp_Vec& suu, gp_Vec& svv, gp_Vec& suv) const {
    visit([&](const auto& s) {
      if constexpr (std::is_same_v<std::decay_t<decltype(s)>, gp_Pln>)
        ElSLib::D1(u, v, s, p, su, sv), suu = svv = suv = gp_Vec(0, 0, 0);
      else
        ElSLib::D2(u, v, s, p, su, sv, suu, svv, suv);
    });
  }

 private:
  template <typename Use>
  void visit(const Use& use) const {
    std::visit(
        [&](const auto& s) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(s)>, std::monostate>) use(s);
        },
        of_);
  }

  std::variant<std::monostate, gp_Pln, gp_Cylinder, gp_Cone, gp_Sphere, gp_Torus> of_;
};

/// A curve in a parameter plane by closed forms; empty if it is of another kind.
class ElementaryCurve {
 public:
  ElementaryCurve() = default;
  explicit ElementaryCurve(const Geom2dAdaptor_Curve& curve) {
    switch (curve.GetType()) {
      case GeomAbs_Line:
        of_ = curve.Line();
        break;
      case GeomAbs_Circle:
        of_ = curve.Circle();
        break;
      case GeomAbs_Ellipse:
        of_ = curve.Ellipse();
        break;
      default:
        break;
    }
  }
  explicit operator bool() const noexcept { return of_.index() != 0; }

  void d0(double t, gp_Pnt2d& p) const {
    visit([&](const auto& c) { p = ElCLib::Value(t, c); });
  }
  void d1(double t, gp_Pnt2d& p, gp_Vec2d& ct) const {
    visit([&](const auto& c) { ElCLib::D1(t, c, p, ct); });
  }
  void d2(double t, gp_Pnt2d& p, gp_Vec2d& ct, gp_Vec2d& ctt) const {
    visit([&](const auto& c) {
      if constexpr (std::is_same_v<std::decay_t<decltype(c)>, gp_Lin2d>)
        ElCLib::D1(t, c, p, ct), ctt = gp_Vec2d(0, 0);
      else
        ElCLib::D2(t, c, p, ct, ctt);
    });
  }

 private:
  template <typename Use>
  void visit(const Use& use) const {
    std::visit(
        [&](const auto& c) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(c)>, std::monostate>) use(c);
        },
        of_);
  }

  std::variant<std::monostate, gp_Lin2d, gp_Circ2d, gp_Elips2d> of_;
};

}  // namespace carreau_occ
