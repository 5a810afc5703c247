// SPDX-License-Identifier: BSD-3-Clause
#include "surface/options.h"

#include <string>

namespace carreau {

namespace {

std::string format_count(double n) { return std::to_string(static_cast<std::int64_t>(n < 9e18 ? n : 9e18)); }

}  // namespace

void refuse_triangles(const Where& where, double expected, std::int64_t most) {
  throw LimitError(where, "the mesh would have about " + format_count(expected) +
                              " triangles or more, beyond the limit of " + format_count(static_cast<double>(most)) +
                              " (parameter max_triangles)");
}

}  // namespace carreau
