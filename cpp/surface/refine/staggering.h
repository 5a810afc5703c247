// SPDX-License-Identifier: BSD-3-Clause
// Strips of one layer of triangles: vertices of one side face the middles of edges of the other one.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "curve/discrete_curve.h"
#include "support/monitor.h"
#include "surface/domain/domain_builder.h"

namespace carreau {

/// Curves whose vertices should move to the middles of their edges. Suppose that two sides are nearer to each other
/// than their edges are long, and their vertices face each other. Then there is only place for triangles with a right
/// angle. Their Q2 is 0.87 at best (HDR eq. 1.6: sqrt(3) a / (1 + a^2) where edges are a times the width). Moved by
/// half an edge on one side they are isosceles (2 sqrt(3) a / (1.5 a^2 + 2)). Judged in space, by the best triangle
/// over each edge. A curve has several faces, and one decision covers all curves together. Increasing indices in
/// Topology::curves. Evaluates the host where curves would be cut then; a re-entrant host from `threads` threads.
/// `domains`: the faces to consider; empty domains are passed over.
std::vector<int> curves_to_stagger(const CurveModel& model, const std::vector<DiscreteCurve>& curves,
                                   std::span<const std::optional<FaceDomain>> domains, int threads, Monitor& monitor);

/// Puts the vertices inside a curve in the middles of its edges, and keeps its ends: its first and last edges become
/// half as long. A closed curve keeps the vertex that closes it.
void stagger(DiscreteCurve& curve, const CurveModel& model);

}  // namespace carreau
