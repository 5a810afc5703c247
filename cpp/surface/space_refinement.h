// After the lift: triangles that turn their backs on the surface, or leave it by more than was promised.
#pragma once

#include "size/size_rules.h"
#include "surface/face_mesher.h"

namespace carreau {

/// Looks for triangles whose normal is more than about 85 degrees from the surface's at a corner or at their centre; where
/// sizes are guaranteed, also for those that exceed the limits (`kept` in SizeParameters::geo_guarantee). An edge of them
/// is swapped when that mends it, else divided at its middle until none is left. Edges on curves stay as they are:
/// what is wrong along them is the curves'. Most meshes are left as they are, at no call where sizes are the
/// same in all directions. Keeps mesh.size and mesh.normal up to date.
///
/// Bends within one edge make such triangles: where a principal curvature vanishes, the size along it jumps from one
/// vertex to the next, and a long edge leaves the surface between them.
void refine_in_space(const PatchInput& input, Cad& cad, SizeRules& rules, const GeometricLimits& kept, PatchMesh& mesh,
                     Monitor& monitor);

}  // namespace carreau
