// SPDX-License-Identifier: BSD-3-Clause
// Steep places of fields in space, found on a lifted mesh.
#pragma once

#include <vector>

#include "control_space/control_space.h"
#include "size/size_rules.h"
#include "surface/sample/face_sampling.h"

namespace carreau {

/// Returns the points in (u, v) of a face nearest to the steep places of sources in space, if the sampling has missed
/// them. There the prescribed metric differs from the metric of the control space. The search starts at the nearest
/// points of the lifted mesh. Points farther away than a place reaches, and points outside of the domain, belong to
/// other faces. At most 500. Costs two to nine evaluations a place that is near, and no evaluation if sources have no
/// such place.
std::vector<Vec2> missed_steep_places(const PatchInput& input, const ControlSpace& space, Cad& cad,
                                      const SizeRules& rules, const PatchMesh& mesh, Monitor& monitor);

}  // namespace carreau
