// SPDX-License-Identifier: BSD-3-Clause
// Places of a surface of several faces, and the way from one to another.
#pragma once

#include <cstdint>

#include "metric/metric3.h"
#include "support/vec.h"

namespace carreau {

/// A place of the surface: (u, v) in the face of a triangle of the atlas which holds it.
struct Foot {
  std::int32_t triangle = -1;
  Vec2 uv;
};

/// The surface at a place of the atlas.
struct SurfacePlace {
  Foot foot;
  Vec3 xyz, su, sv;
  Vec3 normal;           ///< unit, on the side that the atlas has turned to; zero where singular
  bool regular = false;  ///< there is a normal
};

/// The prescribed size at a vertex.
struct WantedSize {
  double h = 0;    ///< sqrt(h1 h2) where sizes differ by direction
  Metric3 metric;  ///< used where they do; at a vertex that is not kept it has no entry along the normal
};

/// Returns the size times the factor.
inline WantedSize scaled(const WantedSize& wanted, double factor) noexcept {
  WantedSize result = wanted;
  result.h *= factor;
  const double k = 1 / (factor * factor);
  Metric3& m = result.metric;
  for (double* entry : {&m.xx, &m.xy, &m.xz, &m.yy, &m.yz, &m.zz}) *entry *= k;
  return result;
}

}  // namespace carreau
