// SPDX-License-Identifier: BSD-3-Clause
// Newton's method for the closest point of a face or curve, one evaluation at a time.
#pragma once

#include "cad/cad.h"
#include "projection/restricted_step.h"
#include "support/vec.h"

namespace carreau::projection {

/// A curve counts as a surface with one parameter: S(u, v) does not depend on v, and the region has no height.
class Descent {
 public:
  Descent() = default;
  /// `size`: length over which the surface is nearly quadratic; `diagonal`: of all.
  Descent(const Vec3& x, const Region& region, const Vec2& start, double size, double diagonal)
      : x_(x), region_(region), trial_(start), size_(size), diagonal_(diagonal) {}

  /// The place to evaluate next, by all derivatives.
  [[nodiscard]] const Vec2& place() const noexcept { return trial_; }
  /// Takes the values there; a position that is not finite lies outside of the domain. Returns whether the descent goes on.
  bool take(const SurfaceJet& jet);

  /// After the last take(). False: no place could be evaluated.
  [[nodiscard]] bool found() const noexcept { return found_; }
  [[nodiscard]] const Vec2& parameters() const noexcept { return result_; }
  /// The way from the last evaluated place to the result.
  [[nodiscard]] const Vec2& beyond() const noexcept { return beyond_; }
  [[nodiscard]] const Vec3& xyz() const noexcept { return xyz_; }

 private:
  void finish(const Vec2& step);
  bool turn_at_pole(const Vec3& r);

  Vec3 x_;
  Region region_;
  Vec2 trial_, at_, step_, result_, beyond_;
  SurfaceJet jet_;  // at at_
  Vec3 xyz_;
  double size_ = 0, diagonal_ = 0, square_ = 0, move_ = 0;
  int steps_ = 0, halvings_ = 0, turns_ = 0;
  bool found_ = false;
};

}  // namespace carreau::projection
