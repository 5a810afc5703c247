// SPDX-License-Identifier: BSD-3-Clause
// Triangles joined two by two (HDR sec. 3.3.4).
#pragma once

#include <functional>
#include <vector>

#include "support/monitor.h"
#include "surface/quads/quad_patch.h"

namespace carreau {

class SpaceQuads;

/// Returns whether an edge between two vertices is an edge of a curve.
using ImposedEdges = std::function<bool(std::int32_t, std::int32_t)>;

/// The conditions on pairs of triangles, beside strict convexity in (u, v).
struct PairRules {
  ImposedEdges is_imposed;
  /// The place in space of a corner of a triangle.
  std::function<Vec3(std::int32_t)> position;
  double most_turn = 0.3;  ///< radians: largest angle between the normals of the two, in space
  double least_jacobian = 0;  ///< of the quadrilateral in space: a candidate must exceed it
};

/// Joins triangles of the patch, which has no other cells, by a matching of large weight. Quality is measured in the
/// metric of `charts`; without charts, in space.
void pair_triangles(QuadPatch& patch, const FaceCharts* charts, const PairRules& rules, Monitor& monitor);
void pair_triangles(SpaceQuads& quads, const PairRules& rules, Monitor& monitor);

/// Turns the third side of each triangle that has a flat corner (QuadPatch::flat): the new side joins that corner with
/// the vertex beyond. The cells there must still be triangles, and both new triangles must have the right orientation.
/// No element of second order can be valid with such a corner, and a quadrilateral that takes the triangle in keeps it.
/// Returns the number of turned sides.
std::size_t turn_ears(QuadPatch& patch, const ImposedEdges& is_imposed);
std::size_t turn_ears(SpaceQuads& quads, const ImposedEdges& is_imposed);

}  // namespace carreau
