// SPDX-License-Identifier: BSD-3-Clause
// Patches of an earlier round of a run: a face that is asked the same gets the same mesh, which need not be made again.
// Private to surface/.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "gradation/edge_sizes.h"
#include "pipeline/base/face_outcome.h"
#include "pipeline/base/thresholds.h"
#include "surface/patch.h"

namespace carreau {

/// By face. The control spaces stay in the result of the round.
class KnownPatches {
 public:
  /// For every round; without it nothing is kept.
  void begin(std::size_t faces) { known_.resize(over_ ? 0 : faces); }
  /// What the face was asked last, and what came of it. `grow_from`: what input.limits.edges was made of.
  void keep(std::size_t face, const PatchInput& input, std::vector<EdgeSizes::Source> grow_from);
  void keep(std::size_t face, const FaceOutcome& outcome);
  /// The control spaces of the round before this one, by face. They may go after that round's patches were asked for.
  void rely_on(const std::vector<std::optional<ControlSpace>>* spaces) noexcept { spaces_ = spaces; }
  /// What came of the face in the round before, when it was asked the same then; a copy.
  [[nodiscard]] std::optional<FaceOutcome> find(std::size_t face, const PatchInput& input,
                                                const std::vector<EdgeSizes::Source>& grow_from) const;
  void clear() { known_.clear(), spaces_ = nullptr, room_ = thresholds::crossings::most_known; }
  /// Later rounds are others: nothing is kept any more.
  void end() { clear(), over_ = true; }

 private:
  struct Known {
    FaceDomain domain;
    std::vector<Vec3> curve_xyz;
    std::vector<EdgeSizes::Source> grow_from;
    std::optional<PatchMesh> mesh;  // empty: the face failed
    std::string remark;
  };
  std::vector<std::optional<Known>> known_;
  const std::vector<std::optional<ControlSpace>>* spaces_ = nullptr;
  std::size_t room_ = thresholds::crossings::most_known;  // triangles that may still be kept
  bool over_ = false;
};

}  // namespace carreau
