#include "geometry/molecule/areas.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/union_find.h"

namespace carreau::molecule {

namespace {

/// Turning of a loop at the end of an arc, the component on the left.
double exterior_angle(const Arrangement& a, const Ball& ball, const ArcUse& in, const ArcUse& out) {
  const Arc &p = a.arcs[in.arc], &q = a.arcs[out.arc];
  const Vec3 normal = a.vertices[in.forward ? p.end : p.start].x - ball.centre;
  const Vec3 from = (in.forward ? 1 : -1) * a.circles[p.circle].tangent(in.forward ? p.b : p.a);
  const Vec3 to = (out.forward ? 1 : -1) * a.circles[q.circle].tangent(out.forward ? q.a : q.b);
  return std::atan2(dot(normal, cross(from, to)) / ball.radius, dot(from, to));
}

/// Integral of the geodesic curvature along a loop, with its corners.
double turning(const Arrangement& a, int ball, const Loop& loop) {
  double sum = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Arc& arc = a.arcs[loop[k].arc];
    // The circle bends away from what it leaves uncovered, unless it covers more than half of the sphere.
    sum -= a.circle_of(loop[k]).offset(ball) / a.balls[ball].radius * (arc.b - arc.a);
    if (!arc.whole()) sum += exterior_angle(a, a.balls[ball], loop[k], loop[(k + 1) % loop.size()]);
  }
  return sum;
}

Vec3 middle_of(std::span<const Ball> balls) {
  Vec3 sum;
  for (const Ball& ball : balls) sum += ball.centre;
  return sum / static_cast<double>(balls.size());
}

/// Components that share an arc are of one shell.
std::vector<int> shells_of(const Arrangement& a) {
  UnionFind sets(a.components.size());
  std::vector<int> first(a.arcs.size(), -1), shell(a.components.size(), -1);
  for (std::size_t c = 0; c < a.components.size(); ++c)
    for (const Loop& loop : a.components[c].loops)
      for (const ArcUse& use : loop) {
        if (first[use.arc] >= 0) sets.merge(static_cast<std::size_t>(first[use.arc]), c);
        first[use.arc] = static_cast<int>(c);
      }
  int count = 0;
  for (std::size_t c = 0; c < shell.size(); ++c) {
    const std::size_t root = sets.find(c);
    shell[c] = root == c ? count++ : shell[root];
  }
  return shell;
}

}  // namespace

double area_of(const Arrangement& a, const Component& component) {
  double sum = 2 * std::numbers::pi * (2 - static_cast<double>(component.loops.size()));
  for (const Loop& loop : component.loops) sum -= turning(a, component.ball, loop);
  const double r = a.balls[component.ball].radius;
  return r * r * sum;
}

Vec3 vector_area(const Arrangement& a, const Component& component) {
  Vec3 sum;
  for (const Loop& loop : component.loops)
    for (const ArcUse& use : loop) {
      const Arc& arc = a.arcs[use.arc];
      const Circle& c = a.circles[arc.circle];
      const Vec3 from_ball = c.centre - a.balls[component.ball].centre;
      const Vec3 chord = c.point(arc.b) - c.point(arc.a);
      const Vec3 part = cross(from_ball, chord) + c.radius * c.radius * (arc.b - arc.a) * c.axis;
      sum += (use.forward ? 0.5 : -0.5) * part;
    }
  return sum;
}

UnionMeasures measure(const Arrangement& a) {
  UnionMeasures m;
  m.ball_area.assign(a.balls.size(), 0);
  m.shell = shells_of(a);
  for (const int shell : m.shell) m.shell_volume.resize(std::max(m.shell_volume.size(), std::size_t(shell) + 1));
  const Vec3 middle = middle_of(a.balls);
  for (std::size_t c = 0; c < a.components.size(); ++c) {
    const Component& component = a.components[c];
    const Ball& ball = a.balls[component.ball];
    const double area = area_of(a, component);
    m.component_area.push_back(area);
    m.ball_area[component.ball] += area;
    m.area += area;
    m.shell_volume[m.shell[c]] += (ball.radius * area + dot(ball.centre - middle, vector_area(a, component))) / 3;
  }
  for (const double volume : m.shell_volume) m.volume += volume;
  return m;
}

}  // namespace carreau::molecule
