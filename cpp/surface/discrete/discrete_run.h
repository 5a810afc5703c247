// SPDX-License-Identifier: BSD-3-Clause
// Meshes of surfaces given as triangles: made again in space, on the smooth surface over them.
#pragma once

#include "geometry/discrete/discrete_cad.h"
#include "surface/options.h"
#include "surface/result.h"

namespace carreau {

/// Refines the triangles to the prescribed sizes, then remeshes them on the exact surface (surface/remesh). Faces
/// are the faces of the model. Curves are the sharp lines, with the ranks of lines as references; corners have theirs.
/// `cad` evaluates the surface. Throws Cancelled, LimitError, and the exceptions of sources of sizes.
CompositeResult mesh_discrete(const Model& model, const discrete::DiscreteCad& surface, Cad& cad,
                              const CompositeOptions& options, Monitor& monitor);

}  // namespace carreau
