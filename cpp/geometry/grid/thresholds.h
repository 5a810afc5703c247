// SPDX-License-Identifier: BSD-3-Clause
// The numbers that decide something about grids.
#pragma once

#include <numbers>

namespace carreau::grid::thresholds {

/// Turn at the joint of a closed grid (in the mean), or between lines of two blocks, radians. From this turn on the lines do not go on into
/// one another: eight cells make a circle. [Glue.*, Coons.*]
inline constexpr double closed_turn = std::numbers::pi / 4;

}  // namespace carreau::grid::thresholds
