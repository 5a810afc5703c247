// SPDX-License-Identifier: BSD-3-Clause
// After the lift: shapes of triangles in space, by swaps and moves in turn.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "size/size_rules.h"
#include "surface/patch.h"

namespace carreau {

/// Swaps edges of the worst triangles (shape_level::poor), if sizes are isotropic. Does not evaluate the host.
/// Returns the bad triangles (BadRegion) if no triangle was among the worst, so that the mesh did not change.
std::optional<std::vector<std::int32_t>> swap_poor_edges(const PatchInput& input, PatchMesh& mesh, Monitor& monitor);

/// Moves vertices and swaps edges of bad triangles (BadRegion) for their shapes in space, if sizes are isotropic.
/// Requires a lifted mesh whose sizes are known; keeps them up to date. Does not evaluate the host if no triangle is
/// bad. `bad`: the bad triangles, if known.
void shape_in_space(const PatchInput& input, Cad& cad, const SizeRules& rules, PatchMesh& mesh,
                    std::optional<std::vector<std::int32_t>> bad, Monitor& monitor);

}  // namespace carreau
