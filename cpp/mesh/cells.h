// SPDX-License-Identifier: BSD-3-Clause
// Kinds of elements, and the order of their nodes.
#pragma once

#include <array>
#include <cstdint>

namespace carreau {

/// The kinds of elements. Values are part of the C ABI. Nodes are in the order of VTK's cells 5, 22, 9, 23 and of
/// Gmsh's elements 2, 9, 3, 16. The corners come counterclockwise, then the nodes of the edges 01, 12, 20, or 01, 12,
/// 23, 30.
enum class CellKind : int {
  triangle3 = 1,  ///< straight triangle
  triangle6 = 2,  ///< P2: nodes on the edges
  quad4 = 3,      ///< Q1: bilinear quadrilateral
  quad8 = 4       ///< Q2 without a node inside (serendipity)
};

constexpr int corner_count(CellKind kind) noexcept {
  return kind == CellKind::triangle3 || kind == CellKind::triangle6 ? 3 : 4;
}
constexpr bool is_quadratic(CellKind kind) noexcept {
  return kind == CellKind::triangle6 || kind == CellKind::quad8;
}
constexpr int node_count(CellKind kind) noexcept { return corner_count(kind) * (is_quadratic(kind) ? 2 : 1); }

/// One element: the first node_count(kind) nodes count, the others are -1. The container of the cells defines the
/// meaning of the numbers.
struct Cell {
  CellKind kind = CellKind::triangle3;
  std::array<std::int32_t, 8> nodes{-1, -1, -1, -1, -1, -1, -1, -1};
  friend bool operator==(const Cell&, const Cell&) = default;
};

/// The requested elements (`element`, RT-0232 sec. 3.3, HDR fig. 3.6).
enum class Element : int {
  p1,    ///< straight triangles
  p2,    ///< curved triangles of six nodes
  q1_0,  ///< straight quadrilaterals and a few triangles
  q1_1,  ///< straight quadrilaterals only
  q2_0,  ///< curved quadrilaterals of eight nodes and a few curved triangles
  q2_1   ///< curved quadrilaterals only
};

constexpr bool is_quadratic(Element e) noexcept {
  return e == Element::p2 || e == Element::q2_0 || e == Element::q2_1;
}
constexpr bool has_quads(Element e) noexcept { return e != Element::p1 && e != Element::p2; }
constexpr bool has_quads_only(Element e) noexcept { return e == Element::q1_1 || e == Element::q2_1; }

}  // namespace carreau
