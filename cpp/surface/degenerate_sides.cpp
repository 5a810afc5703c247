#include "surface/degenerate_sides.h"

#include <algorithm>
#include <limits>

namespace carreau {

DegenerateSides::DegenerateSides(const FaceMesh& face) : face_(&face) {
  for (const auto& t : face.flattened)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t p = t[i], q = t[(i + 1) % 3];
      if (face.vertex[p] != face.vertex[q]) continue;
      sides_.push_back({p, q});
      sides_.push_back({q, p});
    }
  std::sort(sides_.begin(), sides_.end());
  sides_.erase(std::unique(sides_.begin(), sides_.end()), sides_.end());
}

std::optional<Vec2> DegenerateSides::arrival(std::int32_t p, Vec2 a, Metric2 at_a) const {
  constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min();
  std::optional<Vec2> best;
  double nearest = std::numeric_limits<double>::infinity();
  for (auto side = std::lower_bound(sides_.begin(), sides_.end(), std::array{p, least});
       side != sides_.end() && (*side)[0] == p; ++side) {
    const Vec2 from = face_->uv[p], along = face_->uv[(*side)[1]] - from;
    const double squared = squared_length(at_a, along);
    const double t = squared > 0 ? std::clamp(dot(at_a, a - from, along) / squared, 0.0, 1.0) : 0;
    const Vec2 place = from + t * along;
    const double d = squared_length(at_a, place - a);
    if (!(d < nearest)) continue;
    nearest = d;
    best = place;
  }
  return best;
}

}  // namespace carreau
