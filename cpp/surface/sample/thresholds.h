// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room, with their units, their reasons and the tests that support them.
#pragma once

#include <cstddef>

namespace carreau::thresholds::sample {

// In brackets: the tests that rest on it, of tests/cpp/surface.

/// Shares of the domain's box. Distances from a degenerate point at which limits are taken; the second if the first is
/// outside. [FaceMetric.AtAPoleIsTheLimitAlongItsMeridian]
inline constexpr double ways_inside[] = {1e-4, 1e-6};
/// Ratio of speeds. Largest speed of a parametrisation over its usual speed; above it other parameters are searched;
/// [UnevenParameters]
inline constexpr double uneven_speed = 1000;
/// Ratio of speeds. Limit if no other parameters exist. [UnevenParameters.ExtremeWeights]
inline constexpr double hopeless_speed = 30'000;

// Growth from the edges of a boundary (edge_growth)
/// Triangles. Smaller meshes are not checked, since sampling again would cost more. [limits_test]
inline constexpr double few_triangles = 10'000;
/// Times the number of triangles by sizes and growth. Straight distances and rounding of a sound control space leave
/// 1.3 at most. [limits_test]
inline constexpr double max_growth_excess = 2;
/// Times. Factor on the least size of edges, from one round to the next. [limits_test]
inline constexpr double growth_raise = 8;

}  // namespace carreau::thresholds::sample
