// SPDX-License-Identifier: BSD-3-Clause
// Sizes that keep a mesh close to a surface: isotropic, or by both principal radii (HDR sec. 2.6, 4.3; RR-2928
// sec. 5.2).
#pragma once

#include <array>
#include <optional>

#include "cad/cad.h"
#include "support/vec.h"

namespace carreau {

enum class GeometricCriterion {
  angle,  ///< A1: angle between mesh and tangent planes
  chord,  ///< A0: distance of mesh and surface
  both,   ///< the smaller of both: a "geometric" mesh (HDR sec. 2.6)
  radii,  ///< RR-2928: proportional to the radii, the larger one cut so that no direction exceeds its own (eq. 41)
};

/// The criterion that keeps a mesh close to the geometry. Lengths are model lengths.
struct GeometricRule {
  GeometricCriterion criterion = GeometricCriterion::angle;
  bool anisotropic = false;
  double angle_deg = 8;  ///< eps1, in ]0, 90]
  double eps0 = 0;       ///< > 0 if the criterion is chord or both
  /// Sizes by the equations are multiplied by these: 1 is the papers' (an edge of unit length fulfils the criterion).
  double angle_factor = 1, chord_factor = 1;
};

/// Size for a smallest radius of curvature `radius` > 0 (may be infinite): HDR eq. 2.31/4.28 (chord, a radius below
/// eps0 counting as eps0), 2.33/4.35 (angle and radii). Not clamped.
double geometric_size(const GeometricRule& rule, double radius) noexcept;

/// Sizes along the directions of the smaller and of the larger principal radius, rho1 <= rho2 (both may be infinite):
/// HDR eq. 4.30/4.34 (chord), 4.40/4.41 (angle); RR-2928 eq. 41, 48, 53-54 (radii). Isotropic rules give the smaller
/// twice. Not clamped; the first is never larger.
std::array<double, 2> geometric_sizes(const GeometricRule& rule, double rho1, double rho2) noexcept;

/// Sizes with their directions.
struct DirectedSizes {
  double h1 = 1, h2 = 1;  ///< h1 <= h2
  Vec3 w1, w2;            ///< unit tangent vectors, orthogonal
};
/// At a jet with first and second derivatives. Infinite if it is flat. Empty if the parametrisation is degenerate.
std::optional<DirectedSizes> geometric_sizes(const GeometricRule& rule, const SurfaceJet& jet) noexcept;

}  // namespace carreau
