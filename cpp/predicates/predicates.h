// Exact signs. No other room of the engine compares a determinant with zero to decide a topology.
#pragma once

#include "support/vec.h"

namespace carreau {

/// Sign of the area of (a, b, c): +1 counterclockwise, -1 clockwise, 0 collinear. Exact for all finite doubles
/// whose products neither overflow nor underflow.
int orientation(Vec2 a, Vec2 b, Vec2 c) noexcept;

/// +1 when d lies inside the circle through a, b, c (counterclockwise), -1 outside, 0 on it. Exact.
int in_circle(Vec2 a, Vec2 b, Vec2 c, Vec2 d) noexcept;

}  // namespace carreau
