// SPDX-License-Identifier: BSD-3-Clause
// The solvent excluded surface as faces, curves and points (HDR sec. 4.6.2).
#pragma once

#include "geometry/molecule/molecule.h"

namespace carreau::molecule {

/// Areas of the parts of the surface, and the volume that it encloses.
struct ExcludedMeasures {
  double convex = 0, torus = 0, concave = 0, volume = 0;
  std::vector<double> ball_area;  ///< [ball]: of its convex parts
  /// [ball]: its share of torus parts, and a third of each part of a probe that touches three. The torus part's share
  /// is on the ball's side of the plane of the probe's centres, where the power distances from both grown balls are
  /// equal.
  std::vector<double> ball_torus, ball_concave;
};

/// `a`: of the grown balls. `kept`: [component]. Faces are convex parts, by ball and with the references of
/// build_surface(); then torus parts, by arc; then parts of probes, by vertex. `measures` has all, kept or not.
BuiltGeometry build_excluded(const Molecule& molecule, const Arrangement& a, double probe,
                             const std::vector<char>& kept, ExcludedMeasures& measures);

}  // namespace carreau::molecule
