// SPDX-License-Identifier: BSD-3-Clause
// From where an exposed part of a sphere is projected.
#pragma once

#include "geometry/molecule/arrangement.h"

namespace carreau::molecule {

/// A direction from a component's ball into what is cut away, deep in it: of the directions of the balls that bound the
/// component, of the sums of two and of the one opposite the component, that which is farthest from its border. The
/// component has a loop.
struct Pole {
  Vec3 direction;
  double depth = 0;  ///< angle to the border, as samples of the arcs tell
};
Pole find_pole(const Arrangement& arrangement, const Component& component);

}  // namespace carreau::molecule
