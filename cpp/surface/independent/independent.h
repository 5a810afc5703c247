// SPDX-License-Identifier: BSD-3-Clause
// Meshes with the prescribed sizes, independent of the patches (HDR sec. 4.5.5).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "curve/curve_model.h"
#include "curve/discrete_curve.h"
#include "surface/independent/base/charts.h"
#include "surface/independent/base/free_mesh.h"
#include "surface/independent/base/sharp_edges.h"
#include "surface/independent/division/divided_remeshing.h"
#include "surface/independent/line_places.h"
#include "surface/options.h"
#include "surface/result.h"

namespace carreau {

struct FreedMesh;
struct PlacedMesh;
struct WorkedLine;

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
  std::function<void(const SurfaceMesh& before, FreedMesh& made)> elements = {};
  /// Makes the whole mesh, for mend_in_frame(); returns nothing if it cannot.
  std::function<std::optional<PlacedMesh>(std::span<const WorkedLine>, const SurfaceTolerances&)> made = {};
  std::vector<char> kept = {};  ///< by triangle of the atlas: `made` takes it as it is; empty: none
  double angle_slack = 1;   ///< times the angle of the geometric rule is tolerated as A1
  RemeshingWorkers workers = {};
};

/// Tolerances on the distance of triangles from the surface: by the geometric rule, otherwise by the size. `by_direction`: sizes differ by
/// direction; `angle_slack`: see RemeshingFrame.
SurfaceTolerances surface_tolerances(const CompositeOptions& options, bool by_direction, double angle_slack);

/// Makes the mesh of `result` again by CompositeResult::vertex_size: lengths, shapes, references, curves and (u, v) of its corners. Returns
/// the reason if the mesh stays as it is after several rounds: the outcome would have a defect, or new triangles that cross. Empty: the
/// mesh is made.
std::string remesh_in_frame(RemeshingFrame& frame, Cad& cad, const CompositeOptions& options, CompositeResult& result,
                            Monitor& monitor);

/// Repairs a mesh from frame.made, around its seams only. `least_mean`: least mean shape. Returns the reason if the mesh is not made, with
/// nothing changed.
std::string mend_in_frame(RemeshingFrame& frame, double least_mean, Cad& cad, const CompositeOptions& options,
                          CompositeResult& result, Monitor& monitor);

/// Keeps the triangles: only frame.elements makes other elements of them.
void make_elements_of_frame(RemeshingFrame& frame, Cad& cad, const CompositeOptions& options, CompositeResult& result,
                            Monitor& monitor);

/// RemeshingFrame::elements.
using ElementMaker = std::function<void(const SurfaceMesh& before, const RemeshingFrame& frame, FreedMesh& made)>;

/// `curves`: the curves that the mesh was made with. Makes the mesh of `result` free of borders that are not sharp: lengths, shapes,
/// references, curves and (u, v) of its corners. `by_direction`: sizes may differ by direction, as the control spaces of the patches have
/// them. `elements` may be empty. Returns false, with an unchanged mesh, if the outcome would have a defect or new triangles that cross.
/// Sentences about faces that have vanished go to `monitor`. Throws the exceptions of the host, and Cancelled, with nothing changed.
bool free_from_patches(const CurveModel& model, std::span<const DiscreteCurve> curves, const CompositeOptions& options,
                       bool by_direction, const ElementMaker& elements, CompositeResult& result, Monitor& monitor);

/// Keeps the triangles: only `elements`, which is not empty, makes a mesh that is free of patches.
void free_elements_from_patches(const CurveModel& model, std::span<const DiscreteCurve> curves, const CompositeOptions& options,
                                bool by_direction, const ElementMaker& elements, CompositeResult& result, Monitor& monitor);

}  // namespace carreau
