// SPDX-License-Identifier: BSD-3-Clause
// Triangles along a curve that fills space. Private to mesh/.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "support/monitor.h"
#include "support/vec.h"

namespace carreau {

/// Orders the `numbers` of triangles so that neighbours in the list are neighbours in space. Sorts by the interleaved
/// bits of their centres' coordinates (Morton 1966, "A computer oriented geodetic data base"). If many triangles have
/// equal bits, sorts them again in their box. Needs four bytes a triangle more. The order does not depend on the number
/// of threads. Throws Cancelled soon after `monitor` received a request to stop.
std::vector<std::int32_t> spatial_order(std::span<const Vec3> vertices,
                                        std::span<const std::array<std::int32_t, 3>> triangles,
                                        std::vector<std::int32_t> numbers, Monitor& monitor, int threads);

}  // namespace carreau
