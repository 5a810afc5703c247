// SPDX-License-Identifier: BSD-3-Clause
// Sides of a parameter domain that are one point of space.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "mesh/surface_mesh.h"
#include "support/vec.h"
#include "surface/remesh/bounds/pole.h"

namespace carreau {

/// The degenerate sides of a face, as its flattened triangles show them. Keeps a reference to `face`.
class DegenerateSides {
 public:
  DegenerateSides() = default;
  /// `index`: of the face in SurfaceMesh::faces.
  DegenerateSides(const FaceMesh& face, std::int32_t index);

  /// Returns the point at which the straight way from `a` arrives on the side that ends at local vertex `p`; su, sv: derivatives at a;
  /// `chord`: from a to the pole in space. An edge to a pole is a meridian, whichever end of the side represents the pole in (u, v). If no
  /// side ends at p, as in cross-patch meshes, `at_pole` gives the axis of the way; empty if that is zero.
  [[nodiscard]] std::optional<Vec2> arrival(std::int32_t p, const Tangents& at_pole, const Vec2& a, const Tangents& at_a, const Vec3& chord) const;

 private:
  const FaceMesh* face_ = nullptr;
  std::vector<std::array<std::int32_t, 2>> sides_;  // local vertices, both ways, ascending
  std::array<Vec2, 2> box_;                         // of all (u, v) of the face itself, in meshes free of patches; else empty
};

}  // namespace carreau
