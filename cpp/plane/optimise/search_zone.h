// SPDX-License-Identifier: BSD-3-Clause
// The triangles around a bad one that the local search changes, their cost, and their previous state.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "control_space/sampled_normals.h"
#include "plane/kernel/plane_work.h"
#include "plane/kernel/star.h"
#include "plane/optimise/memo.h"
#include "support/infinity.h"

namespace carreau::plane {

/// Cost of a triangle of this shape. The worst cost most: 2.8 at .8, 0.36 at .95. Equilateral triangles cost nothing.
inline double shape_cost(double quality) noexcept {
  if (!(quality > 0)) return infinity;
  const double inverse2 = 1 / (quality * quality);
  return inverse2 * inverse2 * inverse2 - 1;
}

struct ZoneCost {
  double mean = 0, worst = 1, sum = 0;  ///< of triangles: mean and sum of costs, worst shape
  double shortest2 = 1, longest2 = 1;   ///< squared lengths of edges that are not imposed, and 1
  int across = 0;                       ///< halves of edges that are not imposed, between two fixed vertices
  /// Turning of the surface along these edges, as chords of unit normals, from a floor on: largest square, sum of 4th
  /// powers.
  double turn2 = 0, turns4 = 0;
};

/// Two rings of triangles around one. Results for places are kept from zone to zone: zones overlap.
class SearchZone {
 public:
  /// `normals`: of a curved surface; null: a plane.
  SearchZone(PlaneWork& work, const SampledNormals* normals);

  /// The triangles around the corners of t and around their neighbours, and all that a change of these affects.
  void collect(int t);
  /// All as it was when the zone was collected.
  void restore();
  /// Once its mean is `enough` the rest does not matter.
  [[nodiscard]] ZoneCost cost(double enough);
  /// cost() without the edges.
  [[nodiscard]] ZoneCost cost_of_shapes(double enough);
  [[nodiscard]] double shape(int p, int q, int r);
  /// Moves a vertex.
  void place(int v, Vec2 p);
  /// Splits edge i of t, which is not imposed, in its middle.
  void split(int t, int i);

  PlaneWork& work;
  std::array<std::int32_t, 3> centre{};          ///< corners of the triangle that it was collected around
  std::vector<std::int32_t> triangles, movable;  ///< inner vertices that are not fixed
  std::vector<PlaceKey> places;                  ///< by vertex
  std::int64_t shapes_asked = 0;                 ///< so far
  Memo<Vec2> known_moves;                        ///< of stars: the new place of the vertex
  Memo<bool> known_swaps;                        ///< of diagonals: whether they are swapped
  Star star;                                     ///< scratch

 private:
  void list_triangles(std::vector<std::int32_t>& vertices);
  void add_edges(const Triangle& T, int t, ZoneCost& all);
  [[nodiscard]] Vec3 normal(int v);

  const SampledNormals* normals_;
  Memo<double> known_shapes_;
  Memo<Vec3> known_normals_;  // of places
  std::vector<std::int32_t> vertices_;
  std::vector<std::pair<std::int32_t, Triangle>> as_they_were_;  // these, and the triangles around
  std::vector<std::pair<std::int32_t, Vertex>> old_vertices_;
  std::vector<char> seen_;  // by vertex; scratch, 0 between uses
  std::size_t mesh_triangles_ = 0, mesh_vertices_ = 0, own_triangles_ = 0,
              own_movable_ = 0;  // without added ones
};

}  // namespace carreau::plane
