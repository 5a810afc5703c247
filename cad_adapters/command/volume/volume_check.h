// SPDX-License-Identifier: BSD-3-Clause
// Verifies the result of an engine, and makes elements of order 2.
#pragma once

#include "volume/volume_mesh.h"

namespace command {

/// Verifies that no vertex of the surface moved, that tetrahedra have positive volumes which add up to the volumes of solids within
/// 1e-10, and that the surface is the border of solids triangle by triangle. Orients tetrahedra, and gives vertices of the surface
/// their exact coordinates. Throws Failure.
void verify(VolumeMesh& volume);

/// Adds nodes on edges: nodes of the surface on its edges, middles elsewhere. A curved edge whose element would be turned over becomes
/// straight.
void make_quadratic(VolumeMesh& volume);

}  // namespace command
