// SPDX-License-Identifier: BSD-3-Clause
// Nodes of elements of order 3 and 4 on curves and surfaces.
#pragma once

#include "curve/curve_model.h"
#include "high_order/high_order_mesh.h"
#include "support/monitor.h"
#include "surface/result.h"

namespace carreau {

/// Makes nodes of order 2 to 4 over the elements of a mesh. Nodes of curves divide the arc length. Nodes of inner edges are the closest points of chords, inner nodes
/// the closest points of the polynomial that the edges imply: maps whose derivatives shrink with the size, so that polynomials converge with
/// order p + 1 also at poles. Then repairs elements that are not valid: inner nodes move first, then the nodes of inner edges, which follow the
/// nodes of order 2 where the mesh has them. `lowers`: elements that stay invalid, such as those at cusps, get the shape of order 2, and a message counts
/// them. Throws InvalidArgument for other orders, and the exceptions of the geometry.
HighOrderMesh raise_order(const CurveModel& model, const CompositeResult& result, int order, NodePlaces places, bool lowers, Monitor& monitor);

}  // namespace carreau
