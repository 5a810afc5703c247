// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/frame.h"

#include <algorithm>
#include <cmath>

#include "surface/remesh/base/thresholds.h"

namespace carreau {

using namespace thresholds::remesh;

SurfaceTolerances surface_tolerances(const CompositeOptions& options, bool by_direction, double angle_slack) {
  const GeometricLimits limits = geometric_limits(options.size);
  // Folds of less than the sharp angle may be flattened.
  const double folded = std::min(usual_angle / 2 + options.sharp_angle, max_angle);
  SurfaceTolerances tolerances{.angle_deg = std::max(usual_angle, folded), .deviation = 0, .share_of_size = usual_deviation};
  if (std::isfinite(limits.edge_angle_deg)) tolerances.angle_deg = limits.edge_angle_deg * angle_slack;
  if (std::isfinite(limits.deviation)) tolerances.deviation = limits.deviation;
  if (by_direction && !options.size.geo_guarantee) tolerances.angle_deg = std::max(tolerances.angle_deg, leaning_angle);
  return tolerances;
}

}  // namespace carreau
