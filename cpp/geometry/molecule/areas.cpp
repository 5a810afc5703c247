// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/molecule/areas.h"

#include <algorithm>

#include "model/union_find.h"

namespace carreau::molecule {

namespace {

std::vector<SpaceLoop> loops_of(const Arrangement& a, const Component& component) {
  std::vector<SpaceLoop> loops;
  for (const Loop& loop : component.loops) loops.push_back(a.space_loop(loop));
  return loops;
}

Vec3 middle_of(std::span<const Ball> balls) {
  Vec3 sum;
  for (const Ball& ball : balls) sum += ball.centre;
  return sum / static_cast<double>(balls.size());
}

/// Components that share an arc belong to one shell.
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
  return area_on_sphere(a.balls[component.ball], loops_of(a, component), Side::outer);
}

Vec3 vector_area(const Arrangement& a, const Component& component) {
  return vector_area(a.balls[component.ball], loops_of(a, component));
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
