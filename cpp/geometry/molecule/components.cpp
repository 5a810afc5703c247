// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/molecule/components.h"

#include "geometry/molecule/triples.h"

namespace carreau::molecule {

namespace {

/// The arc of a vertex on the circle of its balls 0 and 1, 0 and 2, 1 and 2.
using ArcsAt = std::vector<std::array<int, 3>>;

int slot_of(const Vertex& v, const Circle& circle) {
  if (v.balls[0] != circle.i) return 2;
  return v.balls[1] == circle.j ? 0 : 1;
}

ArcsAt arcs_at_vertices(const Arrangement& a) {
  ArcsAt at(a.vertices.size(), {-1, -1, -1});
  for (std::size_t k = 0; k < a.arcs.size(); ++k) {
    const Arc& arc = a.arcs[k];
    if (arc.whole()) continue;
    for (const int v : {arc.start, arc.end}) at[v][slot_of(a.vertices[v], a.circles[arc.circle])] = static_cast<int>(k);
  }
  return at;
}

/// The arc that follows in a ball's loop; -1: none does.
int next_arc(const Arrangement& a, const ArcsAt& at, int ball, const ArcUse& use) {
  const Arc& arc = a.arcs[use.arc];
  const int v = use.forward ? arc.end : arc.start;
  const int came = slot_of(a.vertices[v], a.circles[arc.circle]);
  const std::array<int, 3>& balls = a.vertices[v].balls;
  constexpr int slots_of[3][2] = {{0, 1}, {0, 2}, {1, 2}};  // of the vertex's balls
  const auto& slots = slots_of[ball == balls[0] ? 0 : ball == balls[1] ? 1 : 2];
  const int next = at[v][slots[0] == came ? slots[1] : slots[0]];
  if (next < 0) return -1;
  const bool forward = a.circles[a.arcs[next].circle].j == ball;
  return (forward ? a.arcs[next].start : a.arcs[next].end) == v ? next : -1;
}

/// Loops by ball; false when one does not close.
bool find_loops(const Arrangement& a, std::vector<std::vector<Loop>>& loops) {
  const ArcsAt at = arcs_at_vertices(a);
  std::vector<std::array<char, 2>> used(a.arcs.size(), {0, 0});
  for (std::size_t first = 0; first < a.arcs.size(); ++first)
    for (const bool forward : {false, true}) {
      if (used[first][forward] != 0) continue;
      const Circle& circle = a.circles[a.arcs[first].circle];
      const int ball = forward ? circle.j : circle.i;
      Loop loop;
      for (ArcUse use{static_cast<int>(first), forward};;) {
        if (used[use.arc][use.forward] != 0) return false;
        used[use.arc][use.forward] = 1;
        loop.push_back(use);
        if (a.arcs[use.arc].whole()) break;
        const int next = next_arc(a, at, ball, use);
        if (next < 0) return false;
        use = {next, a.circles[a.arcs[next].circle].j == ball};
        if (use.arc == static_cast<int>(first) && use.forward == forward) break;
      }
      loops[ball].push_back(std::move(loop));
    }
  return true;
}

void add_components(const Neighbours& neighbours, int ball, std::vector<Loop>& loops, Arrangement& a) {
  std::vector<SpaceLoop> in_space;
  for (const Loop& loop : loops) in_space.push_back(a.space_loop(loop));
  const CoverTest test{a.balls, neighbours.of(ball), 0};
  const std::vector<std::size_t> part = parts_of_loops(a.balls[ball], in_space, [&](const Vec3& p) {
    int ignored = -1;
    return test.of(p, {}, ignored) == Cover::no;
  });
  std::vector<int> rank(loops.size(), -1);
  for (std::size_t l = 0; l < loops.size(); ++l) {
    int& component = rank[part[l]];
    if (component < 0) component = static_cast<int>(a.components.size()), a.components.push_back({.ball = ball});
    a.components[component].loops.push_back(std::move(loops[l]));
  }
}

/// Returns whether the whole sphere is uncovered, when no circle bounds an uncovered part.
bool is_bare(const Neighbours& neighbours, const Arrangement& a, int ball) {
  if (a.held_by[ball] >= 0) return false;
  return neighbours.of(ball).empty();
}

}  // namespace

bool find_components(const Neighbours& neighbours, Arrangement& a) {
  std::vector<std::vector<Loop>> loops(a.balls.size());
  if (!find_loops(a, loops)) return false;
  for (std::size_t i = 0; i < a.balls.size(); ++i) {
    const int ball = static_cast<int>(i);
    if (!loops[i].empty())
      add_components(neighbours, ball, loops[i], a);
    else if (is_bare(neighbours, a, ball))
      a.components.push_back({.ball = ball});
  }
  return true;
}

}  // namespace carreau::molecule
