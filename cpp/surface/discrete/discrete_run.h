// SPDX-License-Identifier: BSD-3-Clause
// Meshes of surfaces given as triangles: made again in space, on the smooth surface over them.
#pragma once

#include "geometry/discrete/discrete_cad.h"
#include "surface/options.h"
#include "surface/result.h"

namespace carreau {

/// The triangles are cut by the wanted sizes, then remeshed with the surface as the truth (surface/independent). Faces
/// are those of the model, curves the sharp lines, with the ranks of lines as references; corners have theirs.
/// `cad` asks the surface. Throws Cancelled, LimitError, and what sources of sizes throw.
CompositeResult mesh_discrete(const Model& model, const discrete::DiscreteCad& surface, Cad& cad,
                              const CompositeOptions& options, Monitor& monitor);

}  // namespace carreau
