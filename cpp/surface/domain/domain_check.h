// SPDX-License-Identifier: BSD-3-Clause
// Finds faults that make a discretised parameter domain impossible or hard to mesh, and the edges whose refinement
// repairs it. Source: HDR sec. 3.3.1-3.3.3, RT-0232 sec. 3.3 (CheckCloseEdges and its sisters).
//
// All decisions are exact; n log n on usual domains (predicates/edge_grid.h). All functions but find_loop_defects and
// find_open_loops throw InvalidArgument when an edge refers to a vertex that does not exist or a vertex is not finite.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "control_space/control_space.h"
#include "mesh/plane_mesh.h"

namespace carreau {

/// Two edges that meet where they should not.
struct EdgeConflict {
  int first = 0, second = 0;  ///< indices in PlaneDomain::edges, first < second
  Vec2 uv;                    ///< where: a vertex, or the crossing to rounding
};

/// Pairs of edges of any kind that cross, overlap, duplicate each other, or touch at a point that is not a vertex of
/// both. Two vertices at one place count as different. Sorted by first, then second. Complete except for domains with
/// more than four times as many crossings as edges, or thousands of edges beside each edge. For these it returns some,
/// at least one.
std::vector<EdgeConflict> find_crossings(const PlaneDomain& domain);

/// Returns one of these pairs, if any. n log n whatever the domain.
std::optional<EdgeConflict> find_a_crossing(const PlaneDomain& domain);

/// Names an edge in a sentence, for callers that know the meaning of PlaneEdge::curve. Empty: "edge 3 of curve 2",
/// PlaneEdge::segment and curve counted from 1, or "an edge" when the curve is unknown.
using EdgeNamer = std::function<std::string(const PlaneEdge&)>;

/// Finds faults that need no orientation: invalid indices or coordinates, edges without length, a domain without
/// boundary. Also finds boundary vertices where an odd number of boundary edges end (HDR fig. 3.1, third). Sentences
/// without a full stop, with (u, v).
std::vector<std::string> find_open_loops(const PlaneDomain& domain, const EdgeNamer& name = {});

/// Returns the faults of find_open_loops, if there are any. Otherwise it returns loops without area, loops turned the
/// wrong way, edges against their neighbours, and internal curves outside. It also returns imposed points outside, on
/// an edge or twice at one place. A loop turned the wrong way makes the domain unbounded, or is a hole outside every
/// component. For domains without crossings whose edges are turned.
std::vector<std::string> find_loop_defects(const PlaneDomain& domain, const EdgeNamer& name = {});

/// Turns boundary and degenerate edges so that the domain, the bounded even-odd region, lies on their left. Edge
/// `seed`, as it stands, has the domain on its left if `left` is true, otherwise on its right. False, and the domain
/// stays as it was, when a loop is open or the seed contradicts the nesting (HDR fig. 3.1, third and fourth). If the
/// boundary crosses itself the larger part of each run of edges decides, so that later steps can repair it. Throws
/// DomainError when the seed is not a bounding edge.
bool orient_loops(PlaneDomain& domain, int seed, bool left);

/// Edges to subdivide so that crossing edges stop crossing (HDR sec. 3.3.1). Each pair gives the edge that is longer in
/// (u, v), or both if they join the same vertices. Never a degenerate edge. Increasing.
std::vector<int> edges_to_split_for_crossings(const PlaneDomain& domain);

/// CoefRectangle for a vertex at the distance `width` from an edge (in sizes). Below .1, in zones narrower than a 250th
/// of the size, it falls with the width, down to a fiftieth. Triangles there have Q2 of .035. Edges do not become
/// shorter with the width of the zone. Otherwise a wire 1000 long and .01 thick would have a hundred thousand triangles
/// at a size of 15.
[[nodiscard]] double coefficient_of_width(double coef, double width);

/// Edges that are too long beside a close vertex. A vertex of other edges lies within coef * length of the edge
/// (coefficient_of_width), on the domain's side (HDR sec. 3.3.2). Lengths are in the metric at the edge's midpoint. The
/// band is narrower where an acute corner explains the closeness, so that splitting in halves and checking again ends
/// (README). Vertices nearer than narrowest_share (thresholds.h) are ignored. Needs loops that are turned and do not
/// cross. Never a degenerate edge. Increasing. coef: CoefRectangle; none when it is not positive. `up_to_corners`:
/// corners explain nothing, and the caller ends the splitting.
std::vector<int> edges_to_split_for_closeness(const PlaneDomain& domain, const ControlSpace& metric, double coef,
                                              bool up_to_corners = false);

/// Edges more than `ratio` times longer, in the metric at the midpoints, than the next edge of their curve or loop (HDR
/// sec. 3.3.3). Never a degenerate edge. Increasing. ratio >= 2, else InvalidArgument: below, halving need not end.
std::vector<int> edges_to_split_for_balance(const PlaneDomain& domain, const ControlSpace& metric, double ratio = 2);
/// `size`: the lengths of the edges. `reach` 2: more than `ratio` times longer than the second next edge, too, so that lengths
/// double over two edges at most.
std::vector<int> edges_to_split_for_balance(const PlaneDomain& domain, std::span<const double> size, double ratio, int reach);

}  // namespace carreau
