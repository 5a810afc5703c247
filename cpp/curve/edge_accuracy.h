// SPDX-License-Identifier: BSD-3-Clause
// Approximation of an arc by an edge of a discretised curve (HDR sec. 2.6).
#pragma once

#include <span>
#include <vector>

#include "cad/cad.h"

namespace carreau {

/// Parameters of the vertices of a discretised curve on it.
struct CurveParameters {
  int face = 0, ic = 0;   ///< of the curve in one of its faces, as in the cad_m routines
  std::vector<double> t;  ///< by vertex; NaN: it is not on this curve. Empty: nothing is known
};

struct EdgeAccuracy {
  double deviation = 0;  ///< A0, E_0 of HDR eq. 2.26: largest distance from the arc to the edge, model length
  double angle_deg = 0;  ///< A1, E_1 of HDR eq. 2.28: largest angle between tangents of the arc and the edge
};

/// The arc S(C(t)) belongs to curve (face, ic), t from t0 to t1. `nodes`: the ends of the edge, and its node between
/// them where it is of second order. Both are measured at seven points inside; A1 also at the ends, with the tangent of
/// this arc. Nine evaluations. Throws the host's exceptions.
EdgeAccuracy edge_accuracy(Cad& cad, int face, int ic, double t0, double t1, std::span<const Vec3> nodes);

}  // namespace carreau
