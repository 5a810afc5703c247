// Polyline supports of curves (HDR sec. 2.5 and 4.5.3).
#pragma once

#include <vector>

#include "cad/cad.h"

namespace carreau {

/// Polyline that stands for a curve both in the parameter plane and in space: between two samples,
/// linear interpolation in t is close to both curves (property (PL), HDR sec. 2.5). All arrays have m >= 2 entries.
struct CurveSupport {
  std::vector<double> t;  ///< strictly increasing, t[0] = a, t[m-1] = b
  std::vector<Vec2> uv;
  std::vector<Vec3> xyz;
  std::vector<double> arc;  ///< cumulated length in space, arc[0] = 0
  [[nodiscard]] double length() const noexcept { return arc.back(); }
  /// Parameter at cumulated length s, by linear interpolation.
  [[nodiscard]] double t_at_arc(double s) const noexcept;
  [[nodiscard]] double arc_at_t(double t) const noexcept;
};

struct SupportOptions {
  /// Largest angle between a support edge and the tangent of the curve, degrees (angle_smo, RT-0232 sec. 3.3).
  double angle_deg = 1;
};

/// Builds the support of curve (face, ic). Throws CallbackError for a reversed or infinite interval, values that are
/// not finite, …
CurveSupport build_support(Cad& cad, int face, int ic, const SupportOptions& options);

}  // namespace carreau
