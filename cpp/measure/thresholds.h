// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room: what they are, in which unit, why, and what supports them.
#pragma once

#include <numbers>

namespace carreau::thresholds::measure {

// In brackets: the tests that rest on it, all of tests/cpp/measure.

/// Unit edges. Gradations are judged over no less: over a hundredth of a unit sizes that differ by a tenth, which
/// nobody could see, would have one of 14 000. [DeliveredPlane.GradationOfTinyEdgesIsThatOfATenthOfAUnit]
inline constexpr double shortest_way = 0.1;
/// Unit edges. Trapezoids of a length in a control space are no longer. [DeliveredPlane.QuadratureHasItsOrder]
inline constexpr double fine_length = 0.1;
/// Share of a limit. What exceeds it by less meets it: rounding; [DeliveredPlane.UniformLengthsAreExact]
inline constexpr double limit_rounding = 1e-9;
/// Share of a limit. of gradations, which are measured by trapezoids.
/// [DeliveredPlane.GradationsBetweenTwoCurvesAreForced]
inline constexpr double gradation_tolerance = 0.02;
/// Unit edges. Lengths in range are between these (HDR eq. 2.14). [DeliveredPlane.UniformLengthsAreExact]
inline constexpr double short_limit = std::numbers::sqrt2 / 2, long_limit = std::numbers::sqrt2;

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
/// Shares of the tolerances: bounds that exceed what is seen by less are near enough. [DeviationBounds.NarrowBumpIsFound]
inline constexpr double near_deviation = 1e-3, near_angle = 1e-2;
/// Times that a part of a triangle is cut into four, and parts of a triangle that are: bounds stay what they are then.
inline constexpr int most_cuts = 10, most_parts = 150;
/// Share of the largest |Su x Sv| of a triangle: where it is less the surface is singular.
inline constexpr double singular_normal = 1e-9;
/// Triangles at work at a time.
inline constexpr std::size_t triangles_at_once = 32768;
/// Share of the longest side: what lies so little beyond a side is rounding.
inline constexpr double beyond_side = 1e-12;

}  // namespace carreau::thresholds::measure
