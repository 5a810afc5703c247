// SPDX-License-Identifier: BSD-3-Clause
// Quartic Gregory triangles (Walton, Meek 1996).
#pragma once

#include <array>

#include "cad/cad.h"
#include "support/vec.h"

namespace carreau::discrete {

/// A cubic Bezier curve.
using Cubic = std::array<Vec3, 4>;
Vec3 point_of(const Cubic& curve, double t) noexcept;

/// A patch over the triangle u, v >= 0, u + v <= 1 with the corners (0, 0), (1, 0), (0, 1): S = sum of B(ijk) P(ijk) of
/// degree four, where the three points inside depend on the place (Gregory).
struct GregoryTriangle {
  /// Cubics, raised in degree: side i has points[4 i .. 4 i + 3] and goes from corner i to the next one.
  std::array<Vec3, 12> border;
  /// Points inside. inner[2 i] is beside the start of side i and keeps its tangent planes; inner[2 i + 1] is beside its
  /// end.
  std::array<Vec3, 6> inner;

  /// Exact up to second derivatives. They have no limit at corners: there the limit along the bisector is taken.
  [[nodiscard]] SurfaceJet at(Vec2 uv, unsigned want) const noexcept;
  /// Largest distance between corresponding control points of the patch and of the flat triangle. It bounds the
  /// distance between points of the patch and of the triangle with equal (u, v), in both directions.
  [[nodiscard]] double deviation() const noexcept;
};

/// The patch between three curves, side i from corner i to the next one. normals[2 i] and normals[2 i + 1] are the
/// surface's normals at the ends of side i, across which tangents are interpolated.
GregoryTriangle gregory_triangle(const std::array<Cubic, 3>& sides, const std::array<Vec3, 6>& normals) noexcept;

}  // namespace carreau::discrete
