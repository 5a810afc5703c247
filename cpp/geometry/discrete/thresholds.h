// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room: what they are, in which unit, why, and what supports them.
#pragma once

namespace carreau::discrete::thresholds {

// Mending (triangulation)
/// Share of the longest side. A triangle with a smaller height is flat: its normal is rounding.
inline constexpr double flat_height = 1e-12;

// Sharp lines
/// Degrees: a line does not go on over an edge that is flatter (HDR sec. 4.9.1 has none; rounding and noise are).
inline constexpr double least_angle = 5;
/// Share of the largest angle at the end of a line that a candidate has at least.
inline constexpr double share_of_largest = 0.5;
/// Cosine of the turn of a line that goes on: it does not turn back.
inline constexpr double least_straightness = 0.5;
/// Edges by which a line is prolonged at most, as a multiple of those that it has: what needs more is not that line.
inline constexpr int most_prolongation = 2;
/// Edges of lines that hang together and have a free end, and of a line that fades out after all: fewer are noise. The
/// paper's one edge lets bunny.off have lines; a crease of a part that no other one meets is longer.
inline constexpr int least_edges = 8, least_faded = 8;

// Normals and tangents
/// Sine of the angle between the normal of a triangle and that of its vertex: a triangle that leans
/// less (5 degrees) does not turn the normal.
inline constexpr double clear_turn = 0.087;
/// Share. A mean of normals by areas replaces one by angles if it lifts edges by less than this share: at plane faces
/// beside roundings it does, in noise it does not.
inline constexpr double lower_lift = 0.5;
/// Sine of the angle between the normals beside a line: below, their cross product is no tangent of it.
inline constexpr double clear_crease = 0.3;
/// Sine of the angle between the two lines that bound a region at a corner: below, they span no plane.
inline constexpr double clear_corner = 0.17;
/// Cosine: the plane that two lines span at a corner is that of the region when its normal is no farther from the mean
/// one.
inline constexpr double same_side = 0.7;
/// Denominators of the normals' product in eq. 4.98 and normals of no length.
inline constexpr double tiny = 1e-12;

}  // namespace carreau::discrete::thresholds
