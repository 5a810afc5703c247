// SPDX-License-Identifier: BSD-3-Clause
// The feature of the input that forces a flat triangle, which the sweep excuses and reports.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace adapters {

enum class FlatCause : std::uint8_t {
  none,          ///< nothing in the input causes it
  corner_angle,  ///< two curves meet at a corner under its smallest angle, or it lies farther on between the same two
  short_curve,   ///< its shortest side is a whole curve of the input, shorter than a third of the size
  narrow_face,   ///< it bridges two curves that are nearer to each other than a third of the size
};
constexpr std::size_t flat_causes = 4;

struct FlatTriangle {
  std::size_t triangle = 0;
  double q2 = 0;
  FlatCause cause = FlatCause::none;
};

struct MeshOnCurves {
  const std::vector<std::array<double, 3>>& vertices;
  const std::vector<std::array<std::int32_t, 3>>& triangles;
  const std::vector<std::int32_t>& vertex_refs;                  ///< above 0: a corner of the input
  const std::vector<std::array<std::int32_t, 2>>& sorted_edges;  ///< on curves: lower vertex first, in order
  double size = 0;                                               ///< prescribed size
};

/// Q2 = 4 sqrt(3) area / sum of squared sides (HDR eq. 1.6).
double q2_of(const std::array<double, 3>& a, const std::array<double, 3>& b, const std::array<double, 3>& c);

/// Triangles of Q2 below `limit`, each with its cause.
std::vector<FlatTriangle> explain_flat_triangles(const MeshOnCurves& mesh, double limit);

}  // namespace adapters
