// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this folder: their meaning, unit, reason and evidence.
#pragma once

namespace carreau::thresholds::layers {

// In brackets: the tests of each value, in tests/cpp/surface/layers.

/// Angles inside the domain, degrees. Beyond the first a fan of columns turns around the corner; below the second the
/// corner has no column, since rows would be twice as long as high. [LayerRows.CornersHaveFansAndMerge]
inline constexpr double min_fan_angle = 240, min_column_angle = 60;
/// Largest angle between two columns of a fan, degrees: heights above the chord between them are 3 % lower.
/// [LayerRows.CornersHaveFansAndMerge]
inline constexpr double fan_step = 30;
/// Turn of the curve, degrees, from which neighbours of a concave corner lean towards its column.
/// [LayerRows.CornersHaveFansAndMerge]
inline constexpr double min_lean_angle = 20;
/// Length on the curve, in heights of all rows at the corner's column, over which columns lean. The tops of columns are
/// then half as far apart as their ends on the curve. [LayerRows.CornersHaveFansAndMerge]
inline constexpr double lean_reach = 2;
/// Share of its height over its own curve that a vertex may be near to another edge with layers: beyond the bisector, rows
/// would cross. [LayerRows.RowsThatMeetEnd]
inline constexpr double min_clearance = 0.85;
/// Share of the height of the last row that the rows keep from edges without layers. [LayerRows.RowsThatMeetEnd]
inline constexpr double wall_clearance = 0.5;
/// Share of the edge below that the upper edge of a cell keeps. [LayerRows.RowsThatMeetEnd]
inline constexpr double min_narrowing = 0.2;

}  // namespace carreau::thresholds::layers
