// SPDX-License-Identifier: BSD-3-Clause
// A mesh as files and the C ABI see it: flat lists, references, fields.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/surface_mesh.h"
#include "model/names.h"

namespace carreau {

/// One number or vector a vertex, or a cell: a triangle or an edge.
struct MeshField {
  std::string name;
  bool on_vertices = true;
  int components = 1;
  std::vector<double> values;            ///< of vertices or triangles, entity by entity, components together
  std::vector<double> edge_values = {};  ///< of edges, when not on vertices. One list may be empty: NaN
};

/// Data of a face besides its triangles, which have its reference.
struct FlatFace {
  std::int32_t ref = 0;
  FaceStatus status = FaceStatus::not_meshed;
  std::string name = {};  ///< empty: none
  std::string why = {};   ///< sentence for `mended`, `failed` and `collapsed`
  std::int32_t rgb = -1;  ///< 0xRRGGBB (sRGB); -1: none
};

struct FlatMesh {
  int dimension = 3;  ///< 2: z is 0 and not written
  std::vector<Vec3> vertices;
  std::vector<std::int32_t> vertex_refs;
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< indices from 0
  std::vector<std::int32_t> triangle_refs;
  std::vector<std::array<std::int32_t, 2>> edges;
  std::vector<std::int32_t> edge_refs;
  std::vector<MeshField> fields;
  std::vector<FlatFace> faces = {};  ///< may be empty, or lack references of triangles
  /// Elements in the order of their triangles: an element of three corners is one triangle, a quadrilateral a, b, c, d
  /// two consecutive triangles, (a, b, c) and (a, c, d). Its triangles have its reference. Nodes number vertices.
  /// Empty: the triangles are the elements.
  std::vector<Cell> cells = {};
  std::vector<std::int32_t> edge_mids = {};  ///< node of each edge, index in vertices; empty: edges are straight
  EntityNames names = {};
  std::vector<PeriodicLink> periodic = {};
  /// Straight solids of a volume mesh, indices from 0: read for background meshes, never written.
  std::vector<std::array<std::int32_t, 4>> tetrahedra = {};

  [[nodiscard]] bool is_quadratic() const noexcept {
    return !cells.empty() && carreau::is_quadratic(cells.front().kind);
  }
};

/// Appends an element and its triangles, a quadrilateral as it is turned.
void add_cell(FlatMesh& mesh, const Cell& cell, std::int32_t ref);

/// The data of a face and of its parts, which follow it.
struct WholeFace {
  FlatFace face;              ///< failed when a part is, else mended when one is; `why` of the first such part
  std::size_t triangles = 0;  ///< of all parts
};

/// In order; parts of one face are one, and wires are none.
std::vector<WholeFace> whole_faces(const SurfaceMesh& mesh);

/// The whole mesh in space, faces in order, parts of one face as one. with_edges: includes the edges of all curves,
/// otherwise only edges of curves not on a face.
FlatMesh flatten(const SurfaceMesh& mesh, bool with_edges);

}  // namespace carreau
