// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room, with their units, their reasons and the tests that support them.
#pragma once

namespace carreau::thresholds::cross_patch {

/// Sizes. If halves of quadrilaterals cross that did not cross before, vertices up to this distance stay when all is made again. The next
/// time the distance doubles.
inline constexpr double held_sizes = 2;
/// Sizes. If elements join in a way that their triangles do not, triangles up to this distance stay when all is made again. The next time
/// the distance doubles. An element reaches over two sizes. [geometry_fuzz triangles 139, 1000019]
inline constexpr double kept_sizes = 1;
/// Times that all is made again, before the last round that only joins triangles; times that triangles around stay, before all triangles
/// stay; times that meshes from isotropic triangles are refined at invalid elements. [geometry_fuzz triangles 139, 1000019]
inline constexpr int max_again = 3;
/// Largest ratio of the number of elements to the number from isotropic triangles. If patches force more elements, their sizes differ from
/// the prescribed sizes, however well the elements are shaped.
inline constexpr double max_of_patches = 1.25;

}  // namespace carreau::thresholds::cross_patch
