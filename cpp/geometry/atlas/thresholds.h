// SPDX-License-Identifier: BSD-3-Clause
// Numbers that decide something about the surface of an atlas.
#pragma once

namespace carreau::atlas::thresholds {

/// Parts a side of the grid on which each T is looked at: a hundred places where charts share it. With half as many
/// parts a half of the folds of joint.off is not seen.
inline constexpr int grid_of_t = 24;
/// Area of the surface beside that of its charts' planes: below, a place counts as turned over. Above 0, as what is
/// nearly turned over is meshed slowly.
inline constexpr double least_jacobian = 0.03;

/// What the vertices of a chart count beside its neighbours: at first, by what factor less in each round, and at least.
/// At first 1 took an uneven torus a twentieth of its radius off; 40 leaves more folds on joint.off than 10.
inline constexpr double first_anchor = 10, loosening = 0.5, least_anchor = 1e-3;
/// Below this, neighbours give way as well: before, charts at the fold alone, so that the mend stays local.
inline constexpr double giving_way = 0.1;
/// How much more a place that is turned over counts in each round. Ten leaves more folds than three.
inline constexpr double emphasis = 3;
/// Rounds, and sweeps over the charts in each.
inline constexpr int mend_rounds = 24, mend_sweeps = 4;

}  // namespace carreau::atlas::thresholds
