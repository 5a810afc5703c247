// SPDX-License-Identifier: BSD-3-Clause
// Sizes and meshes of triangulated faces as images of other faces.
#pragma once

#include <span>

#include "cad/cad.h"
#include "support/monitor.h"
#include "surface/discrete/periodic_triangles.h"
#include "surface/remesh/base/charts.h"
#include "surface/result.h"

namespace carreau {

/// Gives lines and masters the least size of both sides. `size`: by vertex of `mesh`. Returns the least factor of a size on a line.
double share_sizes(const PeriodicTriangles& periodic, const SurfaceMesh& mesh, std::span<double> size);

/// Replaces meshes of slaves by images of their masters' meshes, on the slaves' own triangles of the atlas, and links the vertices. Throws
/// InvalidModel: an image misses the slave.
void make_periodic(const PeriodicTriangles& periodic, Cad& cad, CompositeResult& result, Monitor& monitor);

}  // namespace carreau
