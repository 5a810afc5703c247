// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/mesh_rounds.h"

#include <algorithm>
#include <utility>

#include "periodic/shared_curves.h"
#include "pipeline/base/thresholds.h"
#include "support/error.h"
#include "surface/improve/even_edges.h"

namespace carreau {

namespace {

std::ptrdiff_t failed_faces(const CompositeResult& result) {
  return std::count_if(result.mesh.faces.begin(), result.mesh.faces.end(),
                       [](const FaceMesh& face) { return face.status == FaceStatus::failed; });
}

void begin_again(CompositeRun& run) {
  run.begin += (1 - run.begin) * (ProgressShares::curves + ProgressShares::patches);
}

void mesh_discretised(CompositeRun& run) {
  refine_boundaries(run);
  if (run.may_have_rounds()) run.cut_curves = run.curves;
  run.layer_cells.clear(), run.turned_at_rows.clear();
  run.layers.find_bulges(run.curve_model, run.curves);
  mesh_patches(run);
  assemble_patches(run);
}

// Neighbours of vanishing faces are meshed without their end caps. If a face cannot vanish, meshes all faces with end
// caps, and then removes as many narrow faces as possible.
void mesh_without_narrow(CompositeRun& run) {
  const std::vector<DiscreteCurve> before = run.curves;
  mesh_discretised(run);
  if (collapse_narrow_together(run)) return;
  begin_again(run);
  run.narrow.vanishing = {};
  run.curves = before;
  mesh_discretised(run);
  collapse_narrow_one_by_one(run);
}

// Also enforces the gradation of neighbouring edges on the assembled mesh.
void even_out_sampled(CompositeRun& run) {
  const CompositeOptions& options = run.options;
  if (run.isotropic())
    even_out_lengths(adjacent_lengths * options.gradation,
                     options.size.guarantee_triangles ? geometric_limits(options.size) : GeometricLimits{}, run.rules, run.cad,
                     run.result, run.monitor);
  else
    even_out_sizes(tolerated_gradation * options.gradation,
                   options.size.geo_guarantee ? geometric_limits(options.size) : GeometricLimits{}, run.rules, run.cad,
                   run.result, run.monitor);
}

// Periodic faces and faces with layers stay as they are: faces without control space do.
void even_out(CompositeRun& run) {
  if (run.slope() == 0) return;
  run.known.complete(run.result);
  std::vector<std::optional<ControlSpace>> kept(run.model.faces.size());
  const auto exchange = [&] {
    for (std::size_t f = 0; f < kept.size(); ++f)
      if ((!run.periodic.empty() && run.periodic.is_periodic[f] != 0) || (f < run.layer_cells.size() && !run.layer_cells[f].empty()))
        std::swap(kept[f], run.result.spaces[f]);
  };
  exchange();
  even_out_sampled(run);
  exchange();
}

void halve_segments(CompositeRun& run, const std::vector<std::pair<std::int32_t, int>>& segments) {
  run.curves = run.cut_curves;
  for (auto edge = segments.rbegin(); edge != segments.rend(); ++edge)
    (void)split_segment(run.curves[edge->first], edge->second, run.curve_model);
  complete_classes(run.periodic, run.curve_model, run.curves);
  if (!run.narrow.strips.empty()) complete_sides(run.curve_model, run.narrow.strips, run.curves);
}

}  // namespace

MeshRounds::MeshRounds(CompositeRun& run)
    : run_(run), narrow_(run.narrow), max_triangles_(run.options.max_triangles), independent_(run.options.independent) {}

void MeshRounds::mesh() {
  run_.narrow = narrow_;
  if (narrow_.vanishing.curve.empty())
    mesh_discretised(run_);
  else
    mesh_without_narrow(run_);
  even_out(run_);
}

void MeshRounds::refine(Inspector& inspector) {
  first_curves_ = run_.curves, first_finer_ = run_.finer;
  failed_ = failed_faces(run_.result);
  inspector.inspect(run_);
  inspector.keep();
  while (const std::optional<RefinementRequests> requests = inspector.requests(run_)) {
    if (!mesh_again(*requests)) {
      if (inspector.continues_after_failure()) continue;
      break;
    }
    inspector.inspect(run_);
    const std::ptrdiff_t failed = failed_faces(run_.result);
    if (!inspector.is_better(run_) || failed > failed_) continue;
    failed_ = failed;
    best_.reset();
    inspector.keep();
  }
  restore(inspector.keeps_patches());
  inspector.report(run_);
}

// False: the finer mesh has too many triangles, or the host has no answer for it.
bool MeshRounds::mesh_again(const RefinementRequests& requests) {
  put_aside();
  apply(requests);
  run_.trying = true;
  begin_again(run_);
  bool done = true;
  try {
    mesh();
  } catch (const Cancelled&) {
    throw;
  } catch (const Error&) {
    done = false;
  }
  run_.options.independent = independent_;
  return done;
}

// The mesh of the run is the best so far, or a discarded one.
void MeshRounds::put_aside() {
  run_.known.complete(run_.result);
  CompositeResult before = std::exchange(run_.result, {});
  run_.result.graded = before.graded, run_.result.report = before.report;
  if (best_) {
    spaces_ = std::move(before.spaces);
    run_.known.rely_on(&spaces_, run_.halved);
    return;
  }
  best_.emplace(Kept{std::move(before), run_.curves, run_.cut_curves, run_.finer, run_.layer_cells, run_.remarks});
  run_.known.rely_on(&best_->result.spaces, run_.halved);
}

void MeshRounds::apply(const RefinementRequests& requests) {
  const std::int64_t most = requests.max_triangles;
  run_.options.max_triangles = most > 0 ? std::min(max_triangles_, most) : max_triangles_;
  run_.options.independent = independent_ && !requests.patch_elements;
  if (requests.first_curves) {
    run_.curves = first_curves_, run_.finer = first_finer_;
    return;
  }
  for (const RowLimit& limit : requests.rows) {
    run_.layers.add_limit(limit);
    run_.known.forget(static_cast<std::size_t>(limit.face));
  }
  halve_segments(run_, requests.segments);
  if (run_.finer.size() < requests.sizes.size()) run_.finer.resize(requests.sizes.size());
  for (std::size_t f = 0; f < requests.sizes.size(); ++f)
    run_.finer[f].insert(run_.finer[f].end(), requests.sizes[f].begin(), requests.sizes[f].end());
}

// Gives the run the best mesh with its input, and reports failed faces that no message has named yet.
void MeshRounds::restore(bool keeps_patches) {
  if (!keeps_patches) run_.known.end();
  if (best_) run_.known.clear();  // known are patches of the discarded mesh, without its spaces
  run_.options.max_triangles = max_triangles_;
  if (best_) {
    run_.result = std::move(best_->result);
    run_.curves = std::move(best_->curves), run_.cut_curves = std::move(best_->cut_curves);
    run_.finer = std::move(best_->finer);
    run_.layer_cells = std::move(best_->layer_cells);
    run_.remarks = std::move(best_->remarks);
    best_.reset();
  }
  run_.trying = false;
  for (const FaceMesh& face : run_.result.mesh.faces)
    if (face.status == FaceStatus::failed) run_.report(Level::error, face.why);
}

}  // namespace carreau
