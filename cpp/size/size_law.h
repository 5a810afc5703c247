// SPDX-License-Identifier: BSD-3-Clause
// Interpolation of a size between two points.
#pragma once

#include "metric/metric2_algebra.h"

namespace carreau {

/// Laws of interpolation of sizes between two points (RT-0232 sec. 3.3): the laws of metrics along their axes.
using SizeLaw = MetricLaw;

/// h at fraction r in [0, 1] between h1 and h2 > 0 (RR-2818 sec. 5.4, HDR eq. 2.11-2.12).
double interpolate_size(SizeLaw law, double h1, double h2, double r) noexcept;

}  // namespace carreau
