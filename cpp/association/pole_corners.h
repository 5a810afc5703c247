// SPDX-License-Identifier: BSD-3-Clause
// Corners of elements at poles, which have any place of the side that a pole flattens.
#pragma once

#include <cstdint>
#include <map>
#include <span>

#include "mesh/surface_mesh.h"
#include "surface/elements/base/curve_middles.h"

namespace carreau::refining {

/// The side of (u, v) that is a pole.
struct PoleSide {
  Vec2 low, high;

  /// The place of the pole that the way from `uv` reaches.
  [[nodiscard]] Vec2 arrival(Vec2 pole, const Vec2& uv) const noexcept;
};

/// Returns the poles of a face by vertex of the mesh.
std::map<std::int32_t, PoleSide> poles_of(const FaceMesh& face);

/// Gives elements local vertices of their own at a pole, if an element does not have its corner between its sides there. Middles of such
/// sides lie on their meridians, so that the part at the pole would not be convex in (u, v). `sides`: of curves.
void part_poles(FaceMesh& face, const std::map<std::int32_t, PoleSide>& poles, std::span<const CurveSide> sides);

}  // namespace carreau::refining
