// SPDX-License-Identifier: BSD-3-Clause
// At last: no triangle of a free mesh is farther from the surface than is tolerated, by upper bounds.
#pragma once

#include <cstdint>
#include <memory>

#include "support/monitor.h"
#include "surface/independent/base/free_mesh.h"
#include "surface/independent/division/divided_remeshing.h"

namespace carreau {

struct Certification {
  std::int64_t beyond_before = 0, beyond = 0;  ///< triangles whose bound of A0 or A1 exceeds its tolerance
  std::int64_t swaps = 0, moves = 0, splits = 0;

  [[nodiscard]] bool has_edits() const noexcept { return swaps + moves + splits > 0; }
};

/// Bounds A0 and A1 of triangles, and works where some are beyond their tolerances. Keeps a reference to `mesh`. Threads bound triangles, one edits.
class Certifier {
 public:
  /// `all`: of triangles that none of the normals at their corners makes suspect, too.
  Certifier(FreeMesh& mesh, bool all, const RemeshingWorkers& workers, Monitor& monitor);
  ~Certifier();
  Certifier(const Certifier&) = delete;
  Certifier& operator=(const Certifier&) = delete;

  /// Swaps edges, moves vertices and splits edges around each group of such triangles, and undoes what has not brought the group nearer to its tolerances. Shapes
  /// stay fair, no triangle turns over, edges become no shorter than a share of the size, and nothing is done where the atlas is guarded. Deterministic. Throws
  /// what the host throws, and Cancelled.
  Certification run();
  /// Undoes all of it: run() may follow, where other places are guarded.
  void undo();
  /// Keeps all of it; otherwise the destructor undoes it.
  void accept();

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

}  // namespace carreau
