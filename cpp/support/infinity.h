// SPDX-License-Identifier: BSD-3-Clause
// The one infinity: sizes that nothing bounds, boxes that hold nothing.
#pragma once

#include <limits>

namespace carreau {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace carreau
