// SPDX-License-Identifier: BSD-3-Clause
// Strategies of remeshing in a frame: if triangles cross or shapes become worse, the mesh is made again, and the best
// one counts.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cad/cad.h"
#include "mesh/crossings/intersections.h"
#include "support/monitor.h"
#include "surface/independent/base/free_mesh.h"
#include "surface/independent/independent.h"
#include "surface/independent/line_remeshing.h"
#include "surface/independent/reassembly.h"
#include "surface/options.h"
#include "surface/result.h"

namespace carreau {

/// The shapes of the previous mesh that must not become worse.
enum class KeptShapes : char {
  none,
  worst,           ///< no triangle becomes worse than the worst one was
  worst_and_mean,  ///< and gains of earlier edits pay each loss of shapes
};

/// Weights of lengths and shapes if they conflict (ShapeBudget).
struct Weighing {
  double price;       ///< of an edge that comes into range where triangles span lines; it grows while shapes are kept
  bool weighs_moves;  ///< moves along lines carry the penalty, too; otherwise vertices move wherever lengths become even
  KeptShapes kept;    ///< if the mean is kept, collapses inside carry the penalty, too
};

/// The strategies in their order. `triangles_pass`: ignores the previous shapes of triangles that no mesher made or that other elements are
/// made of.
std::span<const Weighing> weighings(bool triangles_pass, double sharp_angle) noexcept;

/// A free mesh of all triangles, and the lines of the frame.
struct StartedMesh {
  std::unique_ptr<FreeMesh> free;
  std::vector<WorkedLine> worked;
};
StartedMesh start_free_mesh(Cad& cad, const SurfaceTolerances& tolerances, const CompositeResult& result, RemeshingFrame& frame);

/// Reassembles the remaining triangles.
FreedMesh reassembled(const SurfaceMesh& before, StartedMesh&& start, const RemeshingFrame& frame, Monitor& monitor);

/// Finds triangles of a mesh that cross.
Intersections find_crossings(const SurfaceMesh& mesh, const CompositeOptions& options, Monitor& monitor);

/// Finds triangles that cross in a mesh made of `before`, whose crossings may be known: unchanged triangles are not tested again.
Intersections find_crossings(const SurfaceMesh& mesh, const CompositeResult& before, const CompositeOptions& options,
                             Monitor& monitor);

/// Guards the places of the atlas around triangles that cross.
void guard_around(const Intersections& found, const FreedMesh& made, Charts& charts);

/// Returns the reason why a mesh is worse than the mesh that it replaces; empty: it is not. Distinguishes triangles
/// that cross from others.
std::string why_worse(const SurfaceMesh& made, const SurfaceMesh& before, int threads, Monitor& monitor);

/// Keeps references to its arguments.
class Tries {
 public:
  Tries(RemeshingFrame& frame, Cad& cad, const CompositeOptions& options, const CompositeResult& result, Monitor& monitor);

  struct Outcome {
    FreedMesh made;
    Intersections crossings;
    std::string why;       ///< reason not to replace the previous mesh; empty: it is replaced
    bool crosses = false;  ///< because more triangles would cross
  };
  Outcome run();

 private:
  struct Try {
    StartedMesh mesh;
    KeptShapes is_worse_in = KeptShapes::none;  ///< than before
    double in_range = 0;                        ///< share of sides of triangles
    const Weighing* ended = nullptr;            ///< after the first round, since shapes had become worse; null: it is done
  };
  Try make(const Weighing& weighing, bool coarsely);
  Outcome put_together(StartedMesh& mesh);  // the mesh stays unless it becomes other elements
  Outcome certified(StartedMesh& mesh);
  bool remesh_between_lines(StartedMesh& start, const Weighing& weighing, bool coarsely, int first, double least);
  [[nodiscard]] std::int64_t crossings_before();

  RemeshingFrame& frame_;
  Cad& cad_;
  const CompositeOptions& options_;
  const CompositeResult& before_;
  Monitor& monitor_;
  const SurfaceTolerances tolerances_;
  std::int64_t crossings_before_;  // -1: not known yet
};

}  // namespace carreau
