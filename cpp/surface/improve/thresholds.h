// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room, with their units, their reasons and the tests that support them.
#pragma once

#include <cstdint>

namespace carreau::thresholds {

// Shapes are Q2 (HDR eq. 1.6), 0 to 1. Agreements are cosines of angles between normals.

/// Vertices moved for shapes in space (improve/smoothing_test).
namespace smoothing {
/// Mean lengths of the edges around: first step of the search, halved down to shares::small.
inline constexpr double first_step = 0.4;
}  // namespace smoothing

/// Triangles that leave the surface (agreement_test, guarantees_test, lift/surface_agreement_test).
namespace refinement {
/// Shape of the triangles that a division for an angle or a distance makes, with isotropic sizes. Halves of an equilateral
/// triangle have .75.
inline constexpr double min_divided_shape = 0.4;
/// The same if planes of triangles keep their angle (geo_guarantee 2): beside a long straight side they need halves of halves.
inline constexpr double min_guaranteed_shape = 0.1;
/// Largest number of divisions that lead to a triangle. If all triangles beside a coarse chord are turned over,
/// divisions would continue until vertices coincide.
inline constexpr std::uint8_t deepest = 12;
}  // namespace refinement

/// Searches over the assembled mesh, of either kind (improve/even_edges_test, grade/gradation_test,
/// guarantees_test).
namespace assembled {
/// The surroundings of its neighbours' neighbours judge a change beside a vertex; a change beside these may follow.
inline constexpr int rings = 3;
}  // namespace assembled

/// Ratios of lengths at a vertex (improve/even_edges_test, grade/gradation_test).
namespace length_ratio {
/// Times that a new vertex is moved.
inline constexpr int placements = 4;
}  // namespace length_ratio

}  // namespace carreau::thresholds
