// SPDX-License-Identifier: BSD-3-Clause
// After the lift: triangles that turn their backs on the surface, or exceed the guaranteed distance.
#pragma once

#include <vector>

#include "size/size_rules.h"
#include "surface/sample/face_sampling.h"

namespace carreau {

/// Looks for triangles whose normal is more than 90 degrees from the surface's at their centre. If metrics follow the
/// curvature or differ by direction, the limit is 85 degrees, there or at a corner. If sizes are guaranteed, it also
/// looks for triangles that exceed the limits `kept`. Limits of planes at most double the triangles. An edge of such a
/// triangle is swapped if that repairs it; otherwise the longest edge around is divided at its middle. Edges on curves
/// stay as they are: faults along them belong to the curves. Most meshes stay as they are, without a call if sizes are
/// equal in all directions. Meshes that no division improves stay too: cusps, creases, surfaces that jump. Keeps
/// mesh.size and mesh.normal up to date.
///
/// Bends within one edge make such triangles. If a principal curvature vanishes, the size along it jumps from one
/// vertex to the next, and a long edge leaves the surface between them. Returns the triangles that are still wrong,
/// ascending.
std::vector<int> refine_in_space(const PatchInput& input, Cad& cad, const SizeRules& rules, const GeometricLimits& kept,
                                 PatchMesh& mesh, Monitor& monitor);

}  // namespace carreau
