// SPDX-License-Identifier: BSD-3-Clause
// Maps of space that keep lengths: translations, rotations, reflections and their products.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "support/vec.h"

namespace carreau {

/// Isometry::distortion() of a map that counts as one that keeps lengths: rounding of its entries.
inline constexpr double isometry_tolerance = 1e-9;

/// x -> R x + shift; `row` holds the rows of R.
struct Isometry {
  std::array<Vec3, 3> row{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  Vec3 shift{0, 0, 0};

  /// Maps a vector.
  [[nodiscard]] Vec3 turn(const Vec3& v) const noexcept { return {dot(row[0], v), dot(row[1], v), dot(row[2], v)}; }
  /// Maps a point.
  [[nodiscard]] Vec3 operator()(const Vec3& p) const noexcept {
    const Vec3 turned = turn(p);
    return {turned.x() + shift.x(), turned.y() + shift.y(), turned.z() + shift.z()};
  }
  [[nodiscard]] Isometry inverse() const noexcept {
    Isometry result;
    for (int i = 0; i < 3; ++i) result.row[i] = Vec3(row[0][i], row[1][i], row[2][i]);
    const Vec3 back = result.turn(shift);
    result.shift = Vec3(-back.x(), -back.y(), -back.z());
    return result;
  }
  /// Returns the map of x to this(first(x)).
  [[nodiscard]] Isometry after(const Isometry& first) const noexcept {
    Isometry result;
    for (int i = 0; i < 3; ++i) {
      const Vec3 column = turn(Vec3(first.row[0][i], first.row[1][i], first.row[2][i]));
      for (int k = 0; k < 3; ++k) result.row[k][i] = column[k];
    }
    result.shift = (*this)(first.shift);
    return result;
  }
  /// True for products with an odd number of reflections.
  [[nodiscard]] bool reflects() const noexcept { return dot(row[0], cross(row[1], row[2])) < 0; }
  /// Largest entry of R R^T - I: 0 for a map that keeps lengths.
  [[nodiscard]] double distortion() const noexcept {
    double most = 0;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) most = std::max(most, std::abs(dot(row[i], row[k]) - (i == k ? 1. : 0.)));
    return most;
  }
};

}  // namespace carreau
