// SPDX-License-Identifier: BSD-3-Clause
// Remeshing of a whole cross-patch mesh to the prescribed lengths and to good shapes.
#pragma once

#include <cstdint>
#include <span>

#include "support/monitor.h"
#include "surface/remesh/base/cross_patch_mesh.h"

namespace carreau {

struct RemeshingReport {
  std::int64_t collapses = 0, splits = 0, swaps = 0, moves = 0;
  int rounds = 0;

  RemeshingReport& operator+=(const RemeshingReport& other) noexcept {
    collapses += other.collapses, splits += other.splits, swaps += other.swaps, moves += other.moves;
    rounds += other.rounds;
    return *this;
  }
};

/// Returns whether a triangle needs remeshing if not all do: by its shape, or the length of a side.
[[nodiscard]] bool is_bad(const CrossPatchMesh& mesh, const EditableMesh::Triangle& t);

/// Halves the edges of a mesh that is well shaped and twice as coarse as prescribed. Each triangle with three long edges becomes four,
/// whose new vertices have six edges. Lengths and shapes are then as the coarse ones were, and remesh() may follow.
RemeshingReport halve(CrossPatchMesh& mesh, Monitor& monitor);

/// Swaps edges and moves vertices around triangles of a shape below `below` where shapes are better for it, in the sum. The budget stays.
RemeshingReport polish(CrossPatchMesh& mesh, double below, Monitor& monitor);

/// Collapses short edges inside, splits long ones, swaps and moves, around triangles that violate the prescription, until little changes.
/// `everywhere`: for meshes that no mesher made: works at all triangles, not only at triangles below `good_enough` and their surroundings.
/// `thorough`: more passes for shapes. `around`: work starts around these vertices only; empty: around bad triangles. Deterministic. Throws
/// the exceptions of the host, and Cancelled.
RemeshingReport remesh(CrossPatchMesh& mesh, Monitor& monitor, bool everywhere = false, bool thorough = false,
                       std::span<const std::int32_t> around = {});

}  // namespace carreau
