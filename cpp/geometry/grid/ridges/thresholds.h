// SPDX-License-Identifier: BSD-3-Clause
// The numbers that decide something about ridges of grids.
#pragma once

namespace carreau::grid::thresholds::ridges {

/// Least fall of the curvature k across a ridge: its second derivative is so many k^3. An ellipse of axes a, b has 3 (1 - (b / a)^2) there; the
/// circle 0. [Ridges.CirclesHaveNone]
inline constexpr double min_fall = 0.1;
/// Share of a cell between places of a ridge. Shorter chords would turn by the rounding of their ends. [Ridges.*]
inline constexpr double step = 0.6;
/// Share of a cell between the border of a grid and a ridge that is the border. [Ridges.OnTheBorderAreTheBorder]
inline constexpr double beside_border = 0.2;
/// Evaluations for a place of a ridge on an edge. [Ridges.OfARingAreClosedLinesWithoutZigzag]
inline constexpr int max_evaluations = 12;

}  // namespace carreau::grid::thresholds::ridges
