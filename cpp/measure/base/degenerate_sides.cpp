// SPDX-License-Identifier: BSD-3-Clause
#include "measure/base/degenerate_sides.h"

#include <algorithm>
#include <limits>

#include "support/infinity.h"

namespace carreau {

DegenerateSides::DegenerateSides(const FaceMesh& face, std::int32_t index)
    : face_(&face), box_{Vec2(infinity, infinity), Vec2(-infinity, -infinity)} {
  for (std::size_t v = 0; v < face.uv_face.size(); ++v)
    for (int i = 0; i < 2 && face.uv_face[v] == index; ++i)
      box_[0][i] = std::min(box_[0][i], face.uv[v][i]), box_[1][i] = std::max(box_[1][i], face.uv[v][i]);
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

std::optional<Vec2> DegenerateSides::arrival(std::int32_t p, const Tangents& at_pole, const Vec2& a, const Tangents& at_a,
                                             const Vec3& chord) const {
  const auto& [su, sv] = at_a;
  constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min();
  // The step of (u, v) whose image is the chord, without its part across the tangent plane. This is not the shortest
  // way in a metric: around a pole whose metric differs by direction that is a spiral.
  const double e = dot(su, su), f = dot(su, sv), g = dot(sv, sv), x = dot(su, chord), y = dot(sv, chord);
  const Vec2 way{g * x - f * y, e * y - f * x};  // times the determinant
  std::optional<Vec2> best;
  double nearest = infinity;
  for (auto side = std::lower_bound(sides_.begin(), sides_.end(), std::array{p, least});
       side != sides_.end() && (*side)[0] == p; ++side) {
    const Vec2 from = face_->uv[p], along = face_->uv[(*side)[1]] - from;
    const double across = cross(along, way);
    const double t = across != 0 ? std::clamp(cross(a - from, way) / across, 0.0, 1.0) : 0;
    const Vec2 place = from + t * along, step = place - a;
    const double d = e * step.x() * step.x() + 2 * f * step.x() * step.y() + g * step.y() * step.y();
    if (!(d < nearest)) continue;
    nearest = d;
    best = place;
  }
  if (!best && box_[0].x() <= box_[1].x() && norm(at_pole.su) + norm(at_pole.sv) > 0)
    return arrival_at_pole(face_->uv[p], at_pole, a, at_a, chord, box_);
  return best;
}

}  // namespace carreau
