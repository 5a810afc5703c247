// SPDX-License-Identifier: BSD-3-Clause
// Linear functions in triangles from their mean values, limited to values between the values of the triangles around.
#pragma once

#include <span>
#include <vector>

#include "variable/base/piece.h"

namespace carreau::variable {

Vec2 centre_of(const Piece& piece, std::size_t triangle) noexcept;

/// Gradient in each triangle: least squares over the neighbours, made smaller until no corner is above or below all of
/// the triangle and its neighbours (Barth and Jespersen). Component `c` of rows of `components`. Exact for linear
/// functions in triangles between three others, except at extremes.
std::vector<Vec2> limited_slopes(const Piece& piece, const Adjacency& adjacency, std::span<const double> values,
                                 std::size_t components, std::size_t c);

}  // namespace carreau::variable
