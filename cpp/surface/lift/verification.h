// SPDX-License-Identifier: BSD-3-Clause
// Compares, after the lift, lengths in space with the lengths that the control space promised.
#pragma once

#include <string>
#include <vector>

#include "control_space/control_space.h"
#include "metric/metric2_algebra.h"
#include "size/size_rules.h"
#include "surface/sample/face_sampling.h"

namespace carreau {

/// Returns whether prescribed lengths agree with the control space. `ratios`: prescribed lengths over lengths of the
/// control space. If the space is graded further it may require more.
bool agree(const LengthRatios& ratios, const PatchInput& input) noexcept;

/// Fills mesh.size and mesh.excesses. Returns places in (u, v) that the sampling has missed. There an edge's length in space over the
/// prescribed size disagrees with its length in the control space. The prescribed size is the single size of the model, or the host's
/// answer at the ends (one call a vertex) within the graded field. If sizes come from curvature or from interpolation, the control space
/// around prescribes it. Chords shorter than their arcs do not count as disagreement. Empty on surfaces that the control space represents.
/// At most 500 places. If metrics govern, the prescribed metric is evaluated at each vertex inside and compared with the control space's.
/// Then mesh.size is the size in the mean, sqrt(h1 h2), and mesh.normal is filled.
std::vector<Vec2> verify_lift(const PatchInput& input, const ControlSpace& space, Cad& cad, const SizeRules& rules,
                              PatchMesh& mesh, Monitor& monitor);

/// Returns whether two control spaces differ at one of these places by more than their tolerance explains.
bool differ_at(const std::vector<Vec2>& places, const ControlSpace& before, const ControlSpace& after);

/// Regions that a mesh has missed (ControlSpace::undersampled_regions()).
struct UndersampledRegions {
  /// Regions where the control space is right: the plane mesher gets them.
  std::vector<std::vector<Vec2>> confirmed;
  /// Places of the other regions, where it is wrong: the sampling repeats them.
  std::vector<Vec2> mistaken;
};
/// Evaluates the prescribed metric at one place of each region; at most 500.
UndersampledRegions find_undersampled(const PatchInput& input, const ControlSpace& space, Cad& cad,
                                      const SizeRules& rules, const PatchMesh& mesh, Monitor& monitor);

/// Sides of a domain may shrink to a point, but vertices inside must not coincide in space: their triangles have no
/// area. Returns a sentence with the place; empty if vertices do not coincide.
std::string degenerate_inside(int ref, const FaceDomain& domain, const PatchMesh& mesh, int threads, Monitor& monitor);

}  // namespace carreau
