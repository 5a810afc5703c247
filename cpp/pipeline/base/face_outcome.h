// SPDX-License-Identifier: BSD-3-Clause
// The outcome of one face, made here or by another process. Private to pipeline/.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "control_space/control_space.h"
#include "mesh/layer_cell.h"
#include "support/error.h"
#include "support/ranks/packet.h"
#include "surface/patch.h"

namespace carreau {

/// A patch that one process keeps.
struct PatchElsewhere {
  int rank = 0;
  std::int64_t triangles = 0;
};

struct FaceOutcome {
  std::optional<PatchMesh> patch;          ///< empty: the face failed
  std::vector<LayerCell> layers = {};      ///< their halves are the last triangles of the patch
  std::vector<std::array<Vec3, 3>> turned = {};  ///< triangles beside rows that turn their backs on the surface
  std::optional<PatchElsewhere> elsewhere = {};  ///< set: the patch stays with a process, and is empty for all others
  std::optional<ControlSpace> space;       ///< the metric of the mesh; empty when it could not be sampled
  std::string failure;                     ///< the reason why the domain could not be meshed; empty when it was
  std::string remark;                      ///< a remark on a mesh that was made in another way
  std::optional<LimitError> beyond_limit;  ///< set when it failed because its mesh has too many triangles
  /// Members of CompositeReport.
  double seconds_sampling = 0, seconds_plane = 0, seconds_lift = 0;
  int corrections = 0;

  /// Packs the outcome for another process, and unpacks it. The second throws Error for bytes that are no outcome.
  void put(PacketWriter& packet) const;
  static FaceOutcome from(PacketReader& packet);

  /// Returns the outcome for the other processes of a patch that stays with process `rank`: without patch and control space.
  [[nodiscard]] FaceOutcome without_patch(int rank) const;
};

}  // namespace carreau
