// SPDX-License-Identifier: BSD-3-Clause
// Edges of boundaries that are so coarse beside the width of a face that triangles between its sides would be turned
// over.
#pragma once

#include <vector>

#include "curve/discrete_curve.h"
#include "surface/domain/domain_builder.h"

namespace carreau {

/// The distance between a curve and the chord of one of its edges, from the difference of their lengths. For an arc of
/// height d the difference is 8 d^2 / (3 chord). Model length; `chord`: the length of the edge's chord.
double bulge_of(const CurveModel& model, const std::vector<DiscreteCurve>& curves, const PlaneEdge& edge, double chord);

/// Edges that bulge past vertices on the other side of a face. The curve passes on one side of such a vertex and the
/// chord on the other. The triangle between them therefore turns its back on the surface. Only edges whose bulge is
/// more than `coef` times the chord: vertices beside narrower bulges are strips for the check of closeness. Indices of
/// domain.plane.edges; costs some normals of each such edge.
std::vector<int> edges_to_split_for_bulges(const CurveModel& model, const std::vector<DiscreteCurve>& curves, int face,
                                           const FaceDomain& domain, double coef);

}  // namespace carreau
