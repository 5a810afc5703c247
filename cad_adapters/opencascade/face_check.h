// SPDX-License-Identifier: BSD-3-Clause
// Checks that the numbers of a face allow computations.
#pragma once

#include <TopoDS_Face.hxx>
#include <cmath>
#include <vector>

#include "wire_periods.h"

namespace carreau_occ {

/// Coordinates beyond this are rejected: nine digits would be left of a metre in them. OpenCASCADE's own tolerance of
/// 1e-7 is then below the rounding of any number.
constexpr double largest_coordinate = 1e15;

/// Not for a number that is not finite either.
inline bool usable(double x) noexcept { return std::abs(x) <= largest_coordinate; }

/// Throws std::runtime_error when a vertex, a pole, or a place of the boundary of the face is not finite or too far
/// away, and Standard_Failure when OpenCASCADE does. `wires`: all of the face.
void refuse_unusable(const TopoDS_Face& face, const std::vector<std::vector<EdgeImage>>& wires);

}  // namespace carreau_occ
