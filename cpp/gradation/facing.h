// SPDX-License-Identifier: BSD-3-Clause
// Narrow zones in space: faces that share nothing and come near each other (HDR sec. 1.1.2).
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "gradation/gradation.h"
#include "support/monitor.h"

namespace carreau {

/// A place that another face faces.
struct FacingPlace {
  int place = 0;   ///< index in GradationGraph::places
  double gap = 0;  ///< along its normal, to the surface that the triangles there stand for
  /// Intersection of the normal with that face: a triangle of the graph and the point in it.
  int triangle = 0;
  Vec3 foot;
};

/// Follows the normal of each place, both ways, to the nearest triangle of another face that it meets nearly head on.
/// Logarithmic in the number of triangles. Gaps are measured to the curved surfaces, which may be nearer than the
/// planes of their triangles: triangles bulge by the normals at their corners. `reach(place)`: how far to look.
/// `apart(p, q)`: whether the faces of two places may face each other; faces that share a corner come arbitrarily near
/// there.
std::vector<FacingPlace> find_facing_places(const GradationGraph& graph, const std::function<double(int)>& reach,
                                            const std::function<bool(int, int)>& apart, Monitor& monitor);

}  // namespace carreau
