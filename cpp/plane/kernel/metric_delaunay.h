// SPDX-License-Identifier: BSD-3-Clause
// Delaunay in the metric of the vertices, however many swaps it takes.
#pragma once

#include <cstdint>
#include <span>

#include "plane/kernel/triangulation.h"
#include "support/monitor.h"

namespace carreau::plane {

/// Swaps until no swap makes the flatter of two triangles less flat. The smallest angle in the mean metric of a
/// triangle's corners measures flatness: in a constant metric this is Delaunay's criterion, and in a varying metric
/// swaps cannot run in circles. Starts with the edges of the triangles `start`. Needs the metrics at the vertices;
/// imposed edges stay.
void make_delaunay_in_metric(Triangulation& mesh, std::span<const std::int32_t> start, Monitor& monitor);

}  // namespace carreau::plane
