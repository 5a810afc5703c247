// SPDX-License-Identifier: BSD-3-Clause
// Numbers that decide something about coverings.
// tests/cpp/atlas/covering_test rests on them.
#pragma once

namespace carreau::atlas::thresholds {

/// Penalties for the defects of clusters: no disc is worse than a fold, and a fold worse than a steep triangle.
inline constexpr double no_disc = 3, folded = 2, steep = 1;

/// Penalty of a pure zone that is not star-shaped. Room (share of the zone's extent) between its centre and the lines
/// of all edges, below which a star-shaped zone has a penalty. Charts with one pivot distort least.
inline constexpr double no_star = 0.5, star_room = 0.15;

/// Passes that better shapes, too.
inline constexpr int shape_passes = 2;

/// How often triangles are divided in four where clusters stay without a plane: 64 triangles in place of one.
inline constexpr int subdivisions = 3;

/// Share of clusters without a defect from which moves of single vertices can repair the others; below, triangles are
/// divided first.
inline constexpr double repairable = 0.8;

/// Radians between directions that both get a vertex of the inner border: nearer ones would make steep functions of
/// phi.
inline constexpr double apart = 0.02;

}  // namespace carreau::atlas::thresholds
