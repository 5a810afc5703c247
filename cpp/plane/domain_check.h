// Detection of what makes a discretised parameter domain impossible or bad to mesh, and of the edges to
// refine to mend it (HDR sec. 3.3.1-3.3.3, RT-0232 sec. 3.3 CheckCloseEdges and its sisters).
#pragma once

#include <string>
#include <vector>

#include "plane/plane_mesh.h"
#include "size/control_space.h"

namespace carreau {

/// Two edges that meet where they should not.
struct EdgeConflict {
  int first = 0, second = 0;  ///< indices in PlaneDomain::edges
  Vec2 uv;                    ///< where
};

/// Pairs of edges that cross, overlap, or touch away from a common vertex. Exact; n log n on usual domains.
/// Includes an imposed vertex that lies on an edge it does not belong to only as far as edges are concerned
/// (isolated points on edges: see find_points_on_edges).
std::vector<EdgeConflict> find_crossings(const PlaneDomain& domain);

/// Sentences about loops: a boundary vertex without exactly as many edges in as out, a loop of zero area,
/// an outer loop turned the wrong way (the domain would be unbounded), a hole outside every component,
/// imposed points outside the domain or on an edge.
std::vector<std::string> find_loop_defects(const PlaneDomain& domain);

/// Turns boundary edges so that the domain lies on their left: for every loop, by nesting, given that edge
/// `seed` has the domain on its left when `left` and on its right otherwise. When `seed` contradicts the nesting
/// (the domain would be the outside), returns false and leaves the domain as it was (HDR fig. 3.1).
bool orient_loops(PlaneDomain& domain, int seed, bool left);

/// Edges to subdivide so that crossing edges stop crossing: of each pair the longer (HDR sec. 3.3.1).
std::vector<int> edges_to_split_for_crossings(const PlaneDomain& domain);

/// Edges longer than what is close to them allows: a foreign vertex lies within coef * length of the edge, lengths in
/// the metric (HDR sec. 3.3.2; narrower at acute corners). coef: CoefRectangle.
std::vector<int> edges_to_split_for_closeness(const PlaneDomain& domain, const ControlSpace& metric, double coef);

/// Edges more than `ratio` times longer, in the metric, than the next edge of their curve or loop (HDR sec. 3.3.3).
std::vector<int> edges_to_split_for_balance(const PlaneDomain& domain, const ControlSpace& metric, double ratio = 2);

}  // namespace carreau
