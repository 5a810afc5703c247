// SPDX-License-Identifier: BSD-3-Clause
// The curves of a plane domain, cut where others end, and polylines that approximate them.
#pragma once

#include <memory>
#include <vector>

#include "geometry/plane/plane_domain.h"
#include "geometry/plane/plane_piece.h"

namespace carreau {

/// A part of a curve between two points at which a mesh has vertices.
struct PlaneArc {
  int curve = 0;                   ///< index in PlaneDomainInput::curves
  std::vector<PlanePiece> pieces;  ///< one or more; parameter t runs from 0 to their number
  std::vector<int> passed;         ///< indices of the points at t = 0, 1, ...
  int from = 0, to = 0;            ///< the first and the last of them
  std::vector<Vec2> polyline;      ///< on the curve, from end to end
  std::vector<double> parameter;   ///< of the vertices of the polyline

  [[nodiscard]] Vec2 at(double t) const noexcept;
};

/// Cuts every curve at points where a curve ends or passes, and at imposed points. Polylines follow RR-2818 sec. 3.7 with tolerance `eps`.
/// Throws InvalidModel with file and line, curve and point. Causes are points that coincide or are not finite, curves with fewer than two
/// points, pieces without length, loops and cusps, or arcs without a circle. `warnings` gets a sentence for each piece that turns back
/// (RR-2818 fig. 8 d, e).
std::vector<PlaneArc> cut_into_arcs(const PlaneDomainInput& input, double eps, std::vector<std::string>& warnings);

/// Makes the polylines again with another tolerance.
void refine_polylines(const PlaneDomainInput& input, std::vector<PlaneArc>& arcs, double eps);

}  // namespace carreau
