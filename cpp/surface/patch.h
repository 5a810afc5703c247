// SPDX-License-Identifier: BSD-3-Clause
// One patch: its input, and its mesh.
#pragma once

#include <optional>
#include <vector>

#include "control_space/control_space.h"
#include "gradation/graded_field.h"
#include "mesh/plane_mesh.h"
#include "size/size_rules.h"
#include "support/ranks/executor.h"
#include "surface/domain/domain_builder.h"

namespace carreau {

/// The data that a face's sizes are interpolated from if the host does not answer.
struct FaceInterfaces {
  PlaneDomain plane;
  std::vector<double> physical;  ///< physical size at each vertex of the domain; 0 at imposed points
};

/// An edge inside a patch: its length in space over the length in the control space, and its ends in (u, v).
struct EdgeExcess {
  double ratio = 0;
  Vec2 from, to;
};

/// A meshed patch. The vertices of the domain come first, unmoved, then new ones.
struct PatchMesh {
  PlaneMesh plane;
  std::vector<Vec3> xyz;     ///< position in space of every vertex of `plane`
  std::vector<double> size;  ///< prescribed size at every vertex
  /// Edges a thousand times as long as in the control space: derivatives vanish there, or the surface jumps.
  std::vector<EdgeExcess> excesses;
  /// If metrics govern: unit normal of the surface at every vertex that is not imposed, zero at singular ones.
  std::vector<Vec3> normal;
};

/// The input for meshing a patch.
struct PatchInput {
  int face = 0;  ///< index in Model::faces
  int ref = 0;   ///< its reference
  const FaceDomain* domain = nullptr;
  /// Position in space of each vertex of the domain that lies on a curve; imposed points are evaluated.
  std::vector<Vec3> curve_xyz;
  /// Set when one size is prescribed everywhere (SizeRules::constant).
  std::optional<double> constant_size = {};
  /// S(u, v) = (u, v, 0): lengths in the plane are lengths in space.
  bool is_plane = false;
  /// Sizes do not differ by direction: triangles may be judged by their shape in space.
  bool isotropic = true;
  /// No sample has shown a metric with directions (SampledFacts).
  bool one_size = true;
  /// Limits of the prescribed sizes.
  SizeLimits limits = {};
  /// Largest derivative of sizes along the surface, kept in the control space too; 0: any.
  double slope = 0;
  /// Largest relative error of lengths in the control space.
  double tolerance = ControlSpaceOptions{}.tolerance;
  Executor executor = {};  ///< at work on this patch
  int host_threads = 1;    ///< the threads of this process that may call the host
};

/// The boundary of a domain.
SampledDomain sampled_domain(const PlaneDomain& domain);

}  // namespace carreau
