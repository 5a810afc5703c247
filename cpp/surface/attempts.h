// SPDX-License-Identifier: BSD-3-Clause
// Meshing again what smaller triangles may mend: the best mesh stays. Private to surface/.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "surface/run.h"

namespace carreau {

/// Meshes of one run, one after the other; the first is there already. Keeps references to both.
class Attempts {
 public:
  Attempts(CompositeRun& run, const std::function<void()>& mesh_again);

  /// `make_finer` changes what the next mesh is made of (curves, run.finer) and still sees the mesh of now. False where
  /// smaller triangles ask for too many, or for what the host has no answer to: then finish(). Throws Cancelled.
  [[nodiscard]] bool again(const std::function<void()>& make_finer);
  /// After again(). The mesh of now is the best one if it is better in what it was made for, and no more faces failed.
  /// Gives whether it is.
  bool keep_if(bool better);
  /// Gives the run the best mesh with its curves and what its sizes grew from, and says what an earlier one has not told.
  void finish();

 private:
  CompositeRun& run_;
  const std::function<void()>& mesh_again_;
  std::ptrdiff_t failed_;                // faces of the best mesh
  std::optional<CompositeResult> best_;  // empty: that of the run
  std::vector<DiscreteCurve> curves_, cut_curves_;  // of best_
  std::vector<std::vector<EdgeSizes::Source>> finer_;  // of best_
  std::vector<std::optional<ControlSpace>> spaces_;  // of a mesh that was given up, for what the next one has of it
};

}  // namespace carreau
