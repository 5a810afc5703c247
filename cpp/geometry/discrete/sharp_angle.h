// SPDX-License-Identifier: BSD-3-Clause
// The angle from which on edges of triangles are features, if the caller gives none.
#pragma once

#include <vector>

#include "geometry/discrete/triangulation.h"

namespace carreau::discrete {

struct SharpAngle {
  double angle = 0;         ///< degrees: edges that bend by more are features
  std::vector<char> round;  ///< by edge: it lies inside a curved surface that was cut into flat strips, and is no feature
};

/// Finds the flattest gap in the histogram of the angles, weighted by length of edges: tessellations have flatter
/// edges, features sharper ones. Scans have no gap: the angle is then thresholds::usual_sharp. `bends`: by edge,
/// degrees.
SharpAngle find_sharp_angle(const Triangulation& mesh, const std::vector<double>& bends);

}  // namespace carreau::discrete
