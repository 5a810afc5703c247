// SPDX-License-Identifier: BSD-3-Clause
// Gradation of an isotropic size field over a composite surface (Borouchaki, Hecht and Frey; HDR sec. 1.1.2).
#pragma once

#include <array>
#include <vector>

#include "model/isometry.h"
#include "support/monitor.h"
#include "support/vec.h"

namespace carreau {

/// Triangles of all faces, joined where faces share a vertex. A vertex has one place for each time that a face holds it
/// (twice along a seam). The tangent planes on both sides of a crease differ, and so do the two sides of a Klein
/// bottle.
struct GradationGraph {
  struct Place {
    int vertex = 0;  ///< index in `xyz`
    Vec3 normal;     ///< unit normal of the face, either side
  };
  std::vector<Vec3> xyz;
  std::vector<Place> places;
  std::vector<std::array<int, 3>> triangles;  ///< three indices in `places`, any orientation
  std::vector<std::array<int, 2>> joined = {};  ///< vertices that are one although their places differ
  std::vector<Isometry> joined_by = {};  ///< for each of these: the map of the first one's surroundings onto the second one's
  std::vector<std::array<int, 2>> segments;  ///< vertices joined by a curve, for curves without triangles; may be empty
};

/// The path of a size to a place: h = source_h + slope |line|.
struct GradationFront {
  double source_h = 0;
  Vec3 line;  ///< from the source, in the tangent plane of the place; zero where the size is the vertex's own
};

/// All that the grading knows.
struct GradationFronts {
  std::vector<double> h;              ///< of vertices; +infinity where no size arrives
  std::vector<GradationFront> front;  ///< of places
  /// For each vertex, the vertex that its size comes from; -1: no vertex.
  std::vector<int> source;
};

/// ln(beta), the largest derivative of h along a path on the surface, for a ratio beta between sizes one unit edge
/// apart. With the linear law, the unit length between sizes p and q at distance d is d ln(q / p) / (q - p) (RR-2818
/// sec. 5.2). So (q / p)^(1 / length) <= beta means q - p <= ln(beta) d. This is the h-correction h(Q) = h(P) (1 +
/// ln(beta) length_P(PQ)) of Borouchaki, Hecht and Frey.
double slope_of_gradation(double beta);

/// The size at a place by the sizes along a segment from a to b: the least size(p) + slope |place - p| over its points
/// p. Sizes are linear along it. `edge`: from a to b; `d`: from a to the place. +infinity where a and b are one.
double size_from_segment(double h_a, double h_b, const Vec3& edge, const Vec3& d, double slope) noexcept;

namespace detail {
/// Throws InvalidArgument unless it is positive and finite.
void check_slope(double slope);
}  // namespace detail

/// A size known beside a place: h = source_h + slope |line| there.
struct GradationSource {
  int place = 0;  ///< index in GradationGraph::places
  GradationFront front;
};

/// The largest field below `h` (one a vertex, +infinity: unknown) whose derivative along the surface is at most
/// `slope`. It is h(x) = min over y of h(y) + slope * distance(x, y). Also returns the line that brings the size to
/// each place. Between vertices the size is the smallest of source_h + slope |line + step| over the places around
/// (GradedField). `sources`: sizes known elsewhere than at vertices, seen from the places around. Distances are lengths
/// of straight lines on the unfolded triangles. They are right within about 2 % on triangles that are not far from
/// equilateral and turn by less than 30 degrees. Throws InvalidArgument unless slope > 0 and the arrays fit.
GradationFronts grade_fronts(const GradationGraph& graph, const std::vector<double>& h,
                             const std::vector<GradationSource>& sources, double slope, Monitor& monitor);

}  // namespace carreau
