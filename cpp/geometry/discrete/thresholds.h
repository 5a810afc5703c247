// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room, with their meaning, unit, reason and support.
// All of tests/cpp/geometry/discrete rests on them: triangulation_test (sharp lines), discrete_surface_test (normals and patches).
#pragma once

namespace carreau::discrete::thresholds {

// Sharp angle
/// Degrees: if the angles of edges have no gap, sharper ones are features (HDR sec. 4.9.1; scans have no gap).
inline constexpr double usual_sharp = 45;
/// Degrees: flatter edges are no features, wherever the gap is. Tessellations of CAD programs turn by up to 12 (.2 rad)
/// with usual settings; smaller kinks move a surface little.
inline constexpr double min_sharp = 20;
/// Degrees: the width of a gap.
inline constexpr double gap_width = 5;
/// Degrees: sharper edges are features even where the surface turns on beside them. Circles of 8 edges are flatter, with
/// room for rounding.
inline constexpr double max_round = 46;
/// Neighbours of an edge of a tessellated surface turn by at least, and at most, this share of its angle: by the half
/// where a fillet begins. Beside a chamfer of 45 degrees a right angle is too sharp.
inline constexpr double min_turn = 0.4, max_turn = 1.6;
/// Ratio of the widths of two neighbouring facets of a tessellated surface, at most: beside a chamfer it is larger.
inline constexpr double round_widths = 2;
/// Degrees: triangles of a facet differ by no more.
inline constexpr double flat_bend = 0.5;
/// Sides of a facet that may turn on. A strip of a tessellated surface has two to six, and more where it was refined.
/// A facet with more is a plane face of a part.
inline constexpr int max_sides_of_facet = 64;
/// Degrees, and sides: beside sharper edges a facet with more sides is a plane face, around a chamfer or a countersink.
inline constexpr double chamfer_angle = 35;
inline constexpr int max_sides_beside_chamfer = 8;

// Sharp lines
/// Degrees: a line does not go on over an edge that is flatter (HDR sec. 4.9.1 has none; rounding and noise are).
inline constexpr double min_angle = 5;
/// Share of the largest angle at the end of a line that a candidate has at least.
inline constexpr double share_of_largest = 0.5;
/// Edges by which a line is prolonged at most, as a multiple of its own edges: a longer gap separates two lines.
inline constexpr int max_prolongation = 2;
/// Connected edges of lines with a free end, and edges of a line that fades out: fewer are noise. With the paper's
/// limit of one edge, bunny.off has lines; a crease of a part without junctions is longer.
inline constexpr int min_edges = 8;

// Normals and tangents
/// Sine of the angle between the normals of a triangle and of its vertex: a triangle that leans less (5 degrees) does
/// not turn the normal.
inline constexpr double clear_turn = 0.087;
/// Share. A mean of normals by areas replaces a mean by angles if it lifts edges by less than this share. It does at
/// plane faces beside roundings, and not in noise.
inline constexpr double lower_lift = 0.5;
/// Times the largest bulge of the borders of a patch: no inner point is farther from its place in the flat triangle. On
/// bunny.off it is 2.2 at the 99th percentile, on spot.obj 2 at most; on needles it is up to the ratio of sides.
inline constexpr double max_inner_bulge = 3;
/// Heights of the triangle: no inner point of a patch is shifted farther along the triangle. Inner points lie a quarter of the height away
/// from the sides.
inline constexpr double max_inner_shift = 0.25;
/// Sine of the angle between the normals beside a line: below, their cross product is no tangent of it.
inline constexpr double clear_crease = 0.3;
/// Sine of the angle between the two lines that bound a region at a corner: below, they span no plane.
inline constexpr double clear_corner = 0.17;

}  // namespace carreau::discrete::thresholds
