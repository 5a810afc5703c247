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

/// Curves whose vertices are better put in the middles of their edges: between two sides that are nearer to each other
/// than their edges are long, and whose vertices face each other, there is only place for triangles with a right angle
/// (Q2 0.87 at best, HDR eq. 1.6: sqrt(3) a / (1 + a^2) where edges are a times the width); moved by half an edge on
/// one side they are isosceles (2 sqrt(3) a / (1.5 a^2 + 2)). Judged in space, by the best triangle over each edge; a
/// curve has several faces, and which of them are moved is decided together. Increasing indices in Topology::curves.
/// Asks the host where curves would be cut then, one that is re-entrant from `threads` threads. `domains`: of faces
/// that may be looked at, empty ones not.
std::vector<int> curves_to_stagger(const CurveModel& model, const std::vector<DiscreteCurve>& curves,
                                   std::span<const std::optional<FaceDomain>> domains, int threads, Monitor& monitor);

/// Puts the vertices inside a curve in the middles of its edges, and keeps its ends: its first and last edges become
/// half as long. A closed curve keeps the vertex that closes it.
void stagger(DiscreteCurve& curve, const CurveModel& model);

}  // namespace carreau
