// SPDX-License-Identifier: BSD-3-Clause
// The surface over triangles of (u, v).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cad/cad.h"
#include "measure/base/degenerate_sides.h"
#include "measure/base/mesh_edges.h"
#include "mesh/surface_mesh.h"
#include "support/monitor.h"
#include "surface/remesh/bounds/chart_map.h"

namespace carreau {

/// A place of a triangle of a face.
struct ChartedPlace {
  std::int32_t triangle = 0;
  PlaceInTriangle at;
};

/// An edge of the mesh between two triangles of (u, v) of one face.
struct SharedEdge {
  std::array<std::int32_t, 2> beside{-1, -1};  ///< the triangles beside, in the face
  std::int32_t place = -1, from = 0, to = 0;   ///< the first of its places; local vertices
};

/// Places of one face; the places of vertices and edges that triangles share are evaluated once. Keeps references to its
/// arguments.
///
/// Edges between triangles are parabolas of (u, v) whose images lie over their chords, to the order of the derivatives at their ends:
/// straight edges of (u, v) bend away from them in the tangent plane.
class ChartedPlaces {
 public:
  /// `first`: rank of the first triangle of the face in the mesh. `shared`: an entry for each edge, as new.
  ChartedPlaces(const SurfaceMesh& mesh, std::int32_t face, std::size_t first, const MeshEdges& edges,
                std::vector<SharedEdge>& shared, Cad& cad, Monitor& monitor);
  ChartedPlaces(const ChartedPlaces&) = delete;
  ChartedPlaces& operator=(const ChartedPlaces&) = delete;
  ~ChartedPlaces();

  /// Sees the lattices of these triangles.
  void see(std::span<const std::int32_t> triangles);
  /// Places of the k-th triangle.
  [[nodiscard]] std::array<BoundPlace, TriangleBound::lattice_size> lattice(std::size_t k) const;
  /// Other places of the triangles seen last.
  [[nodiscard]] std::vector<BoundPlace> see(std::span<const ChartedPlace> places);

 private:
  using Ranks = std::array<std::int32_t, TriangleBound::lattice_size>;
  struct AtVertex {
    std::int32_t place = -1;
    bool regular = false;
    Vec3 su, sv;
  };
  void link();
  void see_vertices(std::span<const std::int32_t> triangles);
  void see_vertex(std::int32_t v);
  [[nodiscard]] Vec2 bulge_of(std::int32_t triangle, int side) const;
  void forget();
  [[nodiscard]] ChartMap map_of(std::int32_t triangle) const;
  [[nodiscard]] Vec2 arrival(std::int32_t pole, std::int32_t from) const;
  void add_side(std::int32_t triangle, int side, const ChartMap& map, Ranks& ranks);
  std::int32_t add(const Vec2& uv);
  template <typename Use>
  void evaluate(std::span<const Vec2> uv, const Use& use);

  const SurfaceMesh& mesh_;
  const FaceMesh& face_;
  std::size_t first_;
  const MeshEdges& edges_;
  Cad& cad_;
  Monitor& monitor_;
  DegenerateSides degenerate_;
  std::vector<AtVertex> vertex_;           // by local vertex
  std::vector<SharedEdge>& edge_;
  std::vector<std::int32_t> seen_, used_;  // vertices and edges of this time
  std::vector<Vec2> uv_;
  std::vector<BoundPlace> place_;
  std::vector<Ranks> ranks_;  // by triangle of this time
};

}  // namespace carreau
