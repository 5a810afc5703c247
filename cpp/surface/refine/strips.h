// SPDX-License-Identifier: BSD-3-Clause
// Strips of a face that are narrow in space compared with their edges, whatever the distance of their sides on the
// surface.
#pragma once

#include <vector>

#include "curve/discrete_curve.h"
#include "surface/domain/domain_builder.h"

namespace carreau {

/// An edge, a vertex close to it in space, and the point halfway between them in (u, v), which is in the domain.
struct Strip {
  int edge = -1, vertex = -1;  ///< of the face's plane domain
  Vec2 middle;
};

/// Vertices that are nearer to an edge than its length times `coef`, by coefficient_of_width(). If a strip is narrower
/// than its long edges bulge, the chord of an edge passes by vertices of the other side. Vertices near a corner where
/// curves meet are left to the check in the metric, which includes angles. Away from the corner, bulges are as
/// elsewhere. Costs no callback. Strips of an edge follow each other.
std::vector<Strip> find_strips(const CurveModel& model, const std::vector<DiscreteCurve>& curves, int face,
                               const FaceDomain& domain, double coef);

/// Returns whether a strip belongs to the face. The borders of a slit, or of a seam that is two curves, are close in
/// space. The outside or the whole surface lies between them. No number of cuts would part them. Evaluates four points
/// of the surface.
bool lies_between(const CurveModel& model, int face, const FaceDomain& domain, const Strip& strip);

}  // namespace carreau
