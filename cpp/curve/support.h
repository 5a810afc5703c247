// SPDX-License-Identifier: BSD-3-Clause
// Polyline supports of curves (HDR sec. 2.5 and 4.5.3).
#pragma once

#include <vector>

#include "cad/cad.h"

namespace carreau {

/// Polyline that approximates a curve both in the parameter plane and in space. Between two samples, linear
/// interpolation in t is close to both curves (property (PL), HDR sec. 2.5). All arrays have m >= 2 entries. All
/// samples are exact values of the host.
struct CurveSupport {
  std::vector<double> t;  ///< strictly increasing, t[0] = a, t[m-1] = b
  std::vector<Vec2> uv;
  std::vector<Vec3> xyz;
  /// Cumulated length of the curve in space, arc[0] = 0; all zero when the curve is one point of space.
  std::vector<double> arc;
  /// dt/ds at the samples; t(s) is a monotone cubic between them. Empty: t(s) is linear between samples.
  std::vector<double> slope;
  /// True when some edge still deviates more than the tolerance: a jump, a vertical tangent of the parametrisation, or
  /// more detail than max_samples can show.
  bool limited = false;
  double limited_t = 0;  ///< parameter where the deviation that remains is largest; meaningful when limited

  [[nodiscard]] double length() const noexcept { return arc.back(); }
  /// Parameter at cumulated length s (clamped to [0, length()]); strictly monotone where the arc is.
  [[nodiscard]] double t_at_arc(double s) const noexcept;
  /// Inverse of t_at_arc.
  [[nodiscard]] double arc_at_t(double t) const noexcept;
  /// Point of the polyline in space at cumulated length s: no callback, off the curve by less than the tolerance.
  [[nodiscard]] Vec3 point_at_arc(double s) const noexcept;
};

struct SupportOptions {
  /// Largest angle between a support edge and the tangent of the curve, degrees (angle_smo, RT-0232 sec. 3.3).
  double angle_deg = 1;
  /// Largest number of samples of a curve.
  int max_samples = 10'000;
};

/// Builds the support of curve (face, ic), `face` and `ic` as in the cad_m routines. Throws CallbackError for an
/// interval that is reversed, empty or not finite and for values that are not finite; InvalidArgument for an angle
/// outside ]0, 90[.
CurveSupport build_support(Cad& cad, int face, int ic, const SupportOptions& options);

/// A point of a curve with the host's values there.
struct CurvePoint {
  double t = 0;
  Vec2 uv;
  Vec3 xyz;
  double distance = 0;  ///< from the requested point
};

/// The point of curve (face, ic) with t in [t_low, t_high] nearest to `target`. At most two Gauss-Newton steps from the
/// guess t search it, with the support's tangent. Spends one to three surf0 calls. Never farther from `target` than the
/// guess.
CurvePoint refine_t(Cad& cad, int face, int ic, const CurveSupport& support, double t, double t_low, double t_high,
                    Vec3 target);

}  // namespace carreau
