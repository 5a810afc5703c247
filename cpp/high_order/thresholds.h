// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this folder: their meaning, unit, reason and evidence.
#pragma once

namespace carreau::thresholds::high_order {

/// Least Jacobian over its mean below which an element is not valid, and at which repairs stop: of second order too.
inline constexpr double least_jacobian = 1e-6, good_jacobian = 0.1;
/// Share of the edge. A closest point that is farther from its chord lies on another sheet of the surface: the place on the way in (u, v) holds.
inline constexpr double max_sagitta = 0.5;
/// Times that edges of invalid elements are halved: as elements of order two are, whose arcs then have 6 degrees. [the eleven files at 3 %]
inline constexpr int max_divisions = 4;
/// Rings of neighbours that take the shape of order 2 with an element.
inline constexpr int max_rings = 4;

}  // namespace carreau::thresholds::high_order
