// SPDX-License-Identifier: BSD-3-Clause
// Balls, and the pairs of balls whose spheres meet.
#pragma once

#include <span>
#include <vector>

#include "support/vec.h"

namespace carreau::molecule {

/// Lengths are in the caller's unit (angstrom for molecules).
struct Ball {
  Vec3 centre;
  double radius = 0;
};

/// A unit vector orthogonal to a unit vector, by a fixed rule.
Vec3 across(const Vec3& unit);

/// Throws InvalidArgument, naming the ball (from 1), for a centre or a radius that is not finite. Also for a radius
/// that is not positive or is below 1e-9 of the largest one, and for no ball at all.
void check_balls(std::span<const Ball> balls);

/// Returns whether two spheres cross in a circle. Touching spheres, from outside or from inside, do not: distances are
/// equal when they agree to 1e-12 of the radii.
bool spheres_meet(const Ball& p, const Ball& q);

/// Pairs of balls that share a point, for all balls. Balls inside another ball are marked and have no neighbours.
class Neighbours {
 public:
  /// Cell lists: n log n when the radii are of one order of magnitude. The first of equal balls is kept, and the
  /// largest of concentric ones.
  explicit Neighbours(std::span<const Ball> balls);

  /// Balls whose spheres meet the sphere of ball i, ascending.
  [[nodiscard]] std::span<const int> of(int i) const {
    return {list_.data() + start_[i], static_cast<std::size_t>(start_[i + 1] - start_[i])};
  }
  /// The ball that holds ball i, which then has no surface; -1: none.
  [[nodiscard]] int held_by(int i) const { return held_by_[i]; }
  [[nodiscard]] std::size_t pair_count() const { return list_.size() / 2; }

 private:
  std::vector<std::ptrdiff_t> start_;
  std::vector<int> list_, held_by_;
};

}  // namespace carreau::molecule
