// SPDX-License-Identifier: BSD-3-Clause
// First and second fundamental forms of a surface, principal curvatures and directions.
#pragma once

#include <optional>

#include "cad/cad.h"

namespace carreau {

/// E, F, G (RR-2928 eq. 12): squared length of x1 Su + x2 Sv is E x1^2 + 2 F x1 x2 + G x2^2 (eq. 11).
struct FirstForm {
  double e = 0, f = 0, g = 0;
};

/// L, M, N with regard to the unit normal (RR-2928 eq. 31).
struct SecondForm {
  double l = 0, m = 0, n = 0;
};

/// Curvatures are in 1 / model length, positive where the surface bends towards the normal.
struct PrincipalFrame {
  double k1 = 0, k2 = 0;  ///< k1 >= k2
  /// Unit directions in space; (w1, w2, normal) is right-handed (RR-2928 eq. 38). At an umbilic, where every direction
  /// is principal, w1 is along Su.
  Vec3 w1, w2, normal;
  Vec2 x1, x2;  ///< the same directions in the parameter plane: w1 = x1.x Su + x1.y Sv

  [[nodiscard]] double mean() const noexcept { return (k1 + k2) / 2; }
  /// Largest |curvature|, the inverse of the smallest radius.
  [[nodiscard]] double largest() const noexcept;
};

/// From a jet with first derivatives. Any jet.
FirstForm first_form(const SurfaceJet& jet) noexcept;

/// Su x Sv / |Su x Sv| (HDR eq. 4.68). Empty where the parametrisation is degenerate: Su or Sv is zero (or below 1e-12
/// of the other, which is rounding), they are parallel within 1e-10 radian, or a component is not finite.
std::optional<Vec3> unit_normal(const SurfaceJet& jet) noexcept;

/// From a jet with first and second derivatives. Empty where unit_normal is.
std::optional<SecondForm> second_form(const SurfaceJet& jet) noexcept;

/// Principal curvatures and directions from a jet with first and second derivatives (RR-2928 eq. 35-38; HDR sec.
/// 4.4.2): eigenvalues and eigenvectors of a symmetric 2 x 2 matrix in an orthonormal frame of the tangent plane. So
/// neither planes nor umbilics are special. Empty where unit_normal is.
std::optional<PrincipalFrame> principal_frame(const SurfaceJet& jet) noexcept;

/// Curvature of the normal section along x (parameter plane, not zero) (RR-2928 eq. 33). The first form must be
/// positive definite.
double normal_curvature(const FirstForm& first, const SecondForm& second, const Vec2& x) noexcept;

}  // namespace carreau
