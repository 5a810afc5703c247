// SPDX-License-Identifier: BSD-3-Clause
// Input triangles, repaired: neighbours, orientation, defects.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/flat_mesh.h"

namespace carreau::discrete {

/// An edge: the smaller vertex first.
using Edge = std::array<std::int32_t, 2>;
inline std::size_t index(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }
inline Edge edge_of(std::int32_t v, std::int32_t w) noexcept { return v < w ? Edge{v, w} : Edge{w, v}; }

/// Defects that were found and repaired.
struct Findings {
  std::int64_t joined_vertices = 0;     ///< had the coordinates of a previous vertex
  std::int64_t repeated_triangles = 0;  ///< with the vertices of a previous triangle: dropped
  std::int64_t flat_triangles = 0;      ///< without area: dropped
  std::int64_t turned_triangles = 0;    ///< ran against most of their shell: turned
  std::int64_t border_edges = 0;        ///< with one triangle
  std::int64_t manifold_breaks = 0;     ///< edges with three triangles or more
  std::int64_t pinched_vertices = 0;    ///< whose triangles are connected by the vertex alone
  std::int64_t one_sided_edges = 0;     ///< on which no orientation agrees (a Moebius strip)
  std::int64_t shells = 0;              ///< connected over edges
  std::int64_t unused_vertices = 0;
  std::int64_t euler_number = 0;  ///< vertices in use - edges + triangles
  /// Sentences, a defect each, with the place of the first one.
  std::vector<std::string> sentences = {};
};

/// An edge as a side of a triangle.
struct Side {
  std::int32_t triangle;
  int side;  ///< from this corner to the next one
};

/// Triangles with neighbours. Vertices are the used vertices of the input, in order.
class Triangulation {
 public:
  /// Joins vertices of equal coordinates when `join`, and drops repeated triangles and triangles without area
  /// (flat_triangles.h). Turns triangles so that neighbours agree: each shell follows most of its triangles. Throws
  /// InvalidArgument when no triangle is left.
  explicit Triangulation(const FlatMesh& input, bool join = true);

  std::vector<Vec3> vertices;
  std::vector<std::int32_t> vertex_refs;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> refs;    ///< of triangles
  std::vector<Edge> edges;           ///< ascending
  std::vector<std::int32_t> shell;   ///< by triangle, from 0
  std::vector<Edge> marked;          ///< edges of the input, ascending
  std::vector<std::int32_t> origin;  ///< of triangles: index in the input
  Findings findings;

  /// Index of an edge of a triangle, from corner `side` to the next one.
  [[nodiscard]] std::int32_t edge(std::int32_t triangle, int side) const {
    return edge_[3 * static_cast<std::size_t>(triangle) + static_cast<std::size_t>(side)];
  }
  /// All sides of an edge; most edges have two.
  [[nodiscard]] std::span<const Side> sides(std::int32_t edge) const;
  /// The other triangle on a side with exactly two that agree; triangle -1: none.
  [[nodiscard]] Side beyond(std::int32_t triangle, int side) const;
  /// Index of an edge; -1: not an edge.
  [[nodiscard]] std::int32_t find_edge(std::int32_t v, std::int32_t w) const;
  [[nodiscard]] std::int32_t corner(std::int32_t triangle, int k) const {
    return triangles[static_cast<std::size_t>(triangle)][static_cast<std::size_t>(k % 3)];
  }
  [[nodiscard]] const Vec3& at(std::int32_t vertex) const { return vertices[static_cast<std::size_t>(vertex)]; }
  /// Unit normal of a triangle.
  [[nodiscard]] Vec3 normal(std::int32_t triangle) const;
  /// Angle of a triangle at a corner, radians.
  [[nodiscard]] double angle(std::int32_t triangle, int k) const;
  /// Angle between the normals of the two triangles of an edge, degrees. It is 180 on edges with other than two, or two
  /// that run in one direction.
  [[nodiscard]] double bend(std::int32_t edge) const;
  [[nodiscard]] double diagonal() const;

 private:
  void take_vertices(const FlatMesh& input, bool join, std::vector<std::int32_t>& number);
  void take_triangles(const FlatMesh& input, const std::vector<std::int32_t>& number);
  void drop_repeated();
  void drop_flat();
  void drop_unused(const FlatMesh& input);
  void link();
  void turn();
  void count(const FlatMesh& input);
  [[nodiscard]] std::string place(std::int32_t vertex) const;

  std::vector<std::int32_t> edge_;   // of sides
  std::vector<Side> sides_;          // by edge
  std::vector<std::int32_t> start_;  // of edges in sides_
};

}  // namespace carreau::discrete
