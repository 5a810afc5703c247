// SPDX-License-Identifier: BSD-3-Clause
// After the lift: triangles that turn their backs on the surface, or leave it by more than was promised.
#pragma once

#include <vector>

#include "size/size_rules.h"
#include "surface/sample/face_sampling.h"

namespace carreau {

/// Looks for triangles whose normal is more than 90 degrees from the surface's at their centre; where metrics govern
/// that follow the curvature or differ by direction, more than 85 degrees there or at a corner, and, where sizes are
/// guaranteed, also for those that exceed the limits `kept`. An edge of them is swapped when that mends it, else the
/// longest edge around is divided at its middle. Edges on curves stay as they are: what is wrong along them is the
/// curves'. Most meshes are left as they are, without a call where sizes are the same in all directions; so are those
/// that no division makes better: cusps, creases, surfaces that jump. Keeps mesh.size and mesh.normal up to date.
///
/// Bends within one edge make such triangles: where a principal curvature vanishes, the size along it jumps from one
/// vertex to the next, and a long edge leaves the surface between them. Returns the triangles that are still wrong,
/// ascending.
std::vector<int> refine_in_space(const PatchInput& input, Cad& cad, const SizeRules& rules, const GeometricLimits& kept,
                                 PatchMesh& mesh, Monitor& monitor, Team* team = nullptr);

}  // namespace carreau
