// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room: what they are, in which unit, why, and what supports them.
#pragma once

#include <cstddef>

namespace carreau::thresholds::bounds {

// In brackets: the tests that rest on it, all of tests/cpp/measure.

/// Share of the way from a corner to the place. Feet are as near to those of the place along the surface: a distance that is a hundredth of the way
/// is right to a part in 20 000. [FreeElements.WhatIsDeliveredIsOfTheElements]
inline constexpr double near_foot = 1e-4;

// Bounds of A0 and A1 (triangle_bound, deviation_bounds)
/// What bounds assume: over a part of a triangle second derivatives along its sides differ from a constant by at most so many times the largest second
/// difference seen. Heights of parts count a sixteenth of those of the triangle, so once costs a tenth. [TriangleBound.SphereInClosedForm]
inline constexpr double variation = 1;
/// Part of what a triangle bends by which its quarters bend at least: that a difference vanishes says little of derivatives.
inline constexpr double least_of_parent = 0.5;
/// Share of the largest deviation seen by which a bound may exceed it before the triangle is cut: one of a sphere exceeds it by less.
inline constexpr double bound_gap = 0.2;
/// The same where the bound is beyond the tolerance: whether that is so is to be seen.
inline constexpr double bound_gap_beyond = 0.05;
/// The same where what is seen is not beyond it, and only the bound is.
inline constexpr double bound_gap_undecided = 0.005;
/// Shares of the tolerances: bounds that exceed what is seen by less are near enough. [DeviationBounds.NarrowBumpIsFound]
inline constexpr double near_deviation = 1e-3, near_angle = 1e-2;
/// Times that a part of a triangle is cut into four, and parts of a triangle that are: bounds stay what they are then.
inline constexpr int most_cuts = 10, most_parts = 150;
/// Parts of a triangle of which it is known that it is beyond a tolerance, where that is all that is asked.
inline constexpr int most_parts_beyond = 16;
/// Ratio of these to the parts that are cut where an edit is only tried. [time only]
inline constexpr int roughly_parts = 4;
/// Share of the largest |Su x Sv| of a triangle: where it is less the surface is singular.
inline constexpr double singular_normal = 1e-9;
/// Share of the longest side: what lies so little beyond a side is rounding.
inline constexpr double beyond_side = 1e-12;

}  // namespace carreau::thresholds::bounds
