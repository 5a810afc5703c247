// SPDX-License-Identifier: BSD-3-Clause
// The elements of a mesh by kind, for formats with a section for each kind.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/flat_mesh.h"

namespace carreau {

/// Elements of one kind in their order: nodes count from 0.
template <std::size_t N>
struct ElementList {
  std::vector<std::array<std::int32_t, N>> nodes;
  std::vector<std::int32_t> refs;
};

struct ElementLists {
  ElementList<3> triangles;
  ElementList<6> triangles6;
  ElementList<4> quads;
  ElementList<8> quads8;
  ElementList<2> edges;
  ElementList<3> edges3;  ///< two ends, then the node between them
};

/// Every list of references is full. A mesh without cells has its triangles itself: they are not copied.
ElementLists lists_of(const FlatMesh& mesh);

/// The value of a Q2 element of eight nodes at its centre: the element with nine nodes has the same value.
Vec3 centre_of(const FlatMesh& mesh, const std::array<std::int32_t, 8>& nodes) noexcept;

/// With nine nodes a quadrilateral of second order, as the formats of Medit know it.
struct MeditElements {
  /// The mesh must live as long.
  explicit MeditElements(const FlatMesh& mesh);
  MeditElements(const MeditElements&) = delete;
  MeditElements& operator=(const MeditElements&) = delete;

  ElementLists lists;  ///< quads8 stays as it is
  /// Straight triangles: from the mesh, whose references may be empty, or from the lists.
  const std::vector<std::array<std::int32_t, 3>>& triangles;
  const std::vector<std::int32_t>& triangle_refs;
  ElementList<9> quads9;      ///< the same with their centres
  std::vector<Vec3> centres;  ///< the vertices that follow the vertices of the mesh
};

/// Fills the elements of a mesh whose vertices are known. If all are straight triangles, FlatMesh::cells stays empty.
/// Corners of quadrilaterals are turned so that their triangles have the better shape. Throws InvalidArgument, with a
/// sentence for the reader to place, when elements of both orders are mixed.
void set_elements(const ElementLists& lists, FlatMesh& mesh);

/// Appends quadrilaterals of nine nodes without their ninth node, the centre. Centres that no other element has leave
/// the mesh.
void take_quads9(const std::vector<std::array<std::int32_t, 9>>& quads, const std::vector<std::int32_t>& refs,
                 ElementLists& lists, FlatMesh& mesh);

}  // namespace carreau
