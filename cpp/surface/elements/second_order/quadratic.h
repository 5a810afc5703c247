// SPDX-License-Identifier: BSD-3-Clause
// Elements of second order: nodes on the edges of a mesh of first order.
#pragma once

#include <cstdint>
#include <vector>

#include "gradation/edge_sizes.h"
#include "surface/elements/base/work.h"

namespace carreau {

/// An edge of a curve.
struct CurveEdge {
  std::int32_t curve = 0, segment = 0;
  friend auto operator<=>(const CurveEdge&, const CurveEdge&) = default;
};

/// The end of an edge of a curve where a second edge leaves in the same direction.
struct CuspEnd {
  std::int32_t curve = 0, segment = 0;
  bool first = false;  ///< of the ends of the edge
  friend auto operator<=>(const CuspEnd&, const CuspEnd&) = default;
};

/// The elements of a face that stay invalid.
struct InvalidElements {
  std::size_t face = 0, count = 0;
  Vec2 uv;  ///< in the middle of the worst one
};

/// One of them.
struct InvalidElement {
  std::size_t face = 0;
  /// The sides, each with a size: half of the longest side or of the prescribed size, whichever is smaller (without halving if all
  /// elements are cut).
  std::vector<EdgeSizes::Source> sides = {};
  std::vector<CurveEdge> coarse = {};  ///< its edges on curves
};

struct QuadraticReport {
  std::size_t crossed = 0;      ///< elements that were invalid with nodes in the middles of straight edges of (u, v)
  std::size_t moved_nodes = 0;  ///< nodes inside faces that repairs have moved, of edges and of corners
  std::vector<InvalidElements> invalid;
  std::vector<std::vector<std::int32_t>> quads;  ///< by face: quadrilaterals among them, ascending
  std::vector<InvalidElement> elements;          ///< that stay invalid, face after face
  std::vector<CuspEnd> cusps;     ///< of elements that stay invalid with a corner there, ascending, each once
};

/// Gives each edge of result.mesh a node. An edge of a curve gets the point at half its metric length, once for all
/// faces. An edge inside a face gets S at the metric middle of the segment of (u, v). Then repairs elements whose
/// Jacobian is not positive in (u, v) and in space: nodes inside the face move first, then vertices. The Jacobian has
/// Bernstein coefficients of degree 2, or (3, 3). Meshes that have nodes on edges get new ones. Nodes of edges that end
/// at `cusps`, ascending, are drawn away from the cusps. Parabolas through middles meet there at no angle, or at one
/// that rounding gives them.
QuadraticReport make_quadratic(const ElementWork& work, const std::vector<CuspEnd>& cusps = {});

/// Turns each of these quadrilaterals of a face into two triangles again, without nodes on edges.
void part_quads(FaceMesh& face, const std::vector<std::int32_t>& quads);

/// The repairs of make_quadratic(), for one face. `fixed_mid` and `fixed_vertex` mark by local index the nodes and
/// vertices that keep their places. Returns true if all elements were valid and repairs of other faces do not move
/// nodes of this face.
bool mend_face(const ElementWork& work, std::size_t face, const std::vector<char>& fixed_mid,
               const std::vector<char>& fixed_vertex, QuadraticReport& report);

/// Reports the elements of a face that are invalid when all faces are made.
void find_invalid(const ElementWork& work, std::size_t face, QuadraticReport& report);

}  // namespace carreau
