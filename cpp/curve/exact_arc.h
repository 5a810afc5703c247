// SPDX-License-Identifier: BSD-3-Clause
// Arc length of a curve of a face by quadrature (HDR eq. 2.3 and sec. 2.4), for cases in which the support's length is
// too inexact.
#pragma once

#include <vector>

#include "cad/cad.h"
#include "support/gauss.h"

namespace carreau {

/// s(t), the integral of |d S(C(t)) / dt| (HDR eq. 2.3), and its inverse. On a curve without kinks it is exact to some
/// 1e-14 of its length if the host gives first derivatives, else to the accuracy of finite differences.
class ExactArc {
 public:
  /// Curve (face, ic), as in the cad_m routines. `t`: places between which the curve bends little, such as the samples
  /// of a support: strictly increasing, two or more, including the ends. `cad` outlives this. Throws the host's
  /// exceptions.
  ExactArc(Cad& cad, int face, int ic, std::vector<double> t);

  [[nodiscard]] double length() const noexcept { return arc_.back(); }
  /// The parameter at which s(t) is `s`, by Newton's steps inside a bracket (HDR sec. 2.4); s clamped to the curve.
  [[nodiscard]] double t_at(double s) const;

 private:
  [[nodiscard]] double speed(double t) const;
  [[nodiscard]] double once(double a, double b) const;
  [[nodiscard]] double integral(double a, double b, double whole, int depth) const;
  [[nodiscard]] double length_between(double a, double b) const;

  Cad& cad_;
  int face_, ic_;
  GaussRule rule_;
  double tolerance_;  // share of an interval's length
  std::vector<double> t_, arc_;
};

}  // namespace carreau
