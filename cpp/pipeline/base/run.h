// SPDX-License-Identifier: BSD-3-Clause
// A run over a composite surface: the data that its steps share. Private to pipeline/.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "curve/discrete_curve.h"
#include "gradation/edge_sizes.h"
#include "periodic/parameter_map.h"
#include "periodic/periodic_model.h"
#include "pipeline/base/known_patches.h"
#include "surface/grade/size_grading.h"
#include "surface/layers/layer_curves.h"
#include "surface/narrow/narrow_faces.h"
#include "surface/options.h"
#include "surface/refine/boundary_refinement.h"
#include "surface/result.h"
#include "surface/supports.h"

namespace carreau {

inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// CompositeRun::keeper.
inline constexpr int no_process = -1, all_have = 0;

/// Shares of a run that progress shows: the gradation if there is one, then shares of the rest.
struct ProgressShares {
  static constexpr double gradation = 0.3, curves = 0.1, patches = 0.85;
};

/// The input of a run, the results of its steps so far, and its mesh. Keeps references to the input.
struct CompositeRun {
  CompositeRun(const Model& given_model, const Topology& given_topology, const ModelSupports& given_supports,
               Cad& given_cad, const CompositeOptions& given_options, PeriodicModel given_periodic, Monitor& given_monitor);

  [[nodiscard]] bool isotropic() const noexcept { return !rules.uses_metrics(); }
  [[nodiscard]] double slope() const noexcept { return graded.field ? graded.field->slope() : 0; }
  /// Slope by which sizes grow from short edges, and from triangles that requests make smaller.
  [[nodiscard]] double slope_of_edges() const;
  [[nodiscard]] SizeLimits limits() const noexcept { return {.field = graded.field.get()}; }
  /// Shows progress; `share` counts from the end of the gradation.
  void show_progress(Phase phase, int entity, double share) { monitor.progress(phase, entity, begin + (1 - begin) * share); }
  /// Reports a sentence once; nothing while a mesh may still be discarded.
  void report(Level level, const std::string& what);
  /// Reports that the prescribed edges of a curve stay although a rule requires others.
  void report_kept(int curve, const std::string& what_requires_others);
  /// The patch is here or, if patches stay, with another process.
  [[nodiscard]] bool has_patch(std::size_t face) const { return keeper[face] != no_process; }
  /// The mesh of the face is an image of its master's mesh.
  [[nodiscard]] bool is_slave(std::size_t face) const { return !periodic.empty() && periodic.pair_of_slave[face] >= 0; }
  /// The first mesh has rows that may retreat beside faults, so that its remarks are reported later.
  [[nodiscard]] bool may_lose_rows() const { return !layers.empty() && options.refines_invalid_elements; }
  /// True if an inspector may request a finer mesh.
  [[nodiscard]] bool may_have_rounds() const { return options.crossing_rounds > 0 || options.element != Element::p1; }
  /// From now on each process makes the whole mesh.
  void make_whole();
  /// The face has no mesh; the run continues with the others.
  void fail(std::size_t face, const std::string& why);

  const Model& model;
  const Topology& topology;
  const ModelSupports& supports;
  Cad& cad;
  CompositeOptions options;
  Monitor& monitor;
  SizeRules rules;
  CurveModel curve_model;
  PeriodicModel periodic;                  ///< empty: no periodicity
  std::optional<SlaveSizes> slave_sizes;  ///< joined to the rules
  LayerCurves layers;
  std::vector<std::vector<LayerCell>> layer_cells;  ///< mesh_patches(); MeshLayers::cells
  std::vector<std::vector<std::array<Vec3, 3>>> turned_at_rows;  ///< mesh_patches(); by face, FaceOutcome::turned

  GradedModel graded;                             ///< grade_sizes()
  double begin = 0;                               ///< share of the run that was over before the curves
  std::vector<DiscreteCurve> curves;              ///< discretise_curves(); by curve of the topology
  NarrowModel narrow;                             ///< find_narrow()
  RefinedDomains domains;                         ///< refine_boundaries()
  std::vector<NarrowPatch> between;               ///< the same; of narrow.strips
  std::vector<std::optional<PatchMesh>> patches;  ///< mesh_patches(); by face, empty for one that failed
  /// The process that owns each patch; other processes hold an empty one. all_have: patches are not distributed; no_process: the
  /// patch has no owner.
  std::vector<int> keeper;
  std::map<std::size_t, std::string> remarks;     ///< the same; remarks on faces that were meshed
  std::vector<char> is_known;                     ///< the same; by face, whether it has its patch from the previous round
  bool halved = false;                            ///< an inspector has cut the elements in two each way
  CompositeResult result;                         ///< assemble_patches()
  /// The input of the mesh, which the next round refines: its curves, and by face the sources of sizes inside.
  std::vector<DiscreteCurve> cut_curves;
  std::vector<std::vector<EdgeSizes::Source>> finer;
  std::vector<std::vector<EdgeSizes::Source>> turned;  ///< carry_patches(); by master: triangles whose images are turned over
  KnownPatches known;          ///< mesh_patches(), if rounds may follow
  std::set<std::string> reported;  ///< once, however often something is meshed
  bool trying = false;
};

/// The steps, in their order; composite.cpp and mesh_rounds.cpp call them. Each throws the host's exceptions, LimitError and
/// Cancelled.

/// Grades the prescribed sizes of the whole model if a gradation is given. One size everywhere keeps every gradation.
void grade_sizes(CompositeRun& run);
/// Unit discretisation of every curve, once for all faces.
void discretise_curves(CompositeRun& run);
/// Faces narrower than their triangles, and vertices at the same places on both of their sides.
void find_narrow(CompositeRun& run);
/// Curves are cut until every domain can be meshed. A narrow face that is to stay and cannot be meshed between its
/// sides is one like others, and all is refined again.
void refine_boundaries(CompositeRun& run);
/// Samples, meshes and lifts every face, on several threads.
void mesh_patches(CompositeRun& run);
/// Sizes of curves; members of classes have the least of their sizes.
[[nodiscard]] std::vector<SizeSamples> shared_sizes(CompositeRun& run);
/// Fails the partners of periodic faces that have failed or have no domain.
void fail_partners(CompositeRun& run);
/// Makes the patches of slaves as images of the patches of their masters. Both fail if one does.
void carry_patches(CompositeRun& run);
/// Divides chords that faces share; pairs stay images of each other.
void separate_shared_chords(CompositeRun& run);
/// Lists the pairs of vertices of the mesh, and reports how far they are apart.
void link_periodic(CompositeRun& run, bool reports = true);
/// Makes one mesh of all patches, with statuses and sentences of its faces.
void assemble_patches(CompositeRun& run);
/// Lets all narrow faces vanish. False, and nothing done, if one cannot.
[[nodiscard]] bool collapse_narrow_together(CompositeRun& run);
/// Lets as many narrow faces vanish as can, after all faces were meshed with their end caps.
void collapse_narrow_one_by_one(CompositeRun& run);

}  // namespace carreau
