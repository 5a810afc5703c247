// SPDX-License-Identifier: BSD-3-Clause
// The loop of a run: mesh, inspect, refine, and mesh again or end. Private to pipeline/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/base/inspector.h"
#include "pipeline/base/run.h"

namespace carreau {

/// The meshes of one run, one after the other. Keeps a reference to the run.
class MeshRounds {
 public:
  /// The run has its curves and its narrow faces.
  explicit MeshRounds(CompositeRun& run);

  /// Makes the first mesh.
  void mesh_first() { mesh(); }
  /// Inspects the mesh and makes finer ones while the inspector requests them. The best mesh stays. A round that fails more faces
  /// than the best mesh is never kept.
  void refine(Inspector& inspector);

 private:
  /// A mesh, and the input that it was made of.
  struct Kept {
    CompositeResult result;
    std::vector<DiscreteCurve> curves, cut_curves;
    std::vector<std::vector<EdgeSizes::Source>> finer;
    std::vector<std::vector<LayerCell>> layer_cells;
    std::map<std::size_t, std::string> remarks;
  };

  void mesh();
  [[nodiscard]] bool mesh_again(const RefinementRequests& requests);
  void put_aside();
  void apply(const RefinementRequests& requests);
  void restore(bool keeps_patches);

  CompositeRun& run_;
  const NarrowModel narrow_;
  const std::int64_t max_triangles_;
  const bool independent_;
  std::vector<DiscreteCurve> first_curves_;                  // at the start of refine()
  std::vector<std::vector<EdgeSizes::Source>> first_finer_;  // the same
  std::ptrdiff_t failed_ = 0;                                // faces of the best mesh
  std::optional<Kept> best_;                                 // empty: the mesh of the run is the best
  std::vector<std::optional<ControlSpace>> spaces_;  // of a discarded mesh, for the faces that the next round leaves as they are
};

}  // namespace carreau
