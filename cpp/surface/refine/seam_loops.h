// SPDX-License-Identifier: BSD-3-Clause
// Thin waists and tubes that a seam closes.
#pragma once

#include <vector>

#include "curve/discrete_curve.h"
#include "mesh/plane_mesh.h"

namespace carreau {

/// Edges of the seams of a face that are long compared with the thickness of the face. The circumference of a tube of
/// that thickness would be less than coef (CoefRectangle) times their length. Thickness is the distance in space from
/// the seam to the surface halfway between its two sides. No other check measures it: in space the two sides are one.
/// Thinner parts are passed over, since long triangles fill them (less than narrowest_share of the size and of the seam
/// around). So are parts that taper to a pole. Indices of domain.edges; costs four positions an edge of a seam.
std::vector<int> edges_to_split_for_waists(const CurveModel& model, const std::vector<DiscreteCurve>& curves, int face,
                                           const PlaneDomain& domain, double coef);

}  // namespace carreau
