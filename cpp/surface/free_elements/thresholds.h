// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room: what they are, in which unit, why, and what supports them.
#pragma once

namespace carreau::thresholds::free_elements {

/// Share of the way that nodes and vertices may be left beside their foot along the surface. A node aside makes its element uneven: this is
/// below the third power of common elements' sizes over radii. [FreeElements.AreaConvergesAsThePolynomialsPromise]
inline constexpr double near_foot = 1e-2;

}  // namespace carreau::thresholds::free_elements
