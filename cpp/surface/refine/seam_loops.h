// SPDX-License-Identifier: BSD-3-Clause
// Thin waists and tubes that a seam closes.
#pragma once

#include <vector>

#include "curve/discrete_curve.h"
#include "mesh/plane_mesh.h"

namespace carreau {

/// Edges of the seams of a face that are long beside how thick the face is there: a tube of that thickness would be
/// less than coef (CoefRectangle) times their length around. Thickness is the distance in space from the seam to the
/// surface halfway between its two sides, which nothing else tells: in space the two sides are one. What is left to
/// long triangles (less than narrowest_share of the size and of the seam around) and what tapers to a pole is not
/// looked at. Indices of domain.edges; costs four positions an edge of a seam.
std::vector<int> edges_to_split_for_waists(const CurveModel& model, const std::vector<DiscreteCurve>& curves, int face,
                                           const PlaneDomain& domain, double coef);

}  // namespace carreau
