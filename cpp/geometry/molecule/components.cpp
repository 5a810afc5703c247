#include "geometry/molecule/components.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/molecule/triples.h"
#include "model/union_find.h"

namespace carreau::molecule {

namespace {

/// Which arc a vertex has on the circle of its balls 0 and 1, 0 and 2, 1 and 2.
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

/// A great circle of a ball from a place of one loop to a place of another: the loops that it meets, by angle.
struct Crossing {
  double angle = 0;
  std::size_t loop = 0;
};

Vec3 middle_of(const Arrangement& a, const Loop& loop) {
  const Arc& arc = a.arcs[loop.front().arc];
  return a.circles[arc.circle].point((arc.a + arc.b) / 2);
}

/// Angles, from p towards q, at which the great circle of the two unit vectors e1, e2 meets an arc.
void add_crossings(const Arrangement& a, const Ball& ball, const Vec3& e1, const Vec3& e2, const Arc& arc,
                   std::size_t loop, std::vector<Crossing>& crossings) {
  const Circle& c = a.circles[arc.circle];
  const Vec3 to_centre = c.centre - ball.centre;
  const double x = dot(c.axis, e1), y = dot(c.axis, e2), size = std::hypot(x, y);
  const double level = dot(to_centre, c.axis) / ball.radius;
  if (!(std::abs(level) < size)) return;
  const double middle = std::atan2(y, x), half = std::acos(level / size);
  for (const double angle : {middle - half, middle + half}) {
    const Vec3 p = ball.centre + ball.radius * (std::cos(angle) * e1 + std::sin(angle) * e2);
    const double on_arc = c.angle(p), turn = 2 * std::numbers::pi;
    if (arc.whole() || (on_arc >= arc.a && on_arc <= arc.b) || on_arc + turn <= arc.b)
      crossings.push_back({angle - turn * std::floor(angle / turn), loop});
  }
}

/// Two loops that an uncovered stretch of some great circle joins bound one component. A stretch that leaves a
/// component through a loop comes back through the same loop, so the great circle of any two loops of a component joins
/// them, with those between.
void join_along(const Arrangement& a, std::span<const int> others, int b, const std::vector<Loop>& loops,
                std::size_t first, std::size_t second, UnionFind& sets) {
  const Ball& ball = a.balls[b];
  const Vec3 e1 = (middle_of(a, loops[first]) - ball.centre) / ball.radius;
  const Vec3 q = (middle_of(a, loops[second]) - ball.centre) / ball.radius, side = q - dot(q, e1) * e1;
  if (norm(side) <= 0) return;
  const Vec3 e2 = side / norm(side);
  std::vector<Crossing> crossings;
  for (std::size_t l = 0; l < loops.size(); ++l)
    for (const ArcUse& use : loops[l]) add_crossings(a, ball, e1, e2, a.arcs[use.arc], l, crossings);
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& s, const Crossing& t) { return s.angle < t.angle; });
  for (std::size_t k = 0; k < crossings.size(); ++k) {
    const bool last = k + 1 == crossings.size();
    const Crossing& next = crossings[last ? 0 : k + 1];
    if (next.loop == crossings[k].loop) continue;
    const double middle = (crossings[k].angle + next.angle + (last ? 2 * std::numbers::pi : 0)) / 2;
    const Vec3 p = ball.centre + ball.radius * (std::cos(middle) * e1 + std::sin(middle) * e2);
    int ignored = -1;
    const CoverTest test{a.balls, others, 0};
    if (test.of(p, {}, ignored) == Cover::no) sets.merge(crossings[k].loop, next.loop);
  }
}

void add_components(const Neighbours& neighbours, int ball, std::vector<Loop>& loops, Arrangement& a) {
  UnionFind sets(loops.size());
  for (std::size_t l = 0; l < loops.size(); ++l)
    for (std::size_t m = l + 1; m < loops.size(); ++m)
      if (sets.find(l) != sets.find(m)) join_along(a, neighbours.of(ball), ball, loops, l, m, sets);
  std::vector<int> rank(loops.size(), -1);
  for (std::size_t l = 0; l < loops.size(); ++l) {
    int& component = rank[sets.find(l)];
    if (component < 0) component = static_cast<int>(a.components.size()), a.components.push_back({.ball = ball});
    a.components[component].loops.push_back(std::move(loops[l]));
  }
}

/// A point of the sphere that no ball covers, when no circle bounds what is not covered.
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
