// SPDX-License-Identifier: BSD-3-Clause
// Numbers that decide something in this room.
// All of tests/cpp/atlas rests on them: annulus_test covers thousands of random loops.
#pragma once

namespace carreau::atlas::thresholds {

/// Share of both neighbouring intervals of angles over which a vertex of the inner border is rounded (Atlas
/// sec. 5.4.2). It is halved where the arc would leave the annulus.
inline constexpr double rounded_share = 1.0 / 3;

/// Change by radian of the outer border over the inner one, before it is rounded: the arc at the end of a steeper edge is a step. From 2 the
/// hook of fig. 5.28 is covered less than from inside.
inline constexpr double steepest_outer = 5;

/// Ratio of both sides of an arc: its radius is that of the farther end, so an arc that is much wider on one side is a
/// step on the other side. [BlendedSurface.IrregularSpheresAreAccepted]
inline constexpr double most_uneven_arc = 4;

/// A smooth outer border from which the inner one follows keeps this share of the room at joints, so that its edge there can be parallel to
/// the inner border.
inline constexpr double room_at_joints = 0.9;

/// An outer border comes no nearer to a pivot outside than this share of the inner border's distance. Otherwise angles
/// lose their meaning there, and derivatives grow as the inverse of the distance.
inline constexpr double nearest_to_pivot = 0.15;

/// If a ray meets the inner border again, or the polyline of pivots, the annulus keeps this share of the way. The other
/// side keeps an equal share.
inline constexpr double shared_gap = 0.45;

/// Pivots outside slide this share of the way towards the loop where a condition fails, so many times; then other
/// pivots are taken. Hardly any random polygon needs more than six.
inline constexpr double slide = 0.6;
inline constexpr int slides = 12;

/// Sine of the angle between an edge and the ray to it: below, distances along the ray are too inaccurate. This rejects
/// pivots that are barycentres of slivers.
inline constexpr double min_slope = 1e-5;

/// Logarithm of the change of width over which the outer border gets one knot more, and how many at most in a piece.
/// Covers a tenth more of random annuli than the knots of the polygons alone.
inline constexpr double change_of_width = 0.2;
inline constexpr int divisions = 8;

/// Change of b by radian: above, it is a step in which charts of an atlas fold. The value 2 removes two thirds of the
/// folds of joint.off. The value 1 covers at most .63 of random annuli in place of .64, and .09 of the worst in place
/// of .13.
inline constexpr double steepest_ratio = 2;

}  // namespace carreau::atlas::thresholds
