// SPDX-License-Identifier: BSD-3-Clause
// Cuts of a cross-patch mesh into parts, by its triangles and their sizes, for any number of executors.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/remesh/base/cross_patch_mesh.h"

namespace carreau {

/// Cuts triangles into parts of equal weight, at most `most` but for rounding. It halves parts where their centroids extend farthest, again
/// and again. `weight`: by triangle of the mesh. Triangles of a part are ascending.
std::vector<std::vector<std::int32_t>> cut_across(const CrossPatchMesh& mesh, std::vector<std::int32_t> triangles,
                                                  std::span<const float> weight, double most);

/// Returns the groups of triangles that share vertices, directly or over others of the group, in the order of their
/// first triangles.
std::vector<std::vector<std::int32_t>> connected(const CrossPatchMesh& mesh, std::span<const std::int32_t> triangles);

/// Marks vertices within `edges` edges of one of `vertices`.
std::vector<char> near_vertices(const CrossPatchMesh& mesh, std::span<const std::int32_t> vertices, int edges);

/// Triangles with a corner that is near, ascending.
std::vector<std::int32_t> triangles_at(const CrossPatchMesh& mesh, const std::vector<char>& near);

}  // namespace carreau
