// SPDX-License-Identifier: BSD-3-Clause
// The transaction of whole meshes: a remeshed mesh replaces the input mesh, or the input mesh stays.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "cad/cad.h"
#include "mesh/crossings/intersections.h"
#include "support/monitor.h"
#include "surface/remesh/base/cross_patch_mesh.h"
#include "surface/remesh/frame.h"
#include "surface/remesh/lines/line_remeshing.h"
#include "surface/remesh/reassembly.h"
#include "surface/options.h"
#include "surface/result.h"

namespace carreau {

/// The editable mesh and the lines of a frame.
struct StartedMesh {
  std::unique_ptr<CrossPatchMesh> free;
  std::vector<WorkedLine> worked;
};

/// A mesh that may replace the input mesh.
struct Candidate {
  CrossPatchResult made;
  Intersections crossings;
  std::string why;       ///< reason to reject it; empty: it is accepted
  bool crosses = false;  ///< the reason: more triangles cross
};

/// Keeps references to all arguments.
class Replacement {
 public:
  Replacement(RemeshingFrame& frame, Cad& cad, const CompositeOptions& options, CompositeResult& result, Monitor& monitor);

  [[nodiscard]] const SurfaceTolerances& tolerances() const noexcept { return tolerances_; }
  /// The input mesh.
  [[nodiscard]] const CompositeResult& before() const noexcept { return result_; }
  [[nodiscard]] std::vector<WorkedLine> lines() const;
  /// All triangles of the input mesh.
  [[nodiscard]] StartedMesh start() const;

  /// Assembles the triangles that are left, and judges them: no new defect, the same Euler number, no more crossing triangles.
  /// `mesh` is moved from if the frame makes elements of it.
  Candidate judge(StartedMesh& mesh);
  /// Guards the places of the atlas around the crossings of a candidate.
  void guard(const Candidate& candidate);
  /// Replaces the input mesh, with the elements of the frame.
  void accept(Candidate&& candidate);
  /// The same of a mesh without judgement.
  void accept_as_it_is(StartedMesh&& mesh);

 private:
  CrossPatchResult assemble(StartedMesh& mesh) const;
  Intersections find_crossings(const SurfaceMesh& mesh);
  std::int64_t crossings_before();
  void take(CrossPatchResult&& made);

  RemeshingFrame& frame_;
  Cad& cad_;
  const CompositeOptions& options_;
  CompositeResult& result_;
  Monitor& monitor_;
  SurfaceTolerances tolerances_;
  std::int64_t crossings_before_;  // -1: not known yet
};

}  // namespace carreau
