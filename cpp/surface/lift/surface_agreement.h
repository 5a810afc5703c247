// SPDX-License-Identifier: BSD-3-Clause
// After the lift: angles between triangles and the surface.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "surface/patch.h"

namespace carreau {

/// Faults of a lifted patch.
struct SurfaceAgreement {
  /// Triangles that turn their backs on the surface they stand for, or stand upright on it.
  std::int64_t turned = 0;
  std::vector<int> turned_triangles = {};  ///< their numbers
  /// Area of the mesh over the area of the surface, less 1. Chords make a mesh smaller. It is larger where long edges
  /// leave the surface by as much as their neighbours are away. Triangles then stand on it like scales (Schwarz's
  /// lantern). 0 if it is small, or normals are not known.
  double excess = 0;

  [[nodiscard]] bool leans() const noexcept;
  [[nodiscard]] bool wrong() const noexcept { return turned > 0 || leans(); }
  [[nodiscard]] bool better_than(const SurfaceAgreement& other) const noexcept;
  /// A text for a person, after the face; empty if all is well.
  [[nodiscard]] std::string text() const;
};

/// `doubtful`: triangles that may be turned (refine_in_space). If normals are known (mesh.normal) areas are compared
/// first with the areas of projections along them. Sixteen evaluations for each doubtful triangle, and for each
/// triangle where areas differ.
SurfaceAgreement measure_agreement(const PatchInput& input, Cad& cad, const std::vector<int>& doubtful,
                                   const PatchMesh& mesh, Monitor& monitor);

}  // namespace carreau
