// SPDX-License-Identifier: BSD-3-Clause
// Balls, and what of them can be seen at all.
#pragma once

#include <span>
#include <vector>

#include "support/vec.h"

namespace carreau::molecule {

/// Lengths are those of the caller (angstrom for molecules).
struct Ball {
  Vec3 centre;
  double radius = 0;
};

/// A unit vector at a right angle to a unit vector, by a rule.
Vec3 across(const Vec3& unit);

/// Throws InvalidArgument, naming the ball (from 1): a centre or a radius that is not finite, a radius that is not
/// positive or is below 1e-9 of the largest one; no ball at all.
void check_balls(std::span<const Ball> balls);

/// Whether two spheres cross in a circle. Touching spheres, from outside or from inside, do not: distances are equal
/// when they agree to 1e-12 of the radii.
bool spheres_meet(const Ball& p, const Ball& q);

/// Pairs of balls that share a point, for all balls. Those that lie inside another ball are told and have no
/// neighbours.
class Neighbours {
 public:
  /// Cell lists: n log n when the radii are of one order of magnitude. Of equal balls the first is kept, of concentric
  /// ones the largest.
  explicit Neighbours(std::span<const Ball> balls);

  /// Balls whose spheres meet that of ball i, ascending.
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
