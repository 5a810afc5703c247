// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/molecule/poles.h"

#include <algorithm>
#include <cmath>

#include "geometry/molecule/areas.h"

namespace carreau::molecule {

namespace {

/// The part of a ball's sphere that another ball covers: directions d with dot(d, axis) > level.
struct Cap {
  Vec3 axis;
  double level = 0;
};

struct Surroundings {
  std::vector<Cap> caps;
  std::vector<Vec3> border;  // directions
};

Surroundings look(const Arrangement& a, const Component& component) {
  Surroundings found;
  const Ball& ball = a.balls[component.ball];
  constexpr int samples = 8;
  for (const Loop& loop : component.loops)
    for (const ArcUse& use : loop) {
      const Arc& arc = a.arcs[use.arc];
      const Circle& c = a.circles[arc.circle];
      const Vec3 axis = (use.forward ? -1 : 1) * c.axis;
      found.caps.push_back({axis, c.offset(component.ball) / ball.radius});
      for (int s = 0; s < samples; ++s)
        found.border.push_back((c.point(arc.a + (arc.b - arc.a) * s / samples) - ball.centre) / ball.radius);
    }
  return found;
}

bool is_covered(const Surroundings& s, const Vec3& direction) {
  return std::any_of(s.caps.begin(), s.caps.end(),
                     [&](const Cap& cap) { return dot(direction, cap.axis) > cap.level + 1e-9; });
}

double depth(const Surroundings& s, const Vec3& direction) {
  double nearest = -1;
  for (const Vec3& p : s.border) nearest = std::max(nearest, dot(p, direction));
  return std::acos(std::clamp(nearest, -1.0, 1.0));
}

}  // namespace

Pole find_pole(const Arrangement& a, const Component& component) {
  const Surroundings around = look(a, component);
  Pole best;
  const auto consider = [&](const Vec3& v) {
    const double length = norm(v);
    if (length < 1e-6) return;
    const Vec3 direction = v / length;
    if (!is_covered(around, direction)) return;
    if (const double found = depth(around, direction); found > best.depth * (1 + 1e-9)) best = {direction, found};
  };
  for (const Cap& cap : around.caps) consider(cap.axis);
  consider(-vector_area(a, component));
  constexpr std::size_t most = 24;  // pairs of more hardly find a better one
  const std::size_t n = std::min(around.caps.size(), most);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) consider(around.caps[i].axis + around.caps[j].axis);
  return best;
}

}  // namespace carreau::molecule
