// SPDX-License-Identifier: BSD-3-Clause
// Sides of a parameter domain that are one point of space.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "mesh/surface_mesh.h"
#include "support/vec.h"

namespace carreau {

/// The degenerate sides of a face, as its flattened triangles show them. Keeps a reference to `face`.
class DegenerateSides {
 public:
  DegenerateSides() = default;
  explicit DegenerateSides(const FaceMesh& face);

  /// Where on the side that ends at local vertex `p` the straight way from `a` arrives; su, sv: derivatives at a;
  /// `chord`: from a to the pole in space. An edge to a pole is a meridian, whichever end of the side stands for the
  /// pole in (u, v). Empty where no side ends at p.
  [[nodiscard]] std::optional<Vec2> arrival(std::int32_t p, const Vec2& a, const Vec3& su, const Vec3& sv, const Vec3& chord) const;

 private:
  const FaceMesh* face_ = nullptr;
  std::vector<std::array<std::int32_t, 2>> sides_;  // local vertices, both ways, ascending
};

}  // namespace carreau
