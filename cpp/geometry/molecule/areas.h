// SPDX-License-Identifier: BSD-3-Clause
// Areas and volumes in closed form.
#pragma once

#include <vector>

#include "geometry/molecule/arrangement.h"

namespace carreau::molecule {

/// Area of an exposed part of a sphere, by the theorem of Gauss and Bonnet.
double area_of(const Arrangement& arrangement, const Component& component);

/// Integral of the outward normal over an exposed part: half the integral of x cross dx along its border.
Vec3 vector_area(const Arrangement& arrangement, const Component& component);

/// Measures of the boundary of a union of balls.
struct UnionMeasures {
  double area = 0, volume = 0;
  std::vector<double> ball_area;       ///< [ball]
  std::vector<double> component_area;  ///< [component]
  std::vector<int> shell;              ///< [component]: connected parts of the boundary, from 0
  std::vector<double> shell_volume;    ///< [shell]; negative: the shell bounds a cavity
};
UnionMeasures measure(const Arrangement& arrangement);

}  // namespace carreau::molecule
