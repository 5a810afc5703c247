// SPDX-License-Identifier: BSD-3-Clause
// A mesh for solvers: elements with numbers, in named sets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/flat_mesh.h"

namespace carreau {

/// The elements of one face. Their numbers are first, first + 1, ...
struct FaceSet {
  std::int32_t ref = 0;
  std::string name;         ///< "face_3"; "face_m3" for reference -3
  std::size_t first = 0;    ///< from 1
  std::vector<Cell> cells;  ///< kind by kind
};

/// The edges of one curve, numbered behind all elements of faces.
struct CurveSet {
  std::int32_t ref = 0;
  std::string name;       ///< "curve_5"
  std::size_t first = 0;  ///< from 1
  std::vector<std::vector<std::int32_t>> edges;  ///< two ends, and the node between them if edges are curved
};

/// Faces, or curves, to which the file or the host has given one name.
struct NamedSets {
  std::string name;               ///< of letters, digits and '_'; no other set has it, in capitals or not
  std::vector<std::size_t> sets;  ///< indices of face sets, or curve sets, ascending
};

/// Corners and imposed points to which the file or the host has given one name.
struct NamedVertices {
  std::string name;                   ///< as in NamedSets
  std::vector<std::size_t> vertices;  ///< indices, ascending
};

struct ElementSets {
  std::vector<FaceSet> faces;    ///< ascending references
  std::vector<CurveSet> curves;  ///< ascending references
  std::vector<NamedSets> names;        ///< of faces
  std::vector<NamedSets> curve_names;
  std::vector<NamedVertices> point_names;
  std::size_t elements = 0;  ///< of faces and curves
};

/// Names are cut to `longest` characters, and equal ones get numbers, as NAME_2.
ElementSets sets_of(const FlatMesh& mesh, std::size_t longest);

/// Nodes of an element of second order around it: a corner, the node behind it, and so on.
std::vector<std::int32_t> around(const Cell& cell);

/// Throws InvalidArgument when the mesh has elements of second order: `format` (".su2") has none.
void refuse_second_order(const FlatMesh& mesh, const std::string& format);

}  // namespace carreau
