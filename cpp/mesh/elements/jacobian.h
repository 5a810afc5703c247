// SPDX-License-Identifier: BSD-3-Clause
// Jacobians of elements, by their Bernstein coefficients: if all are positive the element is valid everywhere, not at
// some points only.
#pragma once

#include <array>
#include <span>

#include "mesh/cells.h"
#include "support/vec.h"

namespace carreau {

/// Bernstein coefficients of x_s cross x_t, the derivatives of an element by the coordinates of its reference (the unit
/// triangle or the unit square). They are vectors of degree 0, 2, (1, 1) or (3, 3). Degree 2: the corners, then the
/// coefficients of the sides in the order of cells.h; (1, 1): the corners in their order; (3, 3): c[4 i + k] of the
/// powers i of s and k of t. In a plane element only z differs from 0.
struct Jacobian {
  int count = 0;
  std::array<Vec3, 16> c;

  /// The integral of the normal over the reference triangle or square, up to a factor: it depends on the border alone.
  [[nodiscard]] Vec3 mean() const noexcept;
  /// Least coefficient along the mean normal over the mean: 1 for a constant Jacobian, positive: the element is valid.
  /// 0 or less if the mean vanishes.
  [[nodiscard]] double least() const noexcept;
  /// The least along a given direction: {0, 0, 1} for plane elements.
  [[nodiscard]] double min_along(const Vec3& direction) const noexcept;
};

/// `nodes`: node_count(kind) positions in the order of cells.h.
Jacobian jacobian(CellKind kind, std::span<const Vec3> nodes) noexcept;

/// A lower bound of Jacobian::least() of a curved triangle, from its straight triangle and the bends of its sides, at a
/// tenth of the cost; -infinity: no bound. The straight triangle of a plane triangle must be counterclockwise.
double min_of_triangle6(std::span<const Vec3> nodes) noexcept;
double min_of_triangle6(std::span<const Vec2> nodes) noexcept;

/// The point of an element at (s, t) of its reference: the triangle s, t >= 0, s + t <= 1, or the unit square.
Vec3 point_of_cell(CellKind kind, std::span<const Vec3> nodes, double s, double t) noexcept;

}  // namespace carreau
