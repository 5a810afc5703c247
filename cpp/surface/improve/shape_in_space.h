// SPDX-License-Identifier: BSD-3-Clause
// After the lift: shapes of triangles in space, by swaps and moves in turn.
// `team`: processes that make the patch together, and look for such triangles in shares; null: this one alone.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "size/size_rules.h"
#include "support/ranks/team.h"
#include "surface/patch.h"

namespace carreau {

/// Where sizes are isotropic: edges of the worst triangles (thresholds::shape::poor) are swapped. Asks no host.
/// What is bad (BadRegion) where no triangle was among the worst: the mesh is as it was.
std::optional<std::vector<std::int32_t>> swap_poor_edges(const PatchInput& input, PatchMesh& mesh, Monitor& monitor,
                                                        Team* team = nullptr);

/// Where sizes are isotropic: vertices and edges of bad triangles (BadRegion) are moved and swapped for their shapes in
/// space. Of a lifted mesh whose sizes are known; keeps them up to date. Asks nothing where no triangle is bad.
/// `bad`: where that is known.
void shape_in_space(const PatchInput& input, Cad& cad, const SizeRules& rules, PatchMesh& mesh,
                    std::optional<std::vector<std::int32_t>> bad, Monitor& monitor, Team* team = nullptr);

}  // namespace carreau
