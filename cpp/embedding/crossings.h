// SPDX-License-Identifier: BSD-3-Clause
// Places at which a piece meets the curves inside its face, and itself.
#pragma once

#include <vector>

#include "embedding/curve_uses.h"
#include "embedding/trace.h"

namespace carreau::embedding {

struct Cut {
  double t = 0;  ///< parameter of the piece
  End end;
};

/// Crossings of a piece with the internal curves of its face, and with itself, in their order along it. Places nearer than `near` (model
/// length) are one; its ends are none.
std::vector<Cut> cuts_of(const Piece& piece, const CurveUses& uses, double near);

/// The part of a curve between two parameters.
EmbeddedCurve part_of_curve(const EmbeddedCurve& curve, double a, double b);

}  // namespace carreau::embedding
