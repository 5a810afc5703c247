// The thresholds of the plane mesher in one table: value, unit, reason, and what supports it (README, "Thresholds").
#pragma once

#include <cstddef>
#include <cstdint>

namespace carreau::plane {

// Bends of the field (kernel/frame, kernel/shapes)
/// Bend a unit. From here on a chart takes the place of the tensor: a size that grows by a tenth, or directions
/// that turn so that an edge's sagitta is a tenth of a unit, are still well served by means of tensors.
inline constexpr double least_bend = 0.4;
/// Bend a unit. Beyond, charts are of no use: of a unit triangle in a chart the plane keeps 1 - bend / (2 sqrt(3))
/// of its area where its height is along the bend, which here is little more than a quarter.
inline constexpr double most_bend = 2.5;
/// Triangles. In coarser meshes of patches with poles and creases charts reach too far.
inline constexpr double fewest_for_charts = 10'000;
/// Share of a length. What a chart tells of distances and what tensors halfway tell; else the field has a kink
/// there.
inline constexpr double chart_tolerance = 0.1;
/// Squared units. Longer edges of bent triangles are taken for what they are: too long.
inline constexpr double longest_bent2 = 3;
/// Share. Where the field bends, straight triangles have less area than their lengths say; so much of it is well
/// enough.
inline constexpr double straight_area = 0.5;
/// Q2. Of worse bent triangles the lengths are integrated: the tensor halfway says little of long edges that leave
/// a thin layer and come back.
inline constexpr double integrated_quality = 0.7;

// Kinds of fields (kernel/shapes)
/// Ratio of determinants over a triangle. 7 % of the size: sizes count as graded.
inline constexpr double graded_change = 1.3;
/// Ratio of determinants. 40 % of the size. A few triangles of a field of slope 0.26 change as much before they are
/// smoothed; where it jumps more of them do.
inline constexpr double rough_change = 4;
/// Share of the triangles.
inline constexpr double graded_share = 0.15;
/// Share of the triangles.
inline constexpr double rough_share = 0.02;
/// Triangles. Looked at.
inline constexpr std::size_t classified_sample = 1000;
/// Triangles. In smaller meshes the border decides: they count as rough.
inline constexpr std::size_t fewest_for_lattice = 4000;

// Kernel (kernel/cavity, triangulation, metric_delaunay, domain_reader)
/// Squared units. Within this distance the metric or chart of the new point speaks for the others; a chart errs by
/// the cube of it.
inline constexpr double near2 = 9;
/// Share. Nearly cocircular points are left as they are: rounding must not dig.
inline constexpr double cavity_tolerance = 1e-12;
/// Share. Nearly cocircular vertices keep their diagonal, so that swaps cannot run in circles.
inline constexpr double swap_tolerance = 1e-9;
/// Triangles. Of a walk, after which it turns at random: in a triangulation that is not Delaunay a fixed order
/// could go round in circles.
inline constexpr std::size_t fixed_order_steps = 40;
/// Triangles. Larger meshes do not fit in the cache and are sorted once.
inline constexpr std::size_t renumbered_from = 200'000;
/// Power of 2. Of the domain's box: below, coordinates inside would lose their last bits to underflow.
inline constexpr int least_exponent = -900;
/// Power of 2. Above, the box overflows.
inline constexpr int largest_exponent = 1020;

// Stops (all): work between two looks at the monitor, well within a tenth of a second
/// Triangles or vertices. A few operations each.
inline constexpr int steps_between_checks = 1 << 16;
/// Points or swaps.
inline constexpr int insertions_between_checks = 4096;
/// Shapes.
inline constexpr int shapes_between_checks = 1 << 15;
/// Edges.
inline constexpr int integrals_between_checks = 256;

// Distances of new points (placement)
/// Units. Circumradius of a triangle that is small enough (equilateral: 0.577).
inline constexpr double small_radius = 0.70;
/// Units. Circumradius that asks for one more point.
inline constexpr double large_radius = 0.87;
/// Units. Least distance of a point of a layer to other vertices.
inline constexpr double layer_distance = 0.75;
/// Units. The same of circumcentres,
inline constexpr double circumcentre_distance = 0.7;
/// Units. of those of a second pass,
inline constexpr double last_distance = 0.6;
/// Units. and of points on edges (algebraic placement).
inline constexpr double edge_distance = 0.7;
/// Units. Of points on long edges of bent triangles, which join what is far apart: crowded ones are removed in the
/// end, but edges that cannot be swapped would stay.
inline constexpr double bent_edge_distance = 0.25;
/// Units. Of a seed: never wanted in a triangle that is small enough, nor in one that circumcentre insertion
/// leaves.
inline constexpr double seed_distance = 1;
/// Lengths of the edge, at most of one. Least height over an imposed edge.
inline constexpr double imposed_height = 0.40;
/// Units. Least distance to a degenerate edge as a whole.
inline constexpr double degenerate_height = 0.70;

// Advancing front (placement/advancing_front, respacing)
/// Squared units. Over a long base the apex keeps at least this height.
inline constexpr double least_apex_height2 = 0.3;
/// Rounds. Apex and centroid of its triangle, each by the other.
inline constexpr int chart_rounds = 2;
/// Points. Of a layer that go in first, far from each other.
inline constexpr int first_stride = 64;
/// Units. Candidates nearer to each other become one.
inline constexpr double merge_gap = 0.55;
/// Units. Gaps narrower than this, or wide, are no misfit to be summed up.
inline constexpr double narrow_gap = 0.6;
/// Units. A corner to go round.
inline constexpr double wide_gap = 1.5;
/// Sixth parts of a turn. Added to the angle of a corner before it is cut to whole triangles.
inline constexpr double corner_rounding = 0.4;
/// Intervals. Half of those that share a point more or less.
inline constexpr int strain_window = 5;
/// Edges. Misfit that makes a point more or less, in small meshes
inline constexpr double strain_limit_small = 0.9;
/// Edges. and in large ones, whose layers are long.
inline constexpr double strain_limit_large = 1.3;
/// Triangles. Where the second takes over.
inline constexpr double large_mesh = 10000;

// Circumcentres and points on edges (placement/circumcentres, algebraic)
/// Points. In one triangle, one after the other.
inline constexpr int circumcentre_attempts = 4;
/// Units a share of missing triangles. 1 % of points more where the radius is less by 0.045,
inline constexpr double radius_a_share = 4.5;
/// Units. but never as small as that of many triangles that the front makes.
inline constexpr double largest_reduction = 0.1;
/// Units. Edges about a larger radius become longer than 1.5.
inline constexpr double largest_rise = 0.05;
/// Share of the length. A long edge of a bent triangle is swapped for one so much shorter.
inline constexpr double shorter_edge = 0.9;
/// Points. On one edge in one pass; the next passes see to the rest.
inline constexpr int most_pieces = 4096;

// Degenerate sides (placement/degenerate_sides)
/// Rays. 0.2 units apart round a pole, if all are alike.
inline constexpr int rays = 33;
/// Units. Between rays at unit height; else there are more of them,
inline constexpr double widest_ray_gap = 0.4;
/// Rays. up to these.
inline constexpr std::size_t most_rays = 512;
/// Units. Between places on a ray.
inline constexpr double ray_step = 0.05;
/// Steps. 1.5 units: a layer fits between the ring and what is beyond it.
inline constexpr std::size_t steps_of_room = 30;
/// Units. Below, no ring.
inline constexpr double least_room = 0.5;
/// Heights. Width of the triangles of a wide fan.
inline constexpr double narrowest_fan = 0.5;
/// Units. Least distance of a ring point to other vertices.
inline constexpr double ring_distance = 0.5;
/// Heights. Of a lateral edge that takes part in the fan.
inline constexpr double longest_lateral = 1.6;
/// Heights.
inline constexpr double shortest_lateral = 0.5;

// Swaps (optimise/delaunay_swaps, degrees, degree_pairs)
/// Passes. Swaps can run in circles in a metric that varies.
inline constexpr int delaunay_passes = 10;
/// Squared units, and shortest edges of the triangle. Longer than any edge that points a unit apart leave.
inline constexpr double long_edge2 = 9;
/// Passes.
inline constexpr int degree_passes = 2;
/// Q2. A swap for the sake of degrees leaves no triangle worse than this.
inline constexpr double degree_swap_quality = 0.6;
/// Q2. A layer that is shifted by one edge leaves triangles of 0.6 until vertices move; none may be much worse.
inline constexpr double shifted_quality = 0.5;
/// Steps. Of a degree pair along its layer,
inline constexpr int pair_reach_even = 1;
/// Steps. and where sizes are graded: more pairs are there.
inline constexpr int pair_reach_graded = 3;
/// Squared units. Mean over a vertex' edges below which it may go.
inline constexpr double dense_length2 = 0.9;
/// Squared units. Of the edges that are left then,
inline constexpr double longest_thinned2 = 2.6;
/// Q2. and for the worst triangle, before smoothing.
inline constexpr double thinned_quality = 0.45;

// Smoothing (optimise/smoothing, optimise)
/// Of a parallelogram in the metric (ideal: 0.87). After a move; else it is taken back.
inline constexpr double least_area = 0.2;
/// Rounds. Then all moves of the pass are taken back.
inline constexpr int undo_rounds = 20;
/// Share. Of unit lengths in the aim, the rest being equilateral triangles;
inline constexpr double pull_even = 0.05;
/// Share. where sizes are graded, whose lengths are farther off.
inline constexpr double pull_graded = 0.1;
/// Root of the determinant over the trace. Of what is kept of metrics in single precision.
inline constexpr double most_stretched = 1e-15;
/// Root of the determinant. The same.
inline constexpr double least_root = 1e-30;

// Bad triangles (optimise/bad_triangles, mending)
/// Q2. Worse triangles are mended.
inline constexpr double bad_quality = 0.8;
/// Q2 in the mean metric of the vertices. Worse ones are looked at: those metrics are at hand.
inline constexpr double doubtful_quality = 0.85;
/// Q2. Below, shape goes before size: points are added over short edges.
inline constexpr double refine_quality = 0.45;
/// Passes.
inline constexpr int mending_passes = 6;
/// Q2, or share of the penalty. What a change must gain.
inline constexpr double mending_gain = 1e-3;
/// Lengths of the edge. Height of a vertex over a short edge.
inline constexpr double over_short_edge = 0.9;
/// Squared units. Of an edge that a removal leaves; longer ones may be halved.
inline constexpr double longest_after_removal2 = 2.0;
/// Squared units. Sizes that change much over a triangle leave shorter edges: an end goes.
inline constexpr double crowded_length2 = 0.52;
/// Squared units. Of the edges that are left then,
inline constexpr double longest_uncrowded2 = 2.1;
/// Q2. and of the worst triangle.
inline constexpr double uncrowded_quality = 0.6;
/// Shapes. Work is bounded by a multiple of the mesh: a boundary without any relation to the sizes leaves nothing
/// but bad triangles. It is counted by shapes, since a fine boundary far from all other vertices gives stars of
/// thousands; this least is a few tenths of a second,
inline constexpr std::int64_t mending_shapes = 4'000'000;
/// Shapes.
inline constexpr std::int64_t mending_shapes_a_triangle = 24;
/// Longest sides. Good triangles of metrics have the inverse of the metric's ratio, of some ten thousand at most;
/// points put on edges are on them but for rounding.
inline constexpr double flat_height = 1e-7;

// Local search (optimise/local_search, search_zone, zone_moves)
/// Q2. Better triangles are left alone.
inline constexpr double searched_quality = 0.88;
/// Passes.
inline constexpr int search_passes = 8;
/// Shapes. Work is bounded by a multiple of the mesh,
inline constexpr std::int64_t search_shapes = 16'000;
/// Shapes.
inline constexpr std::int64_t search_shapes_a_triangle = 48;
/// Shapes. and where nothing helps, strips between fixed borders, there is an end sooner:
inline constexpr std::int64_t first_search_shapes = 2'400;
/// Shapes.
inline constexpr std::int64_t first_search_shapes_a_triangle = 4;
/// Shapes. each success allows for more.
inline constexpr std::int64_t search_shapes_a_success = 12'000;
/// Share of the mean cost. What a change must gain,
inline constexpr double change_gain = 0.01;
/// Share of the mean cost. and a round of moves after it, to be followed by another one,
inline constexpr double round_gain = 0.02;
/// Rounds. up to these.
inline constexpr int relaxing_rounds = 4;
/// Changes. Followed through.
inline constexpr std::size_t most_promising = 5;
/// Squared units. Of edges that a change leaves, unless some were longer
inline constexpr double longest_left2 = 2.4;
/// Squared units. or shorter before.
inline constexpr double shortest_left2 = 0.4;
/// Squared units. Of an edge that is split.
inline constexpr double least_split2 = 1.1;
/// Q2. Of triangles that a collapse leaves, before moves.
inline constexpr double least_collapse_quality = 0.05;
/// Cost. That of a triangle of Q2 .97: vertices amid such ones need not move.
inline constexpr double cheap_enough = 0.2;
/// Moves. At one distance.
inline constexpr int turns_a_step = 3;
/// Squared chord of unit normals. A turn of the surface along an edge that leaves no flat spot: 20 degrees.
inline constexpr double least_turn2 = 0.12;
/// Share. What is better by less is no better: where meshes are symmetric, the last bits of a host's numbers would
/// decide.
inline constexpr double tie = 1e-6;

}  // namespace carreau::plane
