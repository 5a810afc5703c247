// SPDX-License-Identifier: BSD-3-Clause
// Derivatives at the nodes of a grid by finite differences (HDR sec. 4.7.2).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "support/vec.h"

namespace carreau::grid {

/// A point of a line, with its parameter.
struct Sample {
  double x = 0;
  Vec3 p;
};

/// The derivative at a's, b's or c's parameter `at` of the parabola through the three.
Vec3 parabola_derivative(const Sample& a, const Sample& b, const Sample& c, double at);

/// Derivatives at the points of a line; `there` marks present points, and lines end beside missing ones. At inner
/// points, the derivative of the parabola through the point and its neighbours. The joint of a closed line (whose last
/// point is its first one) is an inner point. Ends have the derivative of the parabola through the last three points.
/// Two points have their difference, one point has 0. Order two for even parameters; exact for parabolas.
std::vector<Vec3> line_derivatives(std::span<const Sample> line, std::span<const char> there, bool closed);

/// Derivatives of the cubic spline through the points of a line, which has continuous second derivatives; `there` and `closed` as above. Ends are
/// not knots, so that cubic polynomials are exact (order three at ends, four inside). Through three points it is the parabola.
/// `given`, empty or one per point, prescribes derivatives; second derivatives may jump at points inside that have one.
std::vector<Vec3> spline_derivatives(std::span<const Sample> line, std::span<const char> there, bool closed,
                                     std::span<const std::optional<Vec3>> given = {});

}  // namespace carreau::grid
