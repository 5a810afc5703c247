// SPDX-License-Identifier: BSD-3-Clause
// A piece of a plane spline, f(t) = a0 + a1 t + a2 t^2 + a3 t^3 on [0, 1]: RR-2818 sec. 3.3-3.7.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "support/vec.h"

namespace carreau {

/// Coefficients of powers of t. Lengths are in the plane's unit; t has no unit.
struct CubicPiece {
  std::array<Vec2, 4> a;

  [[nodiscard]] Vec2 at(double t) const noexcept { return a[0] + t * (a[1] + t * (a[2] + t * a[3])); }
  [[nodiscard]] Vec2 first(double t) const noexcept { return a[1] + t * (2 * a[2] + 3 * t * a[3]); }
  [[nodiscard]] Vec2 second(double t) const noexcept { return 2 * a[2] + 6 * t * a[3]; }
};

/// The piece from `b` to `c` with the derivatives that are given there (RR-2818 sec. 3.3). Without one of them it is a
/// parabola, without both a segment.
CubicPiece piece_between(const Vec2& b, const Vec2& c, const std::optional<Vec2>& tangent_b,
                         const std::optional<Vec2>& tangent_c) noexcept;

/// A point that a piece passes twice, f(t1) = f(t2).
struct PieceLoop {
  double t1 = 0, t2 = 1;  ///< 0 <= t1 < t2 <= 1
  Vec2 at;
};

/// RR-2818 sec. 3.6. A piece whose ends coincide has a loop, too. Empty: none.
std::optional<PieceLoop> loop_of(const CubicPiece& piece) noexcept;

/// The parameter inside the piece at which the derivative vanishes: a cusp, at which the two parameters of a loop are
/// one (S^2 = 4 P). Empty: no.
std::optional<double> cusp_of(const CubicPiece& piece) noexcept;

/// Returns whether the piece turns back along its own chord: the shapes d and e of RR-2818 fig. 8, which wrong control
/// points often cause. A piece without a chord does.
bool turns_back(const CubicPiece& piece) noexcept;

/// Parameters strictly inside (0, 1), ascending, of a polyline whose edges of length d keep each point of their arc
/// within `eps` d (RR-2818 sec. 3.7). eps > 0, else InvalidArgument.
std::vector<double> subdivide(const CubicPiece& piece, double eps);

}  // namespace carreau
