// SPDX-License-Identifier: BSD-3-Clause
// The conforming mesh of a composite surface.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesh/cells.h"
#include "mesh/periodic_link.h"
#include "support/vec.h"

namespace carreau {

/// Status of a face. Values are part of the C ABI. `collapsed`: a narrow face that has vanished between its neighbours.
/// `wire`: curves of space without area, which results do not list among faces.
enum class FaceStatus : int { not_meshed = 0, meshed = 1, mended = 2, failed = 3, collapsed = 4, wire = 5 };

/// The part of the mesh that lies on one face. Local vertices carry (u, v): a vertex of space on a seam or at a pole
/// has several.
struct FaceMesh {
  int ref = 0;
  std::string name = {};  ///< given by the host; empty: none
  std::int32_t rgb = -1;  ///< given by the host, 0xRRGGBB (sRGB); -1: none
  FaceStatus status = FaceStatus::not_meshed;
  std::string why;                   ///< sentence for `mended`, `failed` and `collapsed`
  std::vector<Vec2> uv;              ///< of local vertices
  std::vector<std::int32_t> vertex;  ///< local -> index in SurfaceMesh::vertices
  /// Local indices; counterclockwise in (u, v), except for triangles named in `why` of a `mended` face.
  std::vector<std::array<std::int32_t, 3>> triangles;
  /// Triangles of (u, v) that a degenerate side flattens in space: part of the plane mesh, not of the mesh in space.
  std::vector<std::array<std::int32_t, 3>> flattened;
  int part_of = 0;  ///< reference of the face that results name in place of this one; 0: none
  /// Quadrilaterals a, b, c, d: triangles[2k] = (a, b, c) and triangles[2k + 1] = (a, c, d), k < quads, are the halves
  /// of one. The triangles behind them are elements themselves. So `triangles` is a straight mesh of any element.
  std::int32_t quads = 0;
  /// Elements of second order: the node of each side of each triangle (side i runs from corner i to the next), as an
  /// index in mid_uv. The diagonals of quadrilaterals have -1. Empty: elements are of first order.
  std::vector<std::array<std::int32_t, 3>> mid = {};
  std::vector<Vec2> mid_uv = {};              ///< of nodes on edges; one on a seam has two places
  std::vector<std::int32_t> mid_vertex = {};  ///< the same -> index in SurfaceMesh::mid_vertices
  /// For cross-patch meshes; else empty. For each local vertex: the face (index in SurfaceMesh::faces) whose (u, v) it has.
  /// For each triangle: 1 if its corners are of several charts (faces, or sides of a seam), so that it is no triangle of (u,
  /// v).
  std::vector<std::int32_t> uv_face = {};
  std::vector<char> spread = {};

  [[nodiscard]] int shown_ref() const noexcept { return part_of != 0 ? part_of : ref; }
  [[nodiscard]] std::array<std::int32_t, 4> quad(std::size_t k) const noexcept {
    const auto& t = triangles[2 * k];
    return {t[0], t[1], t[2], triangles[2 * k + 1][2]};
  }
  [[nodiscard]] std::size_t cell_count() const noexcept { return triangles.size() - static_cast<std::size_t>(quads); }
  [[nodiscard]] bool is_spread(std::size_t triangle) const noexcept { return !spread.empty() && spread[triangle] != 0; }
};

/// One appearance of a discretised curve in a face.
struct CurveMeshUse {
  std::int32_t face = 0;  ///< index in SurfaceMesh::faces
  bool internal = false;  ///< triangles of the face lie on both sides
};

/// A discretised curve: vertices[i], vertices[i+1] are its edges.
struct CurveMesh {
  int ref = 0;
  std::vector<std::int32_t> vertices;  ///< indices in SurfaceMesh::vertices; one entry for a degenerate curve
  std::vector<CurveMeshUse> uses;
  std::vector<std::int32_t> mid = {};  ///< node of each edge, index in SurfaceMesh::mid_vertices; empty: first order
  int part_of = 0;  ///< reference of the curve that results name in its place; 0: none
  bool loose = false;  ///< of wires alone: no triangle has its edges

  [[nodiscard]] int shown_ref() const noexcept { return part_of != 0 ? part_of : ref; }
};

struct SurfaceMesh {
  std::vector<Vec3> vertices;
  std::vector<std::int32_t> vertex_ref;  ///< reference of the corner or imposed point; 0: made by the mesher
  std::vector<FaceMesh> faces;           ///< as in the model
  std::vector<CurveMesh> curves;         ///< as in the topology
  /// Nodes on edges of elements of second order. In a common numbering, these follow the vertices.
  std::vector<Vec3> mid_vertices = {};
  std::vector<PeriodicLink> periodic = {};
  /// Borders that are not sharp mean nothing: curves have the edges that are sharp, others may lie between faces.
  bool independent = false;

  [[nodiscard]] std::size_t triangle_count() const noexcept;
  [[nodiscard]] std::size_t edge_count() const noexcept;        ///< of all curves
  [[nodiscard]] std::size_t loose_edge_count() const noexcept;  ///< edges of curves not on a face
  [[nodiscard]] std::size_t cell_count() const noexcept;
  /// Some elements are quadrilaterals or of second order.
  [[nodiscard]] bool cells_are_not_triangles() const noexcept;
};

/// The elements of a face, quadrilaterals first: nodes are local, nodes on edges uv.size() + index in mid_uv.
std::vector<Cell> local_cells(const FaceMesh& face);
/// The elements of a face, with nodes numbered in the mesh: vertices, then mid_vertices.
std::vector<Cell> cells_of(const SurfaceMesh& mesh, const FaceMesh& face);

/// Gives a face quadrilaterals and triangles of first order, counterclockwise and convex in (u, v), by local vertices.
/// Each quadrilateral is cut along the diagonal whose worse half has the better shape in space (`vertices`: of the
/// mesh).
void set_cells(FaceMesh& face, std::span<const std::array<std::int32_t, 4>> quads,
               std::span<const std::array<std::int32_t, 3>> triangles, std::span<const Vec3> vertices);

/// Quadrilaterals may meet in two edges at a fixed vertex, others beside a fold or across a border of faces. A diagonal that is also an
/// edge or the diagonal of a neighbour would be an edge of four triangles. Cuts these quadrilaterals along the other diagonal, if no
/// cell has that edge. Elements are of first order. Faces with triangles in `flattened` keep their diagonals.
void part_equal_diagonals(SurfaceMesh& mesh);

struct DefectOptions {
  bool closed = false;  ///< an edge with one triangle is a defect
  std::size_t limit = 20;
};

/// One sentence a defect, e.g. "triangle 17 of face 3: no area in space"; empty when the mesh is sound. Checks sizes and
/// index ranges, finite coordinates, repeated vertices, area in (u, v) (exact) and in space, orientation inside each face,
/// duplicated triangles, unused vertices, and the number of triangles on every edge. An edge on a curve has one triangle for
/// each boundary use and two for each internal use in a meshed face. Any other edge has two, of one face. On cross-patch
/// meshes they may be of two faces, and triangles of several charts have no area in (u, v). Faces that are not meshed are
/// passed over.
std::vector<std::string> find_defects(const SurfaceMesh& mesh, const DefectOptions& options = {});

/// Returns, ascending, the vertices of edges with two equally directed triangles of a face, of edges with a wrong number of
/// triangles, and of duplicated triangles. Empty if indices are out of range.
std::vector<std::int32_t> find_wrong_joints(const SurfaceMesh& mesh);

}  // namespace carreau
