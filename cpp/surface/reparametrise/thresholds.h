// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room, with their units, their reasons and the tests that support them.
#pragma once

#include <cstddef>

namespace carreau::thresholds::reparametrise {

// Lines along each parameter
/// Places. The first ones, as many at boundary vertices, and lines across at such places.
/// [UnevenParameters.FastAlongBoth]
inline constexpr std::size_t first_places = 16;
/// Share of the length of all. No piece of a parameter has a longer chord.
/// [UnevenParameters.FastWithinAMillionthInside]
inline constexpr double finest = 1.0 / 128;
/// Share of the domain. Narrower pieces are not divided; a chord of the share above is a jump then. [rounding]
inline constexpr double narrowest = 1e-13;
/// Ratio. If all lines of a family together are longer than this factor times the longest one, fast places differ from
/// line to line. [UnevenParameters.FastAlongASlantedLine]
inline constexpr double max_detours = 8;

// New parameters
/// Ratio of speeds. A parameter along which they differ by less is left as it is. [UnevenParameters.ExtremeWeights]
inline constexpr double even = 30;
/// Share of the mean speed. Lines that stand still count as so fast. [UnevenParameters.FastAtABorder]
inline constexpr double min_speed = 0.02;
/// Share of the whole. Shorter pieces are joined to the next ones. [UnevenParameters.FastWithinAMillionthInside]
inline constexpr double shortest = 1e-7;

// Back to the host's (u, v)
/// Share of the quality in space of two triangles, which a swap must leave. [UnevenParameters.NeighboursAndImposed...]
inline constexpr double min_kept = 0.5;

}  // namespace carreau::thresholds::reparametrise
