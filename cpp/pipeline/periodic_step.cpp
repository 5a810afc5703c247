// SPDX-License-Identifier: BSD-3-Clause
// Periodic faces: meshes of slaves are images of meshes of masters.
#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "periodic/shared_curves.h"
#include "pipeline/base/run.h"
#include "support/format.h"
#include "surface/assembly/shared_chords.h"
#include "surface/carry/carry_patch.h"

namespace carreau {

namespace {

// Rounds in which chords that faces share are divided on both faces of a pair.
constexpr int max_chord_rounds = 4;

using Triangles = std::vector<std::array<std::int32_t, 3>>;

std::string partner_failed(const CompositeRun& run, int face, int partner) {
  const FaceMesh& failed = run.result.mesh.faces[partner];
  return Where{.face = run.model.faces[face].ref}.prefix() + "its periodic partner, face " + std::to_string(run.model.faces[partner].ref) +
         ", failed: " + (failed.why.empty() ? run.domains.failure[partner] : failed.why);
}

// Rounds may mend the pair: the last one reports what stays.
void drop_patch(CompositeRun& run, int face, const std::string& why) {
  FaceMesh& mesh = run.result.mesh.faces[face];
  if (mesh.status != FaceStatus::failed) {
    mesh.status = FaceStatus::failed;
    mesh.why = why;
    if (run.options.crossing_rounds == 0) run.report(Level::error, why);
  }
  run.patches[face].reset();
  run.keeper[face] = no_process;
}

FacePair inverse_of(const FacePair& pair) {
  FacePair back{pair.slave, pair.master, pair.map.inverse()};
  for (const auto& [curve, image] : pair.curves) back.curves.emplace(image.curve, inverse(curve, image));
  return back;
}

CarriedPatch carry(const CompositeRun& run, const FacePair& pair) {
  return carry_patch(run.curve_model, run.curves, pair, *run.domains.domain[pair.master], *run.domains.domain[pair.slave],
                     *run.patches[pair.master], run.periodic.gap);
}

void keep_sources(CompositeRun& run, int face, std::vector<EdgeSizes::Source> finer) {
  if (finer.empty()) return;
  run.turned.resize(run.model.faces.size());
  std::vector<EdgeSizes::Source>& all = run.turned[face];
  all.insert(all.end(), finer.begin(), finer.end());
}

void fail_pair(CompositeRun& run, const FacePair& pair, const std::string& why) {
  drop_patch(run, pair.slave, Where{.face = run.model.faces[pair.slave].ref}.prefix() + why);
  drop_patch(run, pair.master, partner_failed(run, pair.master, pair.slave));
}

}  // namespace

void fail_partners(CompositeRun& run) {
  // A master has a mesh exactly if all its slaves have meshes.
  for (int round = 0; round < 2; ++round)
    for (const FacePair& pair : run.periodic.pairs)
      for (const auto& [face, partner] : {std::pair(pair.slave, pair.master), std::pair(pair.master, pair.slave)}) {
        const bool gone = !run.domains.domain[partner] || run.result.mesh.faces[partner].status == FaceStatus::failed;
        if (!gone || run.result.mesh.faces[face].status == FaceStatus::failed) continue;
        drop_patch(run, face, partner_failed(run, face, partner));
        run.domains.domain[face].reset();
      }
}

std::vector<SizeSamples> shared_sizes(CompositeRun& run) {
  std::vector<SizeSamples> sizes = run.graded.curves;
  if (sizes.empty()) {
    sizes.resize(run.topology.curves.size());
    for (std::size_t c = 0; c < sizes.size(); ++c)
      if (run.periodic.has_class[c] != 0)
        sizes[c] = sample_sizes(run.curve_model, static_cast<int>(c), run.rules, {.lss = run.options.lss});
  }
  share_sizes(run.periodic, run.curve_model, sizes);
  return sizes;
}

void carry_patches(CompositeRun& run) {
  run.turned.clear();
  fail_partners(run);
  std::vector<std::string> why(run.model.faces.size());
  for (FacePair& pair : run.periodic.pairs) {
    if (!run.has_patch(pair.master)) continue;
    run.monitor.checkpoint();
    run.keeper[pair.slave] = run.keeper[pair.master];
    CarriedPatch carried = carry(run, pair);
    why[pair.slave] = carried.failure;
    pair.flipped = carried.flipped;
    keep_sources(run, pair.master, std::move(carried.finer));
    run.patches[pair.slave] = std::move(carried.mesh);
  }
  for (const FacePair& pair : run.periodic.pairs)
    if (!why[pair.slave].empty()) fail_pair(run, pair, why[pair.slave]);
  fail_partners(run);
}

// A chord that is divided on one face of a pair is divided on the other one.
void separate_shared_chords(CompositeRun& run) {
  const auto separate = [&] {
    separate_chords(run.model, run.topology, run.domains, run.curves, run.cad, run.patches, run.options.executor.shared_if(run.options.parts), run.monitor);
  };
  if (run.periodic.empty()) return separate();
  for (int round = 0; round < max_chord_rounds; ++round) {
    std::vector<Triangles> before(run.patches.size());
    for (std::size_t f = 0; f < before.size(); ++f)
      if (run.periodic.is_periodic[f] != 0 && run.patches[f]) before[f] = run.patches[f]->plane.triangles;
    separate();
    const auto changed = [&](int face) { return run.patches[face] && run.patches[face]->plane.triangles != before[face]; };
    bool any = false;
    for (const FacePair& pair : run.periodic.pairs) {
      if (!changed(pair.slave) || changed(pair.master)) continue;
      CarriedPatch back = carry(run, inverse_of(pair));
      if (back.failure.empty()) run.patches[pair.master] = std::move(back.mesh);
    }
    for (const FacePair& pair : run.periodic.pairs) {
      if (!changed(pair.master)) continue;
      CarriedPatch carried = carry(run, pair);
      if (carried.failure.empty()) run.patches[pair.slave] = std::move(carried.mesh);
      any = true;
    }
    if (!any) return;
  }
}

}  // namespace carreau
