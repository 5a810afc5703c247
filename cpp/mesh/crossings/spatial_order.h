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

/// `numbers` of triangles, so that triangles near each other in the list are near each other in space: by the bits of
/// their centres' coordinates in turn (Morton 1966, "A computer oriented geodetic data base"). Where many triangles
/// have the same bits, they are sorted again in a box of their own. Needs four bytes a triangle more. The same for any
/// number of threads. Throws Cancelled soon after `monitor` was asked to stop.
std::vector<std::int32_t> spatial_order(std::span<const Vec3> vertices,
                                        std::span<const std::array<std::int32_t, 3>> triangles,
                                        std::vector<std::int32_t> numbers, Monitor& monitor, int threads);

}  // namespace carreau
