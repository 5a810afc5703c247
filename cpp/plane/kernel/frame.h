// SPDX-License-Identifier: BSD-3-Clause
// Coordinates of the size of one, whatever the host's: the mesher works in them.
#pragma once

#include "control_space/control_space.h"
#include "metric/chart.h"
#include "metric/metric2.h"
#include "plane/kernel/thresholds.h"
#include "plane/kernel/triangulation.h"

namespace carreau::plane {

/// Multiplies u and v by a power of two each, so that the domain's box has sides between 1 and 2. Exact both ways.
struct Frame {
  Vec2 scale{1, 1}, unscale{1, 1};

  [[nodiscard]] Vec2 inward(const Vec2& uv) const noexcept { return {uv.x() * scale.x(), uv.y() * scale.y()}; }
  [[nodiscard]] Vec2 outward(const Vec2& p) const noexcept { return {p.x() * unscale.x(), p.y() * unscale.y()}; }
};

/// The control space as seen from the frame.
class Field {
 public:
  /// Known properties of a field.
  struct Known {
    /// True if the field may bend somewhere. False without layers: points amid long edges then come from both ends of an
    /// arc, and folded charts do not detect that they meet.
    bool bends;
    double triangles;  ///< number of unit triangles in the domain, which may be a part of the space's domain
  };
  Field(const ControlSpace& space, const Frame& frame, Known known) noexcept
      : space_(space),
        unscale_(frame.unscale),
        aa_(unscale_.x() * unscale_.x()),
        ab_(unscale_.x() * unscale_.y()),
        bb_(unscale_.y() * unscale_.y()),
        known_(known),
        constant_(space.is_constant()),
        everywhere_(evaluated({0, 0})) {}
  /// The field with its sizes multiplied by `times`.
  [[nodiscard]] Field coarser(double times) const noexcept {
    Field coarse = *this;
    const double share = 1 / (times * times);
    coarse.aa_ *= share, coarse.ab_ *= share, coarse.bb_ *= share, coarse.known_.triangles *= share;
    coarse.everywhere_ = coarse.evaluated({0, 0});
    return coarse;
  }
  /// True if charts are useful anywhere in the domain of the space. Searches all of it.
  [[nodiscard]] static bool may_bend(const ControlSpace& space) noexcept {
    return space.measure() >= large_mesh && space.largest_bend() > min_bend;
  }

  /// One size in a plane is constant: without the branch its evaluation takes a third of the judgement of a shape.
  [[nodiscard]] Metric2 at(const Vec2& p) const noexcept { return constant_ ? everywhere_ : evaluated(p); }
  [[nodiscard]] MetricSlopes slopes(const Vec2& p) const noexcept {
    const MetricSlopes s = space_.slopes_at({p.x() * unscale_.x(), p.y() * unscale_.y()});
    const auto inward = [&](Metric2 m, double k) { return Metric2{k * aa_ * m.a, k * ab_ * m.b, k * bb_ * m.c}; };
    return {inward(s.metric, 1), inward(s.by_u, unscale_.x()), inward(s.by_v, unscale_.y())};
  }
  /// `curved` false: of the tensor alone.
  [[nodiscard]] Chart chart(const Vec2& p, bool curved = true) const noexcept {
    if (curved) return {p, slopes(p)};
    constexpr Metric2 none{0, 0, 0};
    return {p, {at(p), none, none}};
  }
  /// Length of the segment p - q in the tensor at its middle.
  [[nodiscard]] double length_at_middle(const Vec2& p, const Vec2& q) const noexcept { return length(at(0.5 * (p + q)), q - p); }
  /// Parameters of the host.
  [[nodiscard]] Vec2 outward(const Vec2& p) const noexcept { return {p.x() * unscale_.x(), p.y() * unscale_.y()}; }
  /// True if there may be places where the field bends.
  [[nodiscard]] bool bends() const noexcept { return known_.bends; }
  /// About the origin of `chart`, which was made of `slopes` (shapes.cpp).
  [[nodiscard]] Bend bend(const MetricSlopes& slopes, const Chart& chart) const noexcept;
  /// Expected number of triangles.
  [[nodiscard]] double measure() const noexcept { return known_.triangles; }

 private:
  [[nodiscard]] Metric2 evaluated(const Vec2& p) const noexcept {
    const Metric2 m = space_.at({p.x() * unscale_.x(), p.y() * unscale_.y()});
    return {m.a * aa_, m.b * ab_, m.c * bb_};
  }

  const ControlSpace& space_;
  Vec2 unscale_;
  double aa_, ab_, bb_;
  Known known_;
  bool constant_;
  Metric2 everywhere_;  ///< of a constant space
};

}  // namespace carreau::plane
