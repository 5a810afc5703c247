// SPDX-License-Identifier: BSD-3-Clause
// From patches to one conforming mesh.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "surface/patch.h"
#include "surface/refine/boundary_refinement.h"
#include "surface/result.h"

namespace carreau {

/// Joins patches along their curves. A vertex of a curve or a corner becomes one vertex of the mesh, however many faces and places in (u,
/// v) it has. Triangles that a degenerate side flattens are left out. patches[f] is empty for a face that failed or that another process
/// keeps, and is emptied here. has_patch[f] is 0 for the former only. Returns, by face, the numbers in its patch of the triangles that are left out.
std::vector<std::vector<std::int32_t>> assemble(const Model& model, const Topology& topology, const RefinedDomains& domains,
                                                const std::vector<DiscreteCurve>& curves, const std::vector<char>& has_patch,
                                                std::vector<std::optional<PatchMesh>>& patches, CompositeResult& result);

}  // namespace carreau
