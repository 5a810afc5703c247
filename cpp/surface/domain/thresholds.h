// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room, with their units, their reasons and the tests that support them.
#pragma once

namespace carreau::thresholds::domain {

// Brackets name the tests that rest on a threshold, by default tests of tests/cpp/surface/domain.

// Corners and points (domain_builder)
/// Share of the shortest edge beside them. Ends of curves that are one point in space are one vertex of the domain if
/// they are nearer than this share. Exact corners differ by rounding, seam corners by whole sides. If the loops do not
/// close by that, this share of the shortest curve counts. Hosts have gaps that do not shrink with the size of edges.
/// [surface: BadModels.EndsThatDoNotQuiteMeetAreOneForShortEdgesToo]
inline constexpr double joining_share = 0.25;

// Close edges (domain_closeness)
/// Coefficient. The largest coefficient among neighbours along the boundary. Below one half a split only makes edges
/// that are longer than some edge beside them, so that splitting ends (README). [Closeness.EndsAtAcuteCorners]
inline constexpr double max_among_neighbours = 0.45;
/// Sizes. Width below which the coefficient falls, [Closeness.KeepsTheLengthOfEdgesInThinZones]
inline constexpr double thin_width = 4e-3;
/// Coefficient. The least value of the falling coefficient. [as above]
inline constexpr double min_coefficient = 0.02;
/// Coefficient. From here on shapes take precedence: the coefficient holds at any width, as in the manual. [Closeness.
/// RefinesANarrowZoneAndNothingElse]
inline constexpr double min_wanted_coefficient = 0.1;
/// Ratio. Two edges do not form a narrow zone if the path along the boundary between them is at most this many times
/// longer than the direct way. [Closeness. LooksAtTheSideOfTheDomainOnly]
inline constexpr double longest_detour = 4;
/// Share of the size. Narrower zones are left to long triangles. Such a zone requires edges six hundred times shorter
/// than the size, which would spoil the faces beside it and not even fill it well. The narrowest zone that edges are
/// cut for, a sliver of 1e-4 of a model at a size of a fifth of the model, has 5e-4.
/// [Closeness.KeepsTheLengthOfEdgesInThinZones]
inline constexpr double narrowest_share = 4e-4;

}  // namespace carreau::thresholds::domain
