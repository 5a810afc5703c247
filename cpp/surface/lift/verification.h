// SPDX-License-Identifier: BSD-3-Clause
// After the lift: do lengths in space agree with those that the control space promised?
#pragma once

#include <string>
#include <vector>

#include "control_space/control_space.h"
#include "metric/metric2_algebra.h"
#include "size/size_rules.h"
#include "surface/sample/face_sampling.h"

namespace carreau {

/// Whether what is prescribed is what the control space says, `ratios` being lengths of the former over those of the
/// latter. Where the space is graded further it may ask for more.
bool agree(const LengthRatios& ratios, const PatchInput& input) noexcept;

/// Fills mesh.size and mesh.excesses and returns places in (u, v) where an edge's length in space over the prescribed
/// size disagrees with its length in the control space: the sampling has missed something there. The prescribed size is
/// the one size of the model, or what the host answers at the ends (asked once a vertex) within the graded field, or,
/// where sizes come from curvature or from interpolation, what the control space says around. Chords shorter than their
/// arcs are no disagreement. Empty on surfaces that the control space knows. At most 500 places. Where metrics govern,
/// the prescribed metric is evaluated at each vertex inside and compared with the control space's; mesh.size is then
/// the size in the mean, sqrt(h1 h2), and mesh.normal is filled. `team`: whose processes share all that; null: this one alone.
std::vector<Vec2> verify_lift(const PatchInput& input, const ControlSpace& space, Cad& cad, const SizeRules& rules,
                              PatchMesh& mesh, Monitor& monitor, Team* team = nullptr);

/// Whether two control spaces differ at one of these places by more than their tolerance explains.
bool differ_at(const std::vector<Vec2>& places, const ControlSpace& before, const ControlSpace& after);

/// What a mesh has missed (ControlSpace::undersampled_regions()).
struct UndersampledRegions {
  /// Those where the control space is right: to be handed to the plane mesher.
  std::vector<std::vector<Vec2>> confirmed;
  /// The places of others, where it is not: to be sampled again.
  std::vector<Vec2> mistaken;
};
/// Asks the prescribed metric at one place of each region; at most 500.
UndersampledRegions find_undersampled(const PatchInput& input, const ControlSpace& space, Cad& cad,
                                      const SizeRules& rules, const PatchMesh& mesh, Monitor& monitor);

/// Sides of a domain may shrink to a point, places inside may not: where vertices inside coincide in space, triangles
/// have no area. The sentence that says where; empty when there is no such place.
std::string degenerate_inside(int ref, const FaceDomain& domain, const PatchMesh& mesh, int threads, Monitor& monitor);

}  // namespace carreau
