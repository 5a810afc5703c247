// SPDX-License-Identifier: BSD-3-Clause
// Inspectors look at the assembled mesh and return requests for a finer one. Inspectors never mesh. Private to
// pipeline/.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "gradation/edge_sizes.h"
#include "pipeline/base/run.h"

namespace carreau {

/// Changes to the input of the next round.
struct RefinementRequests {
  /// Edges to halve: {curve, segment} of CompositeRun::cut_curves, ascending, each once.
  std::vector<std::pair<std::int32_t, int>> segments = {};
  std::vector<std::vector<EdgeSizes::Source>> sizes = {};  ///< by face; may be shorter than the list of faces
  std::vector<RowLimit> rows = {};  ///< of layers
  std::int64_t max_triangles = 0;                     ///< of the next mesh; 0: as many as the run allows
  bool first_curves = false;     ///< the round begins with the curves and sizes of the first mesh, without other refinement
  bool patch_elements = false;   ///< patches place their vertices for quadrilaterals, and the mesh keeps them
};

/// One kind of fault that a finer mesh can repair.
class Inspector {
 public:
  virtual ~Inspector() = default;

  /// Inspects the mesh of the run, and makes its elements if the inspector judges elements. Throws Cancelled.
  virtual void inspect(CompositeRun& run) = 0;
  /// Compares the inspected mesh with the kept one.
  [[nodiscard]] virtual bool is_better(const CompositeRun& run) const = 0;
  /// The inspected mesh is the kept one from now on.
  virtual void keep() = 0;
  /// Requests for the next round, from the last inspected mesh. Empty: the rounds are over.
  [[nodiscard]] virtual std::optional<RefinementRequests> requests(const CompositeRun& run) = 0;
  /// The mesh that the last requests describe could not be made. Gives whether other requests may follow.
  [[nodiscard]] virtual bool continues_after_failure() { return false; }
  /// Later inspectors find the patches and control spaces as the rounds made them: faces that do not change keep theirs.
  [[nodiscard]] virtual bool keeps_patches() const { return false; }
  /// Writes the findings on the kept mesh into the result, and reports them.
  virtual void report(CompositeRun& run) = 0;
};

/// Images of periodic faces that are turned over in (u, v).
[[nodiscard]] std::unique_ptr<Inspector> make_periodic_inspector();
/// Triangles that cross although their faces are apart.
[[nodiscard]] std::unique_ptr<Inspector> make_crossing_inspector();
/// Elements of meshes that keep the borders of their patches; invalid ones are divided. With layers, rows retreat from
/// invalid, crossing and turned elements, whose work is bounded like the work for crossings.
[[nodiscard]] std::unique_ptr<Inspector> make_element_inspector();
/// Frees the mesh of the borders of its patches and makes its elements; invalid and crossing ones are divided.
[[nodiscard]] std::unique_ptr<Inspector> make_cross_patch_inspector();

}  // namespace carreau
