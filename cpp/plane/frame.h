// Coordinates of the size of one, whatever the host's: the mesher works in them.
#pragma once

#include "metric/metric2.h"
#include "size/control_space.h"

namespace carreau::plane {

/// Multiplies u and v by a power of two each, so that the domain's box has sides between 1 and 2. Exact both ways.
struct Frame {
  Vec2 scale{1, 1}, unscale{1, 1};

  [[nodiscard]] Vec2 inward(Vec2 uv) const noexcept { return {uv.x * scale.x, uv.y * scale.y}; }
  [[nodiscard]] Vec2 outward(Vec2 p) const noexcept { return {p.x * unscale.x, p.y * unscale.y}; }
};

/// The control space as seen from the frame.
class Field {
 public:
  Field(const ControlSpace& space, const Frame& frame) noexcept
      : space_(space),
        unscale_(frame.unscale),
        aa_(unscale_.x * unscale_.x),
        ab_(unscale_.x * unscale_.y),
        bb_(unscale_.y * unscale_.y) {}

  [[nodiscard]] Metric2 at(Vec2 p) const noexcept {
    const Metric2 m = space_.at({p.x * unscale_.x, p.y * unscale_.y});
    return {m.a * aa_, m.b * ab_, m.c * bb_};
  }
  /// Expected number of triangles.
  [[nodiscard]] double measure() const noexcept { return space_.measure(); }

 private:
  const ControlSpace& space_;
  Vec2 unscale_;
  double aa_, ab_, bb_;
};

}  // namespace carreau::plane
