// SPDX-License-Identifier: BSD-3-Clause
// Messages of a session before and after a run. Private to session/.
#pragma once

#include <span>

#include "measure/mesh_evaluation.h"
#include "mesh/quality.h"
#include "model/model.h"
#include "pipeline/parts/part_mesh.h"
#include "support/monitor.h"
#include "surface/layers/bare_edges.h"
#include "surface/layers/layer_figures.h"
#include "surface/result.h"
#include "surface/supports.h"

namespace carreau {

/// A message for each curve whose ends are nearer than `eps_ends`, which is sometimes an error (RT-0232 sec. 3.3).
void report_short_curves(const Model& model, const ModelSupports& supports, double eps_ends, Monitor& monitor);

/// Sets the status of faces with triangles without area in space to `mended`, with a reason, and warns of them: two
/// points of the geometry coincide there, or it folds.
void report_flat_triangles(SurfaceMesh& mesh, int threads, Monitor& monitor);

/// A summary of a run in a few lines.
void describe_result(const CompositeResult& result, const QualitySummary& shapes, Monitor& monitor);

/// A line for each set of layers along curves: heights of the first row, also over the requested height, growth, rows.
void describe_layers(std::span<const LayerFigures> layers, std::span<const CurveLayers> given, Monitor& monitor);
/// A warning for each set of layers with edges that have no row.
void describe_bare_edges(std::span<const BareEdges> layers, Monitor& monitor);

void describe_part(const PartMesh& part, const CompositeReport& report, Monitor& monitor);

/// Histograms as a summary, a warning for each prescription that is not met, and one for the faces with triangles beyond their tolerances.
void describe_evaluation(const SurfaceMesh& mesh, const MeshEvaluation& delivered, Monitor& monitor);

}  // namespace carreau
