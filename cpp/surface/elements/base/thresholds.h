// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of elements, with their units, their reasons and the tests that support them.
#pragma once

#include <cstdint>

namespace carreau::thresholds::elements {

/// Least Jacobian over its mean (Jacobian::least) at which repairs stop. Condition numbers of solvers grow with its
/// inverse, and 0 is the limit of validity. [Quadratic.InnerEdgesBendBeforeACurvedBorder]
inline constexpr double good_jacobian = 0.2;
/// Gain of that share. The search rejects a step that gains less: an element that grows along one side raises the share
/// for ever by less and less. A step of .01 edges of a regular element changes it by some .04.
/// [FreeElementsAtCurves.AreValidWhereEdgesTurn]
inline constexpr double min_gain = 0.005;
/// First and last step of the search for a node's place, shares of its edge. The first one reaches over the bulge of an
/// edge that turns by 90 degrees (its sagitta is a fifth of the edge).
inline constexpr double first_step = 0.2, last_step = 0.01;
/// Largest number of places that the search of a face tests, and the share of each of its elements. A place costs about as much as a few
/// evaluations of the surface, so that the search costs no multiple of the mesh. In eleven CAD models at 4 %, meshes that become good need
/// at most 11 places per element. [geometry_fuzz grid 164, 182, molecule 61]
inline constexpr std::int64_t max_trials = 3000, max_trials_of_element = 30;
/// Times that the model is meshed again with half the size beside elements that stay invalid. An edge of a whole circle
/// then has 6 degrees. [CurvedElements.InnerEdgesBendBeforeACurvedBorder]
inline constexpr int max_divisions = 6;
/// Share of an edge that its node is drawn away from a cusp. If two circles touch, parabolas through the middles of
/// edges of length l leave the corner at no angle. Parabolas drawn away by s leave it at some 2 s l times the
/// difference of the curvatures. [CurvedElements.AreValidAtACusp]
inline constexpr double shift_at_cusp = 0.08;
/// Times that invalid curved quadrilaterals become two triangles, before which nodes move.
inline constexpr int max_partings = 4;
/// Ratio of the triangles of all finer meshes together to the first mesh's. Screws and frames of coarse quadrilaterals of second
/// order become valid in the sixth mesh, with twice as many each. [Quadratic.InnerEdgesBendBeforeACurvedBorder]
inline constexpr double max_growth = 12;
/// Triangles. First meshes with fewer triangles count as having this number.
inline constexpr double few_triangles = 1000;

}  // namespace carreau::thresholds::elements
