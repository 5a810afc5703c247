// SPDX-License-Identifier: BSD-3-Clause
// The transaction of edits of a mesh, accepted or undone, and its judgement.
#pragma once

#include <algorithm>

#include "mesh/quality.h"
#include "support/infinity.h"

namespace carreau {

/// Undoes all edits since its construction, or since the last accept(). Trials nest, and an inner trial ends before the outer one. Mesh
/// has state(), undo(state), begin_trial() and end_trial().
template <typename Mesh>
class Trial {
 public:
  explicit Trial(Mesh& mesh) : mesh_(mesh), start_(mesh.state()) { mesh.begin_trial(); }
  ~Trial() {
    (void)undo();
    mesh_.end_trial();
  }
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;

  void accept() { start_ = mesh_.state(); }
  /// Returns false if nothing had changed.
  bool undo() { return mesh_.undo(start_); }

 private:
  Mesh& mesh_;
  typename Mesh::State start_;
};

/// Sums of the shapes of some triangles.
struct TriangleShapes {
  double worst = 1;      ///< Q2, in the metric if sizes differ by direction
  double inverses = 0;   ///< sum of 1 / Q2
  double sum = 0;        ///< of Q2
  int count = 0;
  double share = 0;      ///< the largest A0 or A1 over its tolerance, by the normals at the corners; across patches its square

  void add(double quality) noexcept {
    worst = std::min(worst, quality);
    inverses += 1 / std::max(quality, flat_quality);
    sum += quality;
    ++count;
  }
};

/// The triangles that an edit replaces, and the triangles that it makes.
struct Change {
  TriangleShapes before, after;

  /// No triangle is worse than `least` unless a triangle before was as bad.
  [[nodiscard]] bool keeps_shapes(double least) const noexcept { return after.worst >= std::min(before.worst, least); }
  /// No triangle exceeds the tolerances of A0 and A1 unless a triangle before did as much. `most`: largest share.
  [[nodiscard]] bool keeps_surface(double most = 1) const noexcept {
    return after.share < infinity && after.share <= std::max(most, before.share);
  }
};

}  // namespace carreau
