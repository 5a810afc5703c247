// SPDX-License-Identifier: BSD-3-Clause
// The result of a run over a composite surface.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "control_space/control_space.h"
#include "curve/edge_accuracy.h"
#include "gradation/graded_field.h"
#include "mesh/crossings/intersections.h"
#include "mesh/surface_mesh.h"
#include "surface/patch.h"

namespace carreau {

class Charts;

/// Report of a run, besides the mesh.
struct CompositeReport {
  CallCounts calls;
  double diag = 0;
  /// Patches meshed again because their lengths in space differed from the lengths that the sampling promised.
  int corrections = 0;
  int gradation_rounds = 0;             ///< graphs that the gradation has made
  std::size_t gradation_triangles = 0;  ///< of the last one
  std::int64_t crossings = -1;          ///< pairs of triangles that cross; -1: not checked
  double seconds_gradation = 0, seconds_curves = 0;
  double seconds_sampling = 0, seconds_plane = 0, seconds_lift = 0;  ///< sums over all threads
  double seconds_total = 0;
};

/// The distance between a curve's vertices and its faces (DiscreteCurve::gap), and the farthest use.
struct CurveGap {
  double gap = 0;
  int use = 0;
};

/// The mesh of one face of a mesh that is kept in parts.
struct FaceShare {
  int rank = -1;                                   ///< of the process that keeps it; -1: the face has no mesh
  std::int64_t first_vertex = 0, vertices = 0;     ///< numbers in the whole mesh of the vertices that are not on curves
  std::int64_t first_triangle = 0, triangles = 0;
};

/// The owners of the parts of a mesh, and the places of the parts in the whole mesh.
struct MeshShares {
  int rank = 0, processes = 1;   ///< of this one
  std::int64_t on_curves = 0;    ///< vertices of curves, which all processes have; they come first
  std::vector<FaceShare> of_face;
  std::int64_t vertices = 0, triangles = 0;  ///< of the whole mesh
};

/// A mesh with the data of its vertices and curves.
struct SizedMesh {
  SurfaceMesh mesh;
  std::vector<double> vertex_size;  ///< prescribed size at each vertex
  /// [curve of mesh.curves][its vertex]: prescribed size along the curve; empty for a curve without edges.
  std::vector<std::vector<double>> curve_size;
  std::vector<CurveParameters> curve_parameters;  ///< by curve of mesh.curves
  /// Closest points on the previous mesh, if the mesh is independent of its patches: [face][local vertex] a triangle which has its (u, v);
  /// else empty.
  std::vector<std::vector<std::int32_t>> feet;
  std::vector<std::vector<std::int32_t>> mid_feet;  ///< closest points of nodes on edges, by index in FaceMesh::mid_uv
};

struct CompositeResult : SizedMesh {
  std::vector<FaceInterfaces> interfaces;           ///< by face; empty where the domain could not be made
  std::vector<std::optional<ControlSpace>> spaces;  ///< by face: the control space of the mesher; empty: it was not sampled
  std::shared_ptr<const GradedField> graded;        ///< bounds the sizes inside faces; null without gradation
  std::shared_ptr<const Charts> atlas;  ///< for a mesh that is independent of its patches: the previous mesh; else null
  std::vector<CurveGap> gaps;  ///< by curve of the topology
  CompositeReport report;
  std::vector<TriangleIntersection> crossings;  ///< the first of the report's, by triangles face after face; empty for a mesh in parts
  /// If set, the mesh has the vertices of all curves, and the triangles of the faces that this process keeps.
  std::optional<MeshShares> shares = {};
};

}  // namespace carreau
