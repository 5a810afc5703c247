// SPDX-License-Identifier: BSD-3-Clause
// Steps of a given length along a surface.
#pragma once

#include <functional>

#include "cad/cad.h"

namespace carreau {

/// The plane through `base` that `across` is normal to: columns stay in it.
struct ColumnPlane {
  Vec3 base, across;
};

/// (u, v) of a vector, which is projected onto the tangent plane; zero where the parametrisation is degenerate.
Vec2 in_parameters(const SurfaceJet& jet, const Vec3& v);

/// Finds the place of a surface at distance `step` from p in the plane, by Newton's method from `at`. Leaves the place and its
/// first derivatives. Returns false if a step leaves the domain or the errors stay large.
bool find_step(Cad& cad, int face, const ColumnPlane& plane, const Vec3& p, double step,
               const std::function<bool(const Vec2&)>& is_inside, Vec2& at, SurfaceJet& jet);

}  // namespace carreau
