// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room, with their meaning, unit, reason and support.
#pragma once

#include <cstddef>

namespace carreau::thresholds::projection {

// Leaves of a face (face_leaves)
/// Number. Each direction of a face is cut in so many cells at first. An odd number does not follow the periods of a surface.
inline constexpr int first_cells = 3;
/// Radians. Bezier's polygons of the lines u and v of a leaf turn by at most this angle, so that the squared distance has one minimum over the
/// leaf for points that are nearer than its radius of curvature. [Projector.FoldedPatchHasTwoMinimaAndTheNearerOneWins]
inline constexpr double turn_of_leaf = 0.67;
/// Share of the diameter of a leaf. The surface differs from the interpolation by at most this at the other samples. Newton's method needs
/// two evaluations from there, and one if the surface is bicubic.
inline constexpr double error_of_leaf = 0.005;
/// Factor. The surface between the samples may differ by so much more than at them.
inline constexpr double error_margin = 3;

/// Shares of the parameters of a leaf. A step ends the search on the interpolation if the surface itself differs by more, or if it is as short
/// as the second of them. The third: the expansion holds, so that it excludes a leaf that is farther than the bound.
inline constexpr double last_step_in_leaf = 0.01, last_step_in_exact_leaf = 1e-4, expanded_step = 0.5;

// Newton's method (descent, restricted_step)
/// Share of the length of a leaf. A full step of Newton's method that is shorter is the last one: the error of its Taylor expansion is
/// then of third order, below rounding. [Projector.Sphere]
inline constexpr double last_step = 1e-7;
/// Share of the diagonal. A step is the last one, too, if it and the step before lets expect a shorter one after it.
/// [Projector.Sphere]
inline constexpr double next_step = 1e-13;
/// Share of that step: the term of second order is at most so large. [Projector.ConeAndItsApex]
inline constexpr double bend_of_last_step = 1e-4;
/// Ratio of the eigenvalues of the Hessian in the first fundamental form. Below it the Hessian counts as singular.
inline constexpr double regular_hessian = 1e-3;
/// Ratio of the eigenvalues. Smaller ones, and negative ones, are replaced.
inline constexpr double smallest_eigenvalue = 1e-6;

}  // namespace carreau::thresholds::projection
