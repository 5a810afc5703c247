// SPDX-License-Identifier: BSD-3-Clause
// The recipe that makes quadrilaterals of triangles (HDR sec. 3.3.4), for PlaneQuads (one face) and SpaceQuads (several faces).
#pragma once

#include <functional>
#include <span>

#include "support/monitor.h"
#include "surface/options.h"
#include "surface/elements/quads/quad_shape.h"

namespace carreau {

/// Returns whether an edge between two vertices is an edge of a curve.
using ImposedEdges = std::function<bool(std::int32_t, std::int32_t)>;

/// The conditions on pairs of triangles, beside strict convexity.
struct PairRules {
  ImposedEdges is_imposed;
  /// The place in space of a corner of a triangle.
  std::function<Vec3(std::int32_t)> position;
  double max_turn = 0.3;  ///< radians: largest angle between the normals of the two, in space
  double least_jacobian = 0;  ///< of the quadrilateral in space: a candidate must exceed it
};

/// `isotropic`: the sizes are; else good quadrilaterals may have any angles in space.
PairRules pair_rules(const CompositeOptions& options, bool isotropic, ImposedEdges is_imposed, std::function<Vec3(std::int32_t)> position);

/// Joins triangles, where there are no other cells, by a matching of large weight. Quality is measured in the metric; without a metric,
/// in space.
template <typename Quads>
void pair_triangles(Quads& quads, const PairRules& rules, Monitor& monitor);

/// Turns the third side of each triangle that has a flat corner (QuadPatch::flat): the new side joins that corner with
/// the vertex beyond. The cells there must still be triangles, and both new triangles must have the right orientation.
/// No element of second order can be valid with such a corner, and a quadrilateral that takes the triangle in keeps it.
/// Returns the number of turned sides.
template <typename Quads>
std::size_t turn_ears(Quads& quads, const ImposedEdges& is_imposed);

/// Brings the numbers of cells around vertices nearer to their ideals: four inside, by the angle on curves. It removes
/// vertices of two cells, draws opposite corners of quadrilaterals together and turns edges between two quadrilaterals.
/// It also exchanges a triangle's place with a quadrilateral beside it. No edge leaves the allowed lengths, and no cell
/// becomes flat. Vertices that go belong to no cell afterwards. Smoothing between passes.
template <typename Quads>
void clean_up(Quads& quads, const ImposedEdges& is_imposed, Monitor& monitor);

/// Joins each triangle with the nearest other triangle (by cells on the way, across edges that are not imposed). The
/// pentagon of a triangle and the quadrilateral beside it is cut anew, so that the triangle lies one cell farther on,
/// and so on. At the end the two triangles become a quadrilateral. Ways on which a cell would become flat are left out.
/// Two triangles and n quadrilaterals become n + 1.
template <typename Quads>
void join_triangles(Quads& quads, const ImposedEdges& is_imposed, Monitor& monitor);

struct QuadSmoothing {
  int passes = 17;
  double share = 1.4;     ///< of the way to the mean of the places that cells propose
  double momentum = 0.7;  ///< share of its last step that a vertex goes on; not in the last passes (plain_passes)
  double pull = 0.1;  ///< 0: cells keep their size; 1: they propose the size of unit edges
  /// Length of unit edges, in the metric.
  double unit = 1;
  /// Marks the vertices that may move; empty: all that are not fixed.
  std::span<const char> moving = {};
};

/// Each cell proposes to its corners the corners of the square or equilateral triangle that fits it best in the metric.
/// Each vertex that is not fixed goes towards the mean of proposals, with momentum (Polyak 1964), which carries strain
/// far in few passes. No cell that is convex turns over or gets flat.
template <typename Quads>
void smooth_quads(Quads& quads, const QuadSmoothing& how, Monitor& monitor);

/// Vertices of cells below `good`, worst first, go where the worst cell around is best.
template <typename Quads>
void improve_worst_quads(Quads& quads, double good, Monitor& monitor);

/// Smooths all vertices, then the worst cells.
template <typename Quads>
void smooth_all(Quads& quads, Monitor& monitor);

/// The passes after pairing: clean-up, walks of triangles, clean-up, smoothing.
template <typename Quads>
void improve_quads(Quads& quads, const ImposedEdges& is_imposed, Monitor& monitor) {
  clean_up(quads, is_imposed, monitor);
  join_triangles(quads, is_imposed, monitor);
  clean_up(quads, is_imposed, monitor);
  smooth_all(quads, monitor);
}

/// Cuts quadrilaterals in four and triangles in three, at middle_of(a, b) of their sides and at centre_of(cell).
template <typename Middle, typename Centre>
std::vector<MixedCell> halved_cells(const std::vector<MixedCell>& cells, const Middle& middle_of, const Centre& centre_of) {
  std::vector<MixedCell> parts;
  parts.reserve(4 * cells.size());
  for (const MixedCell& cell : cells) {
    const int n = corners_of(cell);
    std::array<std::int32_t, 4> middle{};
    for (int k = 0; k < n; ++k) middle[k] = middle_of(cell[k], cell[(k + 1) % n]);
    const std::int32_t centre = centre_of(cell);
    for (int k = 0; k < n; ++k) parts.push_back({cell[k], middle[k], centre, middle[(k + n - 1) % n]});
  }
  return parts;
}

/// Cuts quadrilaterals whose scaled Jacobian in space is not above `least` into two triangles each: along the shorter diagonal, unless
/// only the other diagonal fits. `position(v)`; `is_convex(cell)`.
template <typename Position, typename IsConvex>
void split_quad(std::vector<MixedCell>& cells, std::size_t c, const Position& position, const IsConvex& is_convex) {
  const MixedCell q = cells[c];
  const auto halves = [&](bool other) {
    return other ? std::array<MixedCell, 2>{MixedCell{q[0], q[1], q[3], -1}, {q[1], q[2], q[3], -1}}
                 : std::array<MixedCell, 2>{MixedCell{q[0], q[1], q[2], -1}, {q[0], q[2], q[3], -1}};
  };
  const auto fit = [&](bool other) { return is_convex(halves(other)[0]) && is_convex(halves(other)[1]); };
  bool other = norm(position(q[3]) - position(q[1])) < norm(position(q[2]) - position(q[0]));
  if (!fit(other) && fit(!other)) other = !other;
  cells[c] = halves(other)[0];
  cells.push_back(halves(other)[1]);
}
template <typename Position, typename IsConvex>
void split_poor(std::vector<MixedCell>& cells, double least, const Position& position, const IsConvex& is_convex) {
  for (std::size_t c = 0, n = cells.size(); c < n; ++c) {
    const MixedCell& q = cells[c];
    if (corners_of(q) == 3) continue;
    const std::array<Vec3, 4> p{position(q[0]), position(q[1]), position(q[2]), position(q[3])};
    if (!is_convex(q) || !(scaled_jacobian(p) > least)) split_quad(cells, c, position, is_convex);
  }
}

}  // namespace carreau
