// SPDX-License-Identifier: BSD-3-Clause
// The last step: edits until upper bounds of all triangles of a cross-patch mesh are within tolerances.
#pragma once

#include <cstdint>
#include <memory>

#include "support/monitor.h"
#include "surface/remesh/base/cross_patch_mesh.h"
#include "surface/remesh/division/divided_remeshing.h"

namespace carreau {

struct Certification {
  std::int64_t beyond_before = 0, beyond = 0;  ///< triangles whose bound of A0 or A1 exceeds its tolerance
  std::int64_t swaps = 0, moves = 0, splits = 0;

  [[nodiscard]] bool has_edits() const noexcept { return swaps + moves + splits > 0; }
};

/// Bounds A0 and A1 of triangles, and edits the mesh where triangles are beyond their tolerances. Keeps a reference to `mesh`. Threads
/// bound triangles, one edits.
class Certifier {
 public:
  /// `all`: bounds also triangles that the normals at their corners do not make suspect.
  Certifier(CrossPatchMesh& mesh, bool all, const RemeshingWorkers& workers, Monitor& monitor);
  ~Certifier();
  Certifier(const Certifier&) = delete;
  Certifier& operator=(const Certifier&) = delete;

  /// Swaps edges, moves vertices and splits edges around each group of such triangles. Undoes edits that have not brought the group nearer
  /// to its tolerances. Shapes stay fair, no triangle turns over, and edges become no shorter than a share of the size. Guarded places of
  /// the atlas stay. Deterministic. Throws the exceptions of the host, and Cancelled.
  Certification run();
  /// Undoes all edits. run() may follow after other places are guarded.
  void undo();
  /// Keeps all of it; otherwise the destructor undoes it.
  void accept();

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

}  // namespace carreau
