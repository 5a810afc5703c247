// SPDX-License-Identifier: BSD-3-Clause
// Elements of periodic faces of a cross-patch mesh: images of the elements of their masters.
#pragma once

#include <string>

#include "periodic/periodic_model.h"
#include "surface/remesh/base/charts.h"
#include "surface/remesh/reassembly.h"

namespace carreau {

/// Moves vertices and nodes of periodic curves to the images of the vertices and nodes of their roots, and gives each slave the elements of
/// its master. `before`: the mesh of the atlas, whose slaves have the triangles of their masters. Borders of periodic faces are lines of the
/// mesh, with corresponding vertices. Returns the reason why an image is no mesh; empty: all are.
std::string carry_cells(const CurveModel& model, const PeriodicModel& periodic, const SurfaceMesh& before, const Charts& charts,
                        CrossPatchResult& made);

}  // namespace carreau
