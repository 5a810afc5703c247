// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/molecule/space_arc.h"

#include <algorithm>
#include <numbers>
#include <optional>

#include "model/union_find.h"

namespace carreau::molecule {

namespace {

constexpr double turn = 2 * std::numbers::pi;

/// Integral of the geodesic curvature along a loop, with its corners.
double turning(const Ball& ball, const SpaceLoop& loop, double sign) {
  double sum = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const SpaceArc &arc = loop[k], &next = loop[(k + 1) % loop.size()];
    sum += sign * dot(arc.centre - ball.centre, arc.axis()) / ball.radius * (arc.b - arc.a);
    const Vec3 normal = (sign / ball.radius) * (arc.point(arc.last()) - ball.centre);
    const Vec3 from = arc.tangent(arc.last()), to = next.tangent(next.first());
    if (loop.size() > 1) sum += std::atan2(dot(normal, cross(from, to)), dot(from, to));
  }
  return sum;
}

/// The crossing of a great circle with a loop.
struct Crossing {
  double angle = 0;
  std::size_t loop = 0;
};

/// A great circle of a ball, from a place of one loop through a place of another.
struct GreatCircle {
  const Ball& ball;
  Vec3 e1, e2;
  [[nodiscard]] Vec3 point(double angle) const {
    return ball.centre + ball.radius * (std::cos(angle) * e1 + std::sin(angle) * e2);
  }
};

void add_crossings(const GreatCircle& great, const SpaceArc& arc, std::size_t loop, std::vector<Crossing>& crossings) {
  const Vec3 axis = cross(arc.e1, arc.e2);
  const double x = dot(axis, great.e1), y = dot(axis, great.e2), size = std::hypot(x, y);
  const double level = dot(arc.centre - great.ball.centre, axis) / great.ball.radius;
  if (!(std::abs(level) < size)) return;
  const double middle = std::atan2(y, x), half = std::acos(level / size);
  for (const double angle : {middle - half, middle + half}) {
    const Vec3 d = great.point(angle) - arc.centre;
    double on_arc = std::atan2(dot(d, arc.e2), dot(d, arc.e1)) - arc.a;
    on_arc -= turn * std::floor(on_arc / turn);
    if (on_arc <= arc.b - arc.a) crossings.push_back({angle - turn * std::floor(angle / turn), loop});
  }
}

/// Joins loops between which a stretch of a great circle is bare. A stretch that leaves a part through a loop comes
/// back through the same loop. So the great circle of any two loops of a part joins them, with the loops between.
void join_along(const GreatCircle& great, std::span<const SpaceLoop> loops,
                const std::function<bool(const Vec3&)>& bare, UnionFind& sets) {
  std::vector<Crossing> crossings;
  for (std::size_t l = 0; l < loops.size(); ++l)
    for (const SpaceArc& arc : loops[l]) add_crossings(great, arc, l, crossings);
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& s, const Crossing& t) { return s.angle < t.angle; });
  for (std::size_t k = 0; k < crossings.size(); ++k) {
    const bool last = k + 1 == crossings.size();
    const Crossing& next = crossings[last ? 0 : k + 1];
    if (next.loop == crossings[k].loop) continue;
    if (bare(great.point((crossings[k].angle + next.angle + (last ? turn : 0)) / 2)))
      sets.merge(crossings[k].loop, next.loop);
  }
}

/// Returns whether an arc lies on the great circle, so that they have no crossing point: sides of a probe's triangle
/// are arcs of great circles.
bool runs_along(const GreatCircle& great, const SpaceArc& arc) {
  constexpr double close = 1e-6;
  const Vec3 axis = cross(arc.e1, arc.e2);
  return std::hypot(dot(axis, great.e1), dot(axis, great.e2)) < close &&
         std::abs(dot(arc.centre - great.ball.centre, axis)) < close * great.ball.radius;
}

/// A great circle through an arc of each of two loops that runs along no arc.
std::optional<GreatCircle> great_circle_of(const Ball& ball, std::span<const SpaceLoop> loops, std::size_t first,
                                           std::size_t second) {
  const auto direction = [&](const SpaceArc& arc) -> Vec3 {
    return (arc.point((arc.a + arc.b) / 2) - ball.centre) / ball.radius;
  };
  for (const SpaceArc& from : loops[first])
    for (const SpaceArc& to : loops[second]) {
      const Vec3 e1 = direction(from), q = direction(to), side = q - dot(q, e1) * e1;
      if (norm(side) < 1e-9) continue;
      const GreatCircle great{ball, e1, side / norm(side)};
      const bool along = std::any_of(loops.begin(), loops.end(), [&](const SpaceLoop& loop) {
        return std::any_of(loop.begin(), loop.end(), [&](const SpaceArc& arc) { return runs_along(great, arc); });
      });
      if (!along) return great;
    }
  return {};
}

}  // namespace

double area_on_sphere(const Ball& ball, std::span<const SpaceLoop> loops, Side side) {
  double sum = turn * (2 - static_cast<double>(loops.size()));
  for (const SpaceLoop& loop : loops) sum -= turning(ball, loop, side == Side::outer ? 1 : -1);
  return ball.radius * ball.radius * sum;
}

Vec3 vector_area(const Ball& ball, std::span<const SpaceLoop> loops) {
  Vec3 sum;
  for (const SpaceLoop& loop : loops)
    for (const SpaceArc& arc : loop) {
      const Vec3 chord = arc.point(arc.last()) - arc.point(arc.first());
      const Vec3 part = cross(arc.centre - ball.centre, chord) + arc.radius * arc.radius * (arc.b - arc.a) * arc.axis();
      sum += 0.5 * part;
    }
  return sum;
}

std::vector<std::size_t> parts_of_loops(const Ball& ball, std::span<const SpaceLoop> loops,
                                        const std::function<bool(const Vec3&)>& bare) {
  UnionFind sets(loops.size());
  for (std::size_t l = 0; l < loops.size(); ++l)
    for (std::size_t m = l + 1; m < loops.size(); ++m) {
      if (sets.find(l) == sets.find(m)) continue;
      if (const auto great = great_circle_of(ball, loops, l, m)) join_along(*great, loops, bare, sets);
    }
  std::vector<std::size_t> part(loops.size());
  for (std::size_t l = 0; l < loops.size(); ++l) part[l] = sets.find(l);
  return part;
}

}  // namespace carreau::molecule
