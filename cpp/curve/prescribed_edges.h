// SPDX-License-Identifier: BSD-3-Clause
// Edges of a curve that are prescribed in place of sizes: their number, a progression, or all parameters (HDR sec. 2.1,
// 2.3).
#pragma once

#include <vector>

#include "curve/curve_model.h"

namespace carreau {

/// Shares of the length at the edges + 1 vertices of a progression, from 0 to 1, in closed form. `given` has no shares.
/// Throws InvalidArgument when there is no edge, the ratio is not positive and finite, or an edge would be too short
/// for floating-point numbers.
std::vector<double> progression_shares(const PrescribedEdges& edges);

/// The edges of a curve of space, when some use prescribes them.
struct CurvePrescription {
  int use = -1;           ///< in Curve::uses; -1: none
  std::vector<double> t;  ///< of all vertices in that use, in the direction of the first use, ends included
};

/// Reads it from the uses. Lengths are exact (exact_arc.h). Throws InvalidModel, naming the curve and its face. Causes
/// are uses that contradict each other, parameters outside of its interval, or a closed curve with less than three
/// edges. Also for a curve that is one point, and for a curve that gluing has cut (only given parameters hold on
/// parts).
CurvePrescription prescription_of(const CurveModel& model, int curve);

}  // namespace carreau
