// SPDX-License-Identifier: BSD-3-Clause
// Least width of narrow zones of each face, relative to their edges. Private to surface/.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "curve/discrete_curve.h"
#include "surface/domain/domain_builder.h"
#include "surface/options.h"

namespace carreau {

/// CoefRectangle of each face. When narrow faces are to collapse, a strip whose curves all belong to it alone cannot,
/// since the face would disappear. Its edges are cut until its triangles have a good shape, since short edges spoil no
/// face beside it. Segments shorter than a size divided by the length of the strip in sizes stay. A needle thus gets at
/// most twice the triangles of a square of its length, and may be cut up to its tips.
class FaceCloseness {
 public:
  /// Evaluates derivatives at some places of faces without neighbours. `domains`: the faces to consider; empty domains
  /// are passed over.
  FaceCloseness(const CurveModel& model, const std::vector<DiscreteCurve>& curves,
                std::span<const std::optional<FaceDomain>> domains, const CompositeOptions& options);

  [[nodiscard]] double coefficient(int face) const { return faces_[face].coefficient; }
  /// Returns whether segments that are short enough stay.
  [[nodiscard]] bool is_bounded(int face) const { return faces_[face].finest > 0; }
  /// Returns whether a segment is so short that it is not halved.
  [[nodiscard]] bool is_fine(int face, const DiscreteCurve& curve, int segment) const;

 private:
  struct OfFace {
    double coefficient = 0;
    double finest = 0;  // segments no longer than that stay, in sizes
  };
  const CurveModel& model_;
  std::vector<OfFace> faces_;
};

}  // namespace carreau
