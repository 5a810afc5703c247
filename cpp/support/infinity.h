// SPDX-License-Identifier: BSD-3-Clause
// Infinity for sizes without a bound and for empty boxes; NaN for values that do not exist.
#pragma once

#include <limits>

namespace carreau {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace carreau
