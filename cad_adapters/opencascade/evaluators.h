// SPDX-License-Identifier: BSD-3-Clause
// Positions and derivatives of faces and of the curves in their parameter planes, from any thread.
#pragma once

#include <BRepAdaptor_Surface.hxx>
#include <Geom2dAdaptor_Curve.hxx>
#include <Geom2d_Curve.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "elementary_geometry.h"
#include "thread_values.h"

namespace carreau_occ {

/// The parameters at which polynomials begin. An adaptor keeps its last polynomial, also for a parameter a rounding
/// error before the end, where a new search would take the next polynomial. So results would depend on earlier calls.
/// Such parameters are therefore moved onto the end.
class Breaks {
 public:
  Breaks() = default;
  /// The knots of one direction of an adaptor. `breaks` ascend, with both ends.
  Breaks(std::vector<double> breaks, bool periodic, double period);
  [[nodiscard]] double settle(double t) const noexcept;
  [[nodiscard]] bool several() const noexcept { return !breaks_.empty(); }
  /// Which polynomial it is.
  [[nodiscard]] std::size_t span_of(double t) const noexcept;

 private:
  std::vector<double> breaks_;  // empty: one polynomial, or none
  bool periodic_ = false;
  double period_ = 0;
};

/// The ends of a part of a face on lines of bends: there derivatives belong to its own side, and
/// beyond them, where rounding gets, there is nothing. Infinite: no line.
struct PartBox {
  static constexpr double none = std::numeric_limits<double>::infinity();
  double low_u = -none, high_u = none, low_v = -none, high_v = none;
  double step_u = 0, step_v = 0;  ///< how far from a line derivatives are one-sided; above 0 where there are lines

  [[nodiscard]] bool bounds() const noexcept {
    return low_u > -none || high_u < none || low_v > -none || high_v < none;
  }
};

/// Every thread has its own adaptors, since these keep the polynomial of the span that they evaluated last.
/// Results do not depend on the thread or on earlier calls.
class Evaluators {
 public:
  /// Room for `n` faces, counted from 0.
  void resize(std::size_t n) { faces_.resize(n); }
  /// Gives a face, which must be forward, with its curves. Not while others evaluate. Throws Standard_Failure.
  void set(std::size_t number, const TopoDS_Face& face, std::vector<Handle(Geom2d_Curve)> curves, PartBox box = {});
  /// As they were given.
  [[nodiscard]] const std::vector<Handle(Geom2d_Curve)>& curves(std::size_t face) const { return faces_[face].curves; }

  /// The evaluators of the calling thread, for it alone. Throw Standard_Failure.
  class Surface {
   public:
    void d0(double u, double v, gp_Pnt& p) const {
      if (box_ != nullptr) u = std::clamp(u, box_->low_u, box_->high_u), v = std::clamp(v, box_->low_v, box_->high_v);
      if (closed_)
        closed_.d0(u, v, p);
      else
        adaptor_->D0(u_.settle(u), v_.settle(v), p);
    }
    void d1(double u, double v, gp_Pnt& p, gp_Vec& su, gp_Vec& sv) const {
      gp_Vec suu, svv, suv;
      if (box_ != nullptr) return d2(u, v, p, su, sv, suu, svv, suv);
      if (closed_)
        closed_.d1(u, v, p, su, sv);
      else
        adaptor_->D1(u_.settle(u), v_.settle(v), p, su, sv);
    }
    void d2(double u, double v, gp_Pnt& p, gp_Vec& su, gp_Vec& sv, gp_Vec& suu, gp_Vec& svv, gp_Vec& suv) const {
      if (box_ != nullptr) return d2_beside(u, v, p, su, sv, suu, svv, suv);
      smooth_d2(u, v, p, su, sv, suu, svv, suv);
    }

    /// True if the surface has several polynomials, each of which an adaptor prepares again when it comes back to it.
    [[nodiscard]] bool has_patches() const noexcept { return !closed_ && (u_.several() || v_.several()); }
    /// Equal for points of one polynomial, different for others.
    [[nodiscard]] std::size_t patch_of(double u, double v) const noexcept {
      return (u_.span_of(u) << 32) + v_.span_of(v);
    }

   private:
    friend class Evaluators;
    Surface(const BRepAdaptor_Surface* adaptor, const ElementarySurface& closed, const Breaks& u, const Breaks& v,
            const PartBox& box)
        : adaptor_(adaptor), closed_(closed), u_(u), v_(v), box_(box.bounds() ? &box : nullptr) {}
    void smooth_d2(double u, double v, gp_Pnt& p, gp_Vec& su, gp_Vec& sv, gp_Vec& suu, gp_Vec& svv, gp_Vec& suv) const {
      if (closed_)
        closed_.d2(u, v, p, su, sv, suu, svv, suv);
      else
        adaptor_->D2(u_.settle(u), v_.settle(v), p, su, sv, suu, svv, suv);
    }
    void d2_beside(double u, double v, gp_Pnt& p, gp_Vec& su, gp_Vec& sv, gp_Vec& suu, gp_Vec& svv, gp_Vec& suv) const;
    const BRepAdaptor_Surface* adaptor_;  // nullptr: closed_ has it
    const ElementarySurface& closed_;
    const Breaks &u_, &v_;
    const PartBox* box_;  // nullptr: no bounds
  };
  [[nodiscard]] Surface surface(std::size_t face);
  /// True if the surface is evaluated by closed forms, which cannot fail.
  [[nodiscard]] bool is_closed_form(std::size_t face) const noexcept { return bool(faces_[face].closed); }

  class Curve {
   public:
    void d0(double t, gp_Pnt2d& p) const { closed_ ? closed_.d0(t, p) : adaptor_->D0(breaks_.settle(t), p); }
    void d1(double t, gp_Pnt2d& p, gp_Vec2d& ct) const {
      closed_ ? closed_.d1(t, p, ct) : adaptor_->D1(breaks_.settle(t), p, ct);
    }
    void d2(double t, gp_Pnt2d& p, gp_Vec2d& ct, gp_Vec2d& ctt) const {
      closed_ ? closed_.d2(t, p, ct, ctt) : adaptor_->D2(breaks_.settle(t), p, ct, ctt);
    }

   private:
    friend class Evaluators;
    Curve(const Geom2dAdaptor_Curve* adaptor, const ElementaryCurve& closed, const Breaks& breaks)
        : adaptor_(adaptor), closed_(closed), breaks_(breaks) {}
    const Geom2dAdaptor_Curve* adaptor_;  // nullptr: closed_ has it
    const ElementaryCurve& closed_;
    const Breaks& breaks_;
  };
  [[nodiscard]] Curve curve(std::size_t face, std::size_t curve);
  [[nodiscard]] bool is_closed_form(std::size_t face, std::size_t curve) const noexcept {
    return bool(faces_[face].closed_curves[curve]);
  }

 private:
  struct Face {
    TopoDS_Face face;
    std::vector<Handle(Geom2d_Curve)> curves;
    Breaks u, v;
    std::vector<Breaks> t;
    PartBox box;
    ElementarySurface closed;
    std::vector<ElementaryCurve> closed_curves;
  };
  struct Adaptors {
    BRepAdaptor_Surface surface;
    std::vector<Geom2dAdaptor_Curve> curves;
  };
  const Adaptors& mine(std::size_t face);

  std::vector<Face> faces_;
  ThreadValues<std::vector<std::unique_ptr<Adaptors>>> of_thread_;
};

}  // namespace carreau_occ
