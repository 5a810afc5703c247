// SPDX-License-Identifier: BSD-3-Clause
// The surface that is remeshed: atlas, sharp lines and tolerances.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "surface/remesh/base/charts.h"
#include "surface/remesh/base/cross_patch_mesh.h"
#include "surface/remesh/base/sharp_edges.h"
#include "surface/remesh/division/divided_remeshing.h"
#include "surface/remesh/lines/line_places.h"
#include "surface/remesh/lines/line_remeshing.h"
#include "surface/options.h"
#include "surface/result.h"

namespace carreau {

/// A mesh over an atlas, from parametric remeshing. Vertices of lines reuse as many numbers of these lines' vertices in the input mesh as
/// necessary; others follow.
struct PlacedMesh {
  std::vector<SurfacePlace> added;                ///< the vertices that follow
  std::vector<EditableMesh::Triangle> triangles;  ///< as the atlas is turned
  std::vector<std::vector<LineNode>> lines;       ///< by line
  std::vector<std::vector<KeptPlaces>> on_line;   ///< by line and node; none where a vertex stays where it was
  std::vector<std::int32_t> seams;                ///< vertices that nothing but the making has put in line
  std::vector<std::int32_t> kept;                 ///< corners of triangles that were in the input mesh
};

struct CrossPatchResult;

/// The input of remeshing in space: the atlas, the remaining lines, and other possible places of their vertices.
struct RemeshingFrame {
  VertexJets jets;
  std::vector<MeshEdge> sharp;  ///< ascending
  std::shared_ptr<Charts> charts;
  std::vector<std::int32_t> corners;  ///< ascending
  std::vector<SharpLine> lines;
  std::function<std::unique_ptr<LineGeometry>(const SharpLine&)> geometry;
  bool everywhere = false;  ///< see remesh()
  /// Makes other elements of the triangles that replace the mesh `before`; empty: the triangles stay.
  std::function<void(const SurfaceMesh& before, CrossPatchResult& made)> elements = {};
  /// Makes the whole mesh, for remesh_from_planes(); returns nothing if it cannot.
  std::function<std::optional<PlacedMesh>(std::span<const WorkedLine>, const SurfaceTolerances&)> made = {};
  std::vector<char> kept = {};  ///< by triangle of the atlas: `made` takes it as it is; empty: none
  /// Index: line. The line, not behind it, that is divided for it; -1: none. May be empty. Such lines keep their first division in planes.
  std::vector<std::int32_t> twin = {};
  double angle_slack = 1;   ///< times the angle of the geometric rule is tolerated as A1
  RemeshingWorkers workers = {};
};

/// Tolerances on the distance of triangles from the surface: by the geometric rule, otherwise by the size. `by_direction`: sizes differ by
/// direction; `angle_slack`: see RemeshingFrame.
SurfaceTolerances surface_tolerances(const CompositeOptions& options, bool by_direction, double angle_slack);

}  // namespace carreau
