// SPDX-License-Identifier: BSD-3-Clause
// A scalar field on a triangle mesh: the input of estimators and transfers.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "support/vec.h"

namespace carreau {

/// Vertices of the plane (z = 0) or of a surface in space, triangles by indices from 0, a value at each vertex.
/// Only refers to the arrays.
struct ScalarField {
  std::span<const Vec3> vertices;
  std::span<const std::array<std::int32_t, 3>> triangles;
  std::span<const double> values;
};

/// Throws InvalidArgument unless a value is finite and at most 1e100, so that squares of curvatures do not overflow.
/// `where`: "at vertex 3".
void check_value(double value, const std::string& where);

/// Throws InvalidArgument unless there is a triangle, arrays fit, indices lie in range, numbers are finite and values
/// not too large (check_value).
void check_field(const ScalarField& field);

/// Largest absolute value.
double largest_value(std::span<const double> values) noexcept;

/// The vertices beside each vertex: vertex v has neighbour[start[v]] .. neighbour[start[v + 1] - 1], ascending.
struct Neighbours {
  std::vector<std::int32_t> start, neighbour;
  [[nodiscard]] std::span<const std::int32_t> of(std::int32_t v) const noexcept {
    const auto from = static_cast<std::size_t>(start[static_cast<std::size_t>(v)]);
    return {neighbour.data() + from, static_cast<std::size_t>(start[static_cast<std::size_t>(v) + 1]) - from};
  }
};
Neighbours neighbours_of(std::size_t vertices, std::span<const std::array<std::int32_t, 3>> triangles);

}  // namespace carreau
