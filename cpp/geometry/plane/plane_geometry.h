// SPDX-License-Identifier: BSD-3-Clause
// A plane domain as a geometry that the engine evaluates itself.
#pragma once

#include <string>
#include <vector>

#include "geometry/built_geometry.h"
#include "geometry/plane/plane_domain.h"
#include "metric/prescription.h"

namespace carreau {

/// Default of the parameter eps_smooth.
inline constexpr double usual_eps_smooth = 0.01;

struct PlaneGeometry {
  BuiltGeometry built;
  /// Sizes and metrics at points and along curves; nullptr: the input has none.
  std::shared_ptr<PrescriptionSource> sizes;
  std::vector<std::string> warnings;
  Vec2 low, high;  ///< box of the curves
};

/// Faces are subdomains; a curve between two of them is in both, one inside of one is internal. Results have the
/// references of the input. If a reference is 0 or stands for several entities the model numbers them itself, behind
/// the largest. Face::part_of, FaceCurve::shown_as and Model::shown_points lead back to it.
///
/// `eps_smooth`: tolerance of the polylines (RR-2818 sec. 3.7) by which curves are compared, in shares of an edge.
/// Polylines that conflict are refined three times, by a factor ten each, before the conflict is an error.
///
/// Throws InvalidModel with file and line, naming curves and points. Causes are the exceptions of cut_into_arcs();
/// curves that cross or touch away from points; points on curves that do not pass them, or outside. Also for an open
/// boundary, a side on which the domain would be unbounded, sides and seeds that contradict one another, and no domain
/// at all.
PlaneGeometry build_plane_geometry(const PlaneDomainInput& input, double eps_smooth = usual_eps_smooth);

}  // namespace carreau
