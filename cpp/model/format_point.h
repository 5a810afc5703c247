// SPDX-License-Identifier: BSD-3-Clause
// Points as text.
#pragma once

#include <string>

#include "support/format.h"
#include "support/vec.h"

namespace carreau {

/// "(0.5, 1, -2)", with the shortest numbers that read back as the same coordinates.
inline std::string format_point(const Vec3& p) {
  return "(" + format_number(p.x()) + ", " + format_number(p.y()) + ", " + format_number(p.z()) + ")";
}

}  // namespace carreau
