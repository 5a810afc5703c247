// SPDX-License-Identifier: BSD-3-Clause
// The thresholds of the plane mesher in one table: value, unit, reason and evidence (README, "Thresholds").
#pragma once

#include <cstddef>
#include <cstdint>

namespace carreau::plane {

// Numbers (kernel/triangulation)
/// Triangles. Limit of one piece: a side has four times its triangle's number and more, in 32 bits; improvements add a
/// few. [Placement.IsBoundByNumbersOf32Bits]
inline constexpr std::int64_t max_triangles_of_a_piece = 500'000'000;
static_assert(4 * (max_triangles_of_a_piece + max_triangles_of_a_piece / 16) < INT32_MAX);

// Bends of the field (kernel/frame, kernel/shapes)
/// Bend a unit. From here on a chart replaces the tensor. Tensors are still accurate enough if a size grows by a tenth,
/// or if directions turn so that an edge's sagitta is a tenth of a unit. [0.5: worst of swirl 0.79 to 0.72]
inline constexpr double min_bend = 0.4;
/// Bend a unit. Beyond, charts are of no use. The plane keeps 1 - bend / (2 sqrt(3)) of the area of a unit triangle
/// whose height in the chart is along the bend; here this is little more than a quarter. [3.1: worst of swirl at 51 : 1
/// 0.36 to 0.24]
inline constexpr double max_bend = 2.5;
/// Squared units. Longer edges of bent triangles are known to be too long. [2.4 and 3.8: lengths in range of swirl at
/// 51 : 1 +- 0.5 %]
inline constexpr double longest_bent2 = 3;
/// Share. In a field that bends, straight triangles have less area than their lengths imply; this share is sufficient.
/// [0.4 and 0.6: worst of swirl at 51 : 1 0.36 to 0.30]
inline constexpr double straight_area = 0.5;

// Kinds of fields (kernel/shapes)
/// Ratio of determinants over a triangle. 7 % of the size: sizes count as graded. [1.04: longest edges of
/// paraboloid and torus 1.3 to 1.4]
inline constexpr double graded_change = 1.3;
/// Ratio of determinants. 40 % of the size. A few triangles of a field of slope 0.26 change as much before they are
/// smoothed; at jumps more of them do. [3.2: a field of slope 0.26 counts as rough, degrees of six 90 to 82 %]
inline constexpr double rough_change = 4;
/// Share of the triangles. [Graded in quality_test]
inline constexpr double graded_share = 0.15;
/// Share of the triangles. [Graded in quality_test]
inline constexpr double rough_share = 0.02;
/// Triangles. Looked at. [500: the sample misleads on a field of slope 0.26 (algebraic), degrees of six 83 to 69 %]
inline constexpr std::size_t classified_sample = 1000;
/// Triangles. In smaller meshes the border decides: they count as rough. [8000: worst of square 0.87 to 0.80]
inline constexpr std::size_t fewest_for_lattice = 4000;

// Kernel (kernel/cavity, triangulation, metric_delaunay, domain_reader)
/// Squared units. Within this distance the metric or chart of the new point replaces the others; a chart's error grows
/// with its cube. [7 and 11: longest edges on turning fields 2.5 to 2.0, equal Q2 of smooth ones]
inline constexpr double near2 = 9;

// Distances of new points (placement)
/// Units. Circumradius of a triangle that is small enough (equilateral: 0.577). [0.56: 20 % fewer triangles than
/// expected; 0.87: length 1.05 with few triangles]
inline constexpr double small_radius = 0.70;
/// Units. Circumradius that requires one more point. [0.70: 20 % more triangles where sizes are rough; 1.09: 25 %
/// fewer]
inline constexpr double large_radius = 0.87;
/// Units. Least distance of a point of a layer to other vertices. [0.60: lengths in range on turning fields 82 to 76 %;
/// 0.94: 12 % fewer triangles than expected]
inline constexpr double layer_distance = 0.75;
/// Units. Least distance of circumcentres, of points on edges in algebraic placement, of vertices of a lattice, and to a degenerate edge as
/// a whole. [0.56: 5 % more triangles in algebraic meshes, length 0.97; 0.87: 23 % fewer, 1.13; AnyCase, coarse poles]
inline constexpr double point_distance = 0.7;
/// Units. Least distance of circumcentres in a second pass. [0.48: lengths in range of turning fields 85 to 81 %; 0.75:
/// 6 % fewer triangles]
inline constexpr double last_distance = 0.6;
/// Units. Distance of points on long edges of bent triangles, which join distant places: crowded points are removed in
/// the end, but edges that cannot be swapped would stay. [0.2 and 0.3: worst of swirl at 51 : 1 0.36 to 0.34 and 0.33]
inline constexpr double bent_edge_distance = 0.25;
/// Units. Distance of a seed: never reached in a triangle that is small enough, nor in one that circumcentre insertion
/// leaves. [UndersampledRegions.AreMeshed]
inline constexpr double seed_distance = 1;
/// Lengths of the edge, at most of one. Least height over an imposed edge. [0.5: lengths 0.93 to 0.99, but degrees
/// of six 64 to 53 % on rings]
inline constexpr double imposed_height = 0.40;

// Advancing front (placement/advancing_front, respacing)
/// Squared units. Over a long base the apex keeps at least this height. [0.24: longest edge of swirl at 51 : 1 2.4
/// to 2.6; 0.38: of sizes 1.7 to 1.9]
inline constexpr double min_apex_height2 = 0.3;
/// Rounds. Apex and centroid of its triangle, each by the other. [1: degrees of six on swirl 92.6 to 91.8 %; 4: as
/// 2]
inline constexpr int chart_rounds = 2;
/// Points. Stride of the first points of a layer to insert. [32: longest edge of paraboloid 1.31 to 1.42; 128:
/// of stretched 1.30 to 1.44]
inline constexpr int first_stride = 64;
/// Units. Candidates nearer to each other become one. [0.44: 15 % fewer triangles on a coarse sphere, length 1.06;
/// 0.69: degrees of six on ellipses 100 to 67 %]
inline constexpr double merge_gap = 0.55;
/// Units. Gaps narrower than this, or wide, are no misfit to be summed up. [0.75: length on a coarse disc 1.06 to
/// 1.19]
inline constexpr double narrow_gap = 0.6;
/// Units. A corner to go round. [1.9: 9 % fewer triangles on a coarse sphere, length 1.03]
inline constexpr double wide_gap = 1.5;
/// Sixth parts of a turn. Added to the angle of a corner before it is cut to whole triangles. [0.3 and 0.5: lengths
/// in range on rings and a spiral - 1 %]
inline constexpr double corner_rounding = 0.4;
/// Intervals. Half of the intervals that share a surplus or a lack of points. [2: degrees of six on coarse discs 62 to
/// 51 %; 10: 2 % more triangles where sizes are rough]
inline constexpr int strain_window = 5;
/// Edges. Misfit that adds or removes a point, in small meshes [0.7 and 1.1: degrees of six on a coarse cone and
/// ellipses 87 to 62, 100 to 80 %]
inline constexpr double strain_limit_small = 0.9;
/// Edges. Misfit in large meshes, whose layers are long. [1.0 and 1.6: longest edge of torus 1.30 to 1.44, worst
/// 0.91 to 0.85]
inline constexpr double strain_limit_large = 1.3;
/// Triangles. Size from which the second limit applies, and charts: in coarser meshes of patches with poles and creases they reach too far.
/// [8000: longest edge of a paraboloid 1.31 to 1.37; 12 500: coarse swirl at 51 : 1 has 13 % more triangles, Q2 0.870 to 0.855]
inline constexpr double large_mesh = 10000;

// Circumcentres and points on edges (placement/circumcentres, algebraic)
/// Points. In one triangle, one after the other. [8: longest edge of rough sizes 1.75 to 1.99; 2: 2 % more
/// triangles]
inline constexpr int circumcentre_attempts = 4;
/// Units a share of missing triangles. 1 % more points for a radius less by 0.045, [Graded.EdgesAreOfUnitLength]
inline constexpr double radius_a_share = 4.5;
/// Units. Limit of the reduction: the radius stays above the one of many triangles of the front. [Graded.EdgesAreOfUnitLength]
inline constexpr double largest_reduction = 0.1;
/// Units. Edges about a larger radius become longer than 1.5. [0.04: length at slope 0.26 0.9925 to 0.9921]
inline constexpr double largest_rise = 0.05;
/// Share of the length. A long edge of a bent triangle is swapped for one so much shorter. [0.7 and 1.1: longest
/// edge of swirl at 51 : 1 2.4 to 2.6 and 2.8]
inline constexpr double shorter_edge = 0.9;

// Degenerate sides (placement/degenerate_sides)
/// Rays. 0.2 units apart round a pole, if all are equal. [16 and 66: no figure changes, only bits]
inline constexpr int rays = 33;
/// Units. Between rays at unit height; else there are more of them. [metrics that differ by direction at a pole]
inline constexpr double widest_ray_gap = 0.4;
/// Units. Between places on a ray. [0.04 and 0.06: no figure changes, only bits]
inline constexpr double ray_step = 0.05;
/// Steps. 1.5 units: a layer fits between the ring and the domain beyond it. [15: degrees of six on a coarse cone 87 to
/// 59 %]
inline constexpr std::size_t steps_of_room = 30;
/// Units. Below, no ring, and least distance of a ring point to other vertices. [MeshPlane.
/// SurroundsAnApexWithThreeTriangles, as the following]
inline constexpr double min_room = 0.5;
/// Heights. Width of the triangles of a wide fan, and least length of a lateral edge.
inline constexpr double narrowest_fan = 0.5;
/// Heights. Length of a lateral edge in the fan.
inline constexpr double longest_lateral = 1.6;

// Swaps (optimise/delaunay_swaps, degrees, degree_pairs)
/// Passes. Swaps can run in circles in a metric that varies. [5: shapes on turning fields, p1 0.39 to 0.38; 20: as
/// 10, but 6 of 42 meshes change]
inline constexpr int delaunay_passes = 10;
/// Share of the least eigenvalue. Metrics of corners that differ by no more are similar (settled.h). [by the proof
/// there; time only]
inline constexpr double alike_share = 0.2;
/// Squared units, and shortest edges of the triangle. Longer than any edge that points a unit apart leave.
/// [MeshPlane.LongStripsAreDelaunayInTheMetric, LongStripsOfOneLayerDoNotLean]
inline constexpr double long_edge2 = 9;
/// Passes. [1: degrees of six on a coarse disc 62 to 57 %; 4: as 2]
inline constexpr int degree_passes = 2;
/// Steps. Reach of a degree pair along its layer, [2: degrees of six 91.7 to 92.4 %, but longest edges 1.31 to 1.42]
inline constexpr int pair_reach_even = 1;
/// Steps. The reach in graded sizes, which have more pairs. [1: degrees of six at slope 0.26 90 to 88 %; 6: as 3]
inline constexpr int pair_reach_graded = 3;
/// Squared units. Mean over a vertex' edges below which it may go. [0.7: length at slope 0.26 0.990 to 0.986]
inline constexpr double dense_length2 = 0.9;
/// Squared units. Length of the remaining edges, [2.1: length at slope 0.26 0.990 to 0.982; 3.2: longest edges 1.45 to
/// 1.49]
inline constexpr double longest_thinned2 = 2.6;

// Smoothing (optimise/smoothing, optimise)
/// Area of a parallelogram in the metric after a move (ideal: 0.87); a smaller one undoes it. [0.16: lengths in range
/// on rough sizes 91.5 to 92.2 %; 0.25: longest edges on turning fields 2.5 to 2.2]
inline constexpr double min_area = 0.2;
/// Share. Weight of unit lengths in the aim, against equilateral triangles; [0.04 and 0.06: lengths in range on turning
/// fields - 0.3 %]
inline constexpr double pull_even = 0.05;
/// Share. Weight in graded sizes, whose lengths are less accurate. [0.08 and 0.12: longest edges at slope 0.26 1.45 to
/// 1.46 and 1.43, worst 0.81 to 0.82 and 0.80]
inline constexpr double pull_graded = 0.1;

// Bad triangles (optimise/bad_triangles, mending)
/// Q2 in the mean metric of the vertices. Worse ones are tested: these metrics are at hand. [0.68: shapes are
/// overlooked; 1: half as much time again, 6 of 42 meshes change]
inline constexpr double doubtful_quality = 0.85;
/// Q2. Below, shape goes before size: points are added over short edges. [0.56: more triangles than expected on turning
/// fields, lengths in range 85.4 to 84.7 %]
inline constexpr double refine_quality = 0.45;
/// Passes. [3: worst of algebraic sizes 0.81 to 0.68; 12: as 6, but 8: 1 of 42 meshes changes]
inline constexpr int mending_passes = 6;
/// Lengths of the edge. Height of a vertex over a short edge. [0.7 and 1.1: lengths in range on turning fields -
/// 0.3 %]
inline constexpr double over_short_edge = 0.9;
/// Squared units. Sizes that change much over a triangle leave shorter edges: an end goes. [0.42: more triangles on
/// coarse poles, degrees of six 87 to 69 %]
inline constexpr double crowded_length2 = 0.52;
/// Squared units. Length of the remaining edges, [2.6: length on a coarse disc 1.01 to 1.06]
inline constexpr double longest_uncrowded2 = 2.1;
/// Longest sides. Good triangles of metrics have the inverse of the metric's ratio, some ten thousand at most; points
/// on edges are on them up to rounding. [AnisotropicField.FieldsThatEdgesCannotFollowLeaveNoFlatTriangle]
inline constexpr double flat_height = 1e-7;

// Local search (optimise/local_search, search_zone, zone_moves)
/// Q2. Better triangles are left alone. [LocalSearch; 0.92: twice the time, and no worst one is raised]
inline constexpr double searched_quality = 0.88;
/// Shapes. Work is bounded by a multiple of the mesh, [time only, as the next three]
inline constexpr std::int64_t search_shapes = 16'000;
/// Shapes.
inline constexpr std::int64_t search_shapes_a_triangle = 48;
/// Shapes. The limit until the first success, and for each triangle: strips between fixed borders cannot be improved.
/// [an eighth of the limit: mambo_s34.step by direction changes]
inline constexpr std::int64_t first_search_shapes = 2'400, first_search_shapes_a_triangle = 4;
/// Share of the mean cost. Required gain of a change; twice as much for a round of moves that another follows. [0.8 to 1.25
/// times: no figure changes; ends the search]
inline constexpr double change_gain = 0.01;
/// Rounds. Most of these rounds. [as above]
inline constexpr int relaxing_rounds = 4;
/// Changes. Followed through. [2: one of 17 meshes changes for the better, one for the worse; 10: as 5]
inline constexpr std::size_t most_promising = 5;
/// Squared units. Length of edges that a change leaves, unless some were longer [3: longest edge of rough sizes 1.75 to
/// 1.97]
inline constexpr double longest_left2 = 2.4;
/// Squared units. Lower bound of the length, unless some were shorter before. [0.32: lengths in range of rough sizes
/// 91.5 to 91.1 %]
inline constexpr double shortest_left2 = 0.4;
/// Squared units. Length of an edge that is split. [0.9: 7 of 17 meshes change, degrees of six on ellipses 73 to 67 %]
inline constexpr double min_split2 = 1.1;
/// Q2. Shape of triangles that a collapse leaves, before moves. [0.1: none of 13 meshes changes; 0.15: 4 of 42 change]
inline constexpr double min_collapse_quality = 0.05;
/// Cost. The cost of a triangle of Q2 .97: vertices amid such triangles need not move. [time only]
inline constexpr double cheap_enough = 0.2;
/// Moves. At one distance. [1: p1 of ellipses 0.88 to 0.86; 6: as 3]
inline constexpr int turns_a_step = 3;
/// Squared chord of unit normals. A turn of the surface along an edge that leaves no flat spot: 20 degrees.
/// [MiddleRows in tests/cpp/surface/improve]
inline constexpr double min_turn2 = 0.12;

// Squares (placement/squares, placement/cross_field)
/// Squared height of a triangle of the boundary's triangulation over its longest edge, and squared length of an edge, units. If the
/// metric's Delaunay criterion swaps a longer edge of a lower triangle, a part of the domain is a strip, and the whole becomes
/// Delaunay in the metric first. Diagonals of unit squares are not longer.
/// [Quadrilaterals.ARibbonHasNoLongOnes, ALeaningRibbonHasNoLongOnes]
inline constexpr double sliver_height2 = 0.0625, leaning_edge2 = 2;
/// Lengths of the edge, at most of one. Least height over an imposed edge.
inline constexpr double square_height = 0.6;
/// Units. Circumradius that requires one more point (half a unit square: 0.707).
inline constexpr double large_square_radius = 1;
/// Length of the mean of the crosses of two imposed edges that meet. Below, the corner does not determine a direction.
inline constexpr double min_cross = 0.7;
/// Units. Edges of the mesh that carries crosses, away from the boundary: they are smooth there.
inline constexpr double background_size = 1.6;
/// Nodes of the coarsest level, and sweeps on the others.
inline constexpr std::size_t coarsest_crosses = 50;
inline constexpr int cross_sweeps = 6;
/// Change of unit crosses. Sweeps end when no cross moves farther in one: a thousandth of a degree.
inline constexpr double cross_at_rest = 1e-5;

// Division of large domains (division)
/// Triangles. Approximate size of a piece; smaller domains are not divided. From four pieces on separators have longer edges, since one
/// thread makes the coarse mesh. [90 000: a fifth more time on one thread at a million]
inline constexpr double triangles_a_piece = 250'000;
/// Units. Length of the edges of the coarse mesh, on which separators lie. [12: sphere has 1200 triangles fewer,
/// degrees of six 99.0 to 98.7 %]
inline constexpr double separator_length = 8;
/// Places of the first sector that are tried on a single loop, for four sectors and more. [1: square has separators 1.75
/// times as long]
inline constexpr int starts_of_sectors = 8;
/// Share of the length of separators that start with the loop. Separators that start elsewhere must be shorter than this
/// share. [1: degrees of six on a sphere of 290 000 triangles in pieces of 90 000 98.15 to 97.9 %]
inline constexpr double much_shorter = 0.75;
/// Radians. Turn of the boundary over one coarse edge.
inline constexpr double max_coarse_turn = 0.45;
/// Squared coarse units, and Q2. Separators do not pass along triangles that are worse.
inline constexpr double shortest_coarse2 = 0.16;
/// Coarse triangles between degenerate sides and separators.
inline constexpr int rings_at_degenerate_sides = 2;
/// Layers of vertices on each side of a separator, the separator included, whose points are placed again.
inline constexpr int refilled_layers = 3;
/// Layers of triangles beside a separator that are improved when pieces have been joined, [8: Q2 better by 1e-5] and
/// around places where several separators meet.
inline constexpr int zone_layers = 5, meeting_layers = 7;
/// Share of the triangles that lie in the zone. Domains with a larger share are not divided.
inline constexpr double max_of_zone = 0.3;

}  // namespace carreau::plane
