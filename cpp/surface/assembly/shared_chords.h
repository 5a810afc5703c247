// SPDX-License-Identifier: BSD-3-Clause
// Inner edges by which patches would touch each other away from their curves.
#pragma once

#include <optional>
#include <vector>

#include "support/monitor.h"
#include "surface/patch.h"
#include "surface/refine/boundary_refinement.h"

namespace carreau {

/// A chord is an inner edge of a patch whose two ends lie on curves, or one end on a seam. Several chords with the same two vertices of
/// space, in one patch or in several, would be one edge of four triangles. A chord with the vertices of a curve's edge would be an edge of
/// three triangles. A chord that joins a vertex with itself across a seam would not be an edge. A chord that joins the two sides of a seam
/// would cut through a surface that it goes round. Each chord gets a vertex at its middle, on its own surface. Triangles with the same
/// three vertices that are left (all their edges on curves) get a vertex inside. patches[f] is empty for a face that failed. Each
/// process of the executor has some of the patches, and all call the function; all patches are here if it has one process. Returns the
/// number of new vertices.
std::int64_t separate_chords(const Model& model, const Topology& topology, const RefinedDomains& domains,
                             const std::vector<DiscreteCurve>& curves, Cad& cad,
                             std::vector<std::optional<PatchMesh>>& patches, const Executor& executor, Monitor& monitor);

}  // namespace carreau
