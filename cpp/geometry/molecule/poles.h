// SPDX-License-Identifier: BSD-3-Clause
// Centres from which exposed parts of spheres are projected.
#pragma once

#include "geometry/molecule/arrangement.h"

namespace carreau::molecule {

/// A direction from a component's ball deep into the removed part of its sphere. Candidates are the directions of the
/// balls that bound the component, sums of two of them, and the direction opposite the component. The pole is the
/// candidate farthest from the border. The component has a loop.
struct Pole {
  Vec3 direction;
  double depth = 0;  ///< angle to the border, from samples of the arcs
};
Pole find_pole(const Arrangement& arrangement, const Component& component);

}  // namespace carreau::molecule
