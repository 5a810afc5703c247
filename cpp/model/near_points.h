// SPDX-License-Identifier: BSD-3-Clause
// Points of space that are one within a tolerance.
#pragma once

#include <span>

#include "model/union_find.h"
#include "support/vec.h"

namespace carreau {

/// Merges i and j in `sets` for all points nearer to each other than eps > 0, and so on from point to point.
/// n log n for n points, however many of them coincide.
void merge_near_points(std::span<const Vec3> points, double eps, UnionFind& sets);

}  // namespace carreau
