// SPDX-License-Identifier: BSD-3-Clause
// Shapes of triangles and quadrilaterals, for all rooms that judge them: Q2 (HDR eq. 1.6), from 0 to 1.
#pragma once

namespace carreau::shape_level {

/// Better elements are left as they are. [smoothing_test; .64: p1 of rough sizes .80 to .71; 1: twice the time]
inline constexpr double good = 0.8;
/// Changes for another aim may leave such shapes, whatever they were before. The lengths of worse bent triangles are integrated.
/// [even_edges_test, gradation_test; .87: Q2 of swirl at 51 : 1 .870 to .868]
inline constexpr double fair = 0.7;
/// Below, the worst element counts, not the mean. Swaps for better degrees leave none that is worse. [poles_test; .48: degrees of six on
/// algebraic meshes 83 to 72 %; .75: lengths in range on rough sizes 91.5 to 89.7 %]
inline constexpr double poor = 0.6;
/// A change may leave such an element until vertices move. [guarantees_test; .4: longest edge of a paraboloid 1.31 to 1.43; .6: degrees of
/// six 83 to 78 %]
inline constexpr double bad = 0.5;
/// A change of topology may leave such an element, which later passes improve. [quads_test]
inline constexpr double flat = 0.15;
/// Gain that counts. [smoothing_test; .8e-3 and 1.25e-3: 5 of 42 meshes change, no figure by more than .1 %]
inline constexpr double gain = 1e-3;

}  // namespace carreau::shape_level
