// SPDX-License-Identifier: BSD-3-Clause
// Limits beyond which a parametrisation counts as degenerate, for all rooms.
#pragma once

namespace carreau::thresholds::degenerate {

// In brackets: the tests that rest on it.

/// Ratio of squared lengths. A first derivative so much shorter than the other one has collapsed: only rounding is left
/// of it. [tests/cpp/size: SmallestRadius.IsEmptyWhereTheParametrisationCollapses]
inline constexpr double collapsed = 1e-24;
/// sin^2 of the angle between the first derivatives, below which they are parallel. [the same]
inline constexpr double parallel = 1e-20;

}  // namespace carreau::thresholds::degenerate
