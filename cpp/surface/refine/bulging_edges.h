// SPDX-License-Identifier: BSD-3-Clause
// Edges of boundaries that are so coarse beside the width of a face that triangles between its sides would be turned
// over.
#pragma once

#include <vector>

#include "curve/discrete_curve.h"
#include "surface/domain/domain_builder.h"

namespace carreau {

/// How far a curve leaves the chord of one of its edges, from what the edge is longer than that (of an arc of height d:
/// 8 d^2 / (3 chord)). Model length; `chord`: that of the edge.
double bulge_of(const CurveModel& model, const std::vector<DiscreteCurve>& curves, const PlaneEdge& edge, double chord);

/// Edges that bulge past vertices on the other side of a face: the curve passes on the one side of such a vertex and
/// the chord on the other, so that the triangle between them turns its back on the surface. Only those whose bulge is
/// more than `coef` times the chord: what less wide bulges pass is a strip for the check of closeness. Indices of
/// domain.plane.edges; costs some normals of each such edge.
std::vector<int> edges_to_split_for_bulges(const CurveModel& model, const std::vector<DiscreteCurve>& curves, int face,
                                           const FaceDomain& domain, double coef);

}  // namespace carreau
