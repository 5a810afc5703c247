// SPDX-License-Identifier: BSD-3-Clause
// Patches of an earlier round of a run: a face with equal input has an equal mesh. Private to pipeline/.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gradation/edge_sizes.h"
#include "pipeline/base/face_outcome.h"
#include "pipeline/base/thresholds.h"
#include "surface/patch.h"
#include "surface/result.h"

namespace carreau {

/// Patches by face. The control spaces stay in the result of the round, and so do the patches until another round follows: most
/// runs have one round, and copies of all patches would be a third of their memory.
class KnownPatches {
 public:
  /// Begins a round; without it nothing is kept.
  void begin(std::size_t faces) { known_.resize(over_ ? 0 : faces); }
  /// Keeps the last input of the face, and its outcome. `grow_from`: the sources of input.limits.edges.
  void keep(std::size_t face, const PatchInput& input, std::vector<EdgeSizes::Source> grow_from);
  void keep(std::size_t face, const FaceOutcome& outcome);
  /// Takes the list of assemble(): numbers of flattened triangles by face.
  void keep_flattened(std::vector<std::vector<std::int32_t>> numbers) { flattened_ = std::move(numbers); }
  /// Copies the kept patches from the assembled mesh of the round, before it changes or goes. Forgets patches that changed between keep()
  /// and the assembly: they have more vertices.
  void complete(const CompositeResult& result);
  /// The control spaces of the round before this one, by face. They may go after that round's patches were found. `halved`: its
  /// elements were cut in two each way, and its spaces describe them.
  void rely_on(const std::vector<std::optional<ControlSpace>>* spaces, bool halved = false) noexcept { spaces_ = spaces, halved_ = halved; }
  /// A copy of the outcome of the round before, if the face had the same input then.
  [[nodiscard]] std::optional<FaceOutcome> find(std::size_t face, const PatchInput& input,
                                                const std::vector<EdgeSizes::Source>& grow_from) const;
  /// The face has other input from now on.
  void forget(std::size_t face) {
    if (face < known_.size()) known_[face].reset();
  }
  void clear() { known_.clear(), flattened_.clear(), spaces_ = nullptr, room_ = thresholds::crossings::max_known; }
  /// Ends the keeping: later rounds mesh with other options.
  void end() { clear(), over_ = true; }

 private:
  struct Known {
    FaceDomain domain;
    std::vector<Vec3> curve_xyz;
    std::vector<EdgeSizes::Source> grow_from;
    std::optional<PatchMesh> mesh;  // empty: the face failed
    bool complete = false;          // else `mesh` has positions and sizes of the domain's vertices alone
    std::size_t vertices = 0, triangles = 0;  // of the whole patch
    std::string remark;
    std::vector<LayerCell> layers;
    std::vector<std::array<Vec3, 3>> turned;
  };
  std::vector<std::optional<Known>> known_;
  std::vector<std::vector<std::int32_t>> flattened_;
  const std::vector<std::optional<ControlSpace>>* spaces_ = nullptr;
  bool halved_ = false;  // of the spaces
  std::size_t room_ = thresholds::crossings::max_known;  // triangles that may still be kept
  bool over_ = false;
};

}  // namespace carreau
