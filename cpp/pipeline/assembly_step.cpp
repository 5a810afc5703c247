// SPDX-License-Identifier: BSD-3-Clause
// The last step: one mesh of all patches, its statuses, narrow faces that vanish.
#include <algorithm>
#include <numeric>
#include <utility>

#include "pipeline/base/run.h"
#include "pipeline/base/thresholds.h"
#include "pipeline/parts/shares.h"
#include "support/format.h"
#include "surface/assembly/assembly.h"
#include "surface/assembly/narrow_collapse.h"
#include "surface/lift/verification.h"

namespace carreau {

namespace {

void reject_degenerate(CompositeRun& run) {
  std::vector<std::string> why(run.patches.size());
  for (std::size_t f = 0; f < run.patches.size(); ++f)
    if (run.patches[f])
      why[f] = degenerate_inside(run.model.faces[f].ref, *run.domains.domain[f], *run.patches[f], run.options.executor.threads,
                                 run.monitor);
  if (run.options.parts) share_sentences(*run.options.executor.team, why);
  for (std::size_t f = 0; f < run.patches.size(); ++f) {
    if (why[f].empty()) continue;
    run.fail(f, why[f]);
    run.patches[f].reset();
    run.keeper[f] = no_process;
  }
}

std::vector<char> faces_with_patches(const CompositeRun& run) {
  std::vector<char> has_patch(run.keeper.size());
  for (std::size_t f = 0; f < has_patch.size(); ++f) has_patch[f] = run.has_patch(f) ? 1 : 0;
  return has_patch;
}

// Vertices at its ends also take the sizes that cut the curve: a corner's size is the mean of directions that differ.
std::vector<double> sizes_along(const DiscreteCurve& curve) {
  std::vector<double> size = curve.size;
  size.front() = curve.sizes.size_at(0);
  size.back() = curve.sizes.size_at(1);
  return size;
}

void keep_prescriptions(CompositeRun& run) {
  CompositeResult& result = run.result;
  for (const DiscreteCurve& curve : run.curves) result.gaps.push_back({curve.gap, curve.gap_use});
  for (std::size_t c = 0; c < run.curves.size(); ++c)
    result.curve_size.push_back(result.mesh.curves[c].vertices.size() > 1 ? sizes_along(run.curves[c])
                                                                          : std::vector<double>{});
  result.interfaces.resize(run.model.faces.size());
  for (std::size_t f = 0; f < result.interfaces.size(); ++f)
    if (std::optional<FaceDomain>& domain = run.domains.domain[f])
      result.interfaces[f] = {std::move(domain->plane), std::move(domain->physical)};
}

void report_narrow(CompositeRun& run) {
  for (const int f : run.narrow.folded) {
    FaceMesh& mesh = run.result.mesh.faces[f];
    mesh.status = FaceStatus::collapsed;
    const std::vector<int>& curves = run.topology.curve_of[static_cast<std::size_t>(f)];
    const bool point = std::all_of(curves.begin(), curves.end(), [&](int c) {
      return run.topology.curves[static_cast<std::size_t>(c)].degenerate;
    });
    mesh.why = Where{.face = mesh.shown_ref()}.prefix() +
               (point ? "the face is a point of space: each of its sides is so short beside the model (a "
                        "hundred-thousandth) that it counts as one"
                      : "the face has no width: its sides are the same curves");
  }
  for (const NarrowFace& face : run.narrow.strips) {
    FaceMesh& mesh = run.result.mesh.faces[face.face];
    mesh.status = FaceStatus::mended;
    mesh.why = Where{.face = mesh.shown_ref()}.prefix() + "the face is narrow (" + format_number(face.width) +
               " where the size is " + format_number(face.size) + "): one layer of triangles";
  }
}

void report_remarks(CompositeRun& run) {
  for (const auto& [f, what] : run.remarks) {
    FaceMesh& mesh = run.result.mesh.faces[f];
    if (mesh.status != FaceStatus::meshed && mesh.status != FaceStatus::mended) continue;
    mesh.status = FaceStatus::mended;
    mesh.why += (mesh.why.empty() ? "" : "; ") + what;
    if (!run.may_lose_rows()) run.report(Level::warning, what);
  }
}

std::vector<FaceCollapse> collapses(CompositeRun& run) {
  std::vector<FaceCollapse> all;
  for (std::size_t i = 0; i < run.between.size(); ++i) {
    const NarrowFace& face = run.narrow.strips[i];
    all.push_back({face.face, face.width, face.size, std::move(run.between[i].one), {}});
  }
  for (const NarrowFace& face : run.narrow.points)
    all.push_back({face.face, face.width, face.size, {}, run.topology.curve_of[face.face]});
  return all;
}

}  // namespace

void assemble_patches(CompositeRun& run) {
  run.show_progress(Phase::assembly, 0, ProgressShares::curves + ProgressShares::patches);
  separate_shared_chords(run);
  reject_degenerate(run);
  run.known.keep_flattened(
      assemble(run.model, run.topology, run.domains, run.curves, faces_with_patches(run), run.patches, run.result));
  if (run.options.parts) run.result.shares = share_out(run);
  keep_prescriptions(run);
  report_narrow(run);
  report_remarks(run);
}

bool collapse_narrow_together(CompositeRun& run) {
  const std::vector<char>& gone = run.narrow.vanishing.curve;
  for (std::size_t c = 0; c < gone.size(); ++c)
    if (gone[c] != 0)
      for (const CurveUse& use : run.topology.curves[c].uses)
        if (run.result.mesh.faces[use.face].status == FaceStatus::failed) return false;
  return collapse_together(collapses(run), run.result);
}

void collapse_narrow_one_by_one(CompositeRun& run) {
  std::vector<FaceCollapse> all = collapses(run);
  for (FaceCollapse& face : all) {  // faces near a point have been meshed
    const FaceMesh& mesh = run.result.mesh.faces[face.face];
    if (!face.one.empty() || mesh.triangles.empty()) continue;
    face.one.emplace_back(mesh.vertex.size());
    std::iota(face.one.front().begin(), face.one.front().end(), 0);
  }
  collapse_one_by_one(all, run.result, run.monitor);
}

}  // namespace carreau
