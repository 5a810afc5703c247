// SPDX-License-Identifier: BSD-3-Clause
// The largest ellipsoid inside the unit balls of many metrics (HDR sec. 2.5.4).
#pragma once

#include <span>

#include "metric/metric3_algebra.h"

namespace carreau {

/// The metric whose unit ball has the largest volume inside all others: M - M_i is positive semi-definite, and det M is
/// the least. It is unique, and does not depend on the order. For two metrics it is intersection() (HDR eq. 2.22);
/// successive intersections of more have a ball that is no larger. Metrics are positive definite; there is at least one.
/// Volumes are right to 1e-9.
Metric2 largest_inside(std::span<const Metric2> metrics);
Metric3 largest_inside(std::span<const Metric3> metrics);

}  // namespace carreau
