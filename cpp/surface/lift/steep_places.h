// SPDX-License-Identifier: BSD-3-Clause
// Steep places of fields in space, found on a lifted mesh.
#pragma once

#include <vector>

#include "control_space/control_space.h"
#include "size/size_rules.h"
#include "surface/sample/face_sampling.h"

namespace carreau {

/// The points in (u, v) of a face nearest to the steep places that sources know in space, where the prescribed metric
/// is not that of the control space: the sampling has missed it. Begun at the nearest points of the lifted mesh;
/// those farther away than a place reaches, and those outside of the domain, are of other faces. At most 500. Costs two
/// to nine evaluations a place that is near, nothing where sources know none.
std::vector<Vec2> missed_steep_places(const PatchInput& input, const ControlSpace& space, Cad& cad,
                                      const SizeRules& rules, const PatchMesh& mesh, Monitor& monitor);

}  // namespace carreau
