// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/molecule/arrangement.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <tuple>

#include "geometry/molecule/components.h"
#include "geometry/molecule/triples.h"
#include "support/error.h"
#include "support/stepped_tasks.h"

namespace carreau::molecule {

namespace {

constexpr std::size_t balls_a_task = 64;

/// Vertices of all balls, in order of the smallest ball.
std::vector<Vertex> all_vertices(std::span<const Ball> balls, const Neighbours& neighbours, int threads,
                                 Monitor& monitor, Doubts& doubts) {
  const std::size_t tasks = (balls.size() + balls_a_task - 1) / balls_a_task;
  std::vector<std::vector<Vertex>> found(tasks);
  std::vector<Doubts> doubted(tasks);
  run_each(
      tasks, false, threads,
      [&](std::size_t task, Monitor& run) {
        run.checkpoint();
        const std::size_t end = std::min(balls.size(), (task + 1) * balls_a_task);
        for (std::size_t i = task * balls_a_task; i < end; ++i)
          find_vertices(balls, neighbours, static_cast<int>(i), found[task], doubted[task]);
      },
      monitor);
  std::vector<Vertex> all;
  for (std::size_t task = 0; task < tasks; ++task) {
    all.insert(all.end(), found[task].begin(), found[task].end());
    doubts.add(doubted[task]);
  }
  return all;
}

/// A vertex as an end of arcs of one of its three circles.
struct ArcEnd {
  int i = 0, j = 0, vertex = 0;
  double angle = 0;
  bool starts = false;  ///< the circle leaves the third ball here as angles grow
};

std::vector<ArcEnd> ends_on_circles(const std::vector<Vertex>& vertices) {
  std::vector<ArcEnd> ends;
  ends.reserve(3 * vertices.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const std::array<int, 3>& b = vertices[v].balls;
    for (const auto& [i, j] : {std::pair{b[0], b[1]}, {b[0], b[2]}, {b[1], b[2]}})
      ends.push_back({.i = i, .j = j, .vertex = static_cast<int>(v)});
  }
  std::sort(ends.begin(), ends.end(), [](const ArcEnd& p, const ArcEnd& q) {
    return std::tie(p.i, p.j, p.vertex) < std::tie(q.i, q.j, q.vertex);
  });
  return ends;
}

/// Arcs between the ends on one circle: from each start to the next end.
void add_arcs(std::span<ArcEnd> ends, const Circle& circle, Arrangement& a, Doubts& doubts) {
  const int rank = static_cast<int>(a.circles.size());
  a.circles.push_back(circle);
  for (ArcEnd& end : ends) {
    const Vertex& v = a.vertices[end.vertex];
    const int third = v.balls[0] + v.balls[1] + v.balls[2] - circle.i - circle.j;
    end.angle = circle.angle(v.x);
    end.starts = dot(v.x - a.balls[third].centre, circle.tangent(end.angle)) > 0;
  }
  std::sort(ends.begin(), ends.end(), [](const ArcEnd& p, const ArcEnd& q) { return p.angle < q.angle; });
  for (std::size_t e = 0; e < ends.size(); ++e) {
    const ArcEnd &from = ends[e], &to = ends[(e + 1) % ends.size()];
    if (from.starts == to.starts) {
      for (const ArcEnd& end : ends) {
        const std::array<int, 3>& b = a.vertices[end.vertex].balls;
        doubts.add({b[0], b[1], b[2]});
      }
      return;
    }
    if (!from.starts) continue;
    const double b = to.angle > from.angle ? to.angle : to.angle + 2 * std::numbers::pi;
    a.arcs.push_back({rank, from.vertex, to.vertex, from.angle, b});
  }
}

/// The circle of a pair has no vertex: it is covered wholly or not at all.
void add_whole_circle(const Circle& circle, const Neighbours& neighbours, Arrangement& a, Doubts& doubts) {
  const std::array<int, 2> but{circle.i, circle.j};
  const CoverTest test{a.balls, neighbours.of(circle.i), 1e-12 * a.balls[circle.i].radius};
  int ball = -1;
  Cover cover = Cover::doubtful;
  for (const double angle : {0.3, 2.5, 4.7}) {  // a ball may touch the circle at one of them
    cover = test.of(circle.point(angle), but, ball);
    if (cover != Cover::doubtful) break;
  }
  if (cover == Cover::doubtful) doubts.add({circle.i, circle.j, ball});
  if (cover != Cover::no) return;
  a.arcs.push_back({.circle = static_cast<int>(a.circles.size()), .a = 0, .b = 2 * std::numbers::pi});
  a.circles.push_back(circle);
}

void find_arcs(const Neighbours& neighbours, Arrangement& a, Doubts& doubts) {
  std::vector<ArcEnd> ends = ends_on_circles(a.vertices);
  auto at = ends.begin();
  for (int i = 0; i < static_cast<int>(a.balls.size()); ++i)
    for (const int j : neighbours.of(i)) {
      if (j < i) continue;
      const auto first = at;
      while (at != ends.end() && at->i == i && at->j == j) ++at;
      const Circle circle = circle_of_pair(a.balls, i, j);
      if (first != at)
        add_arcs({first, at}, circle, a, doubts);
      else
        add_whole_circle(circle, neighbours, a, doubts);
    }
}

/// In [0, 1[, of ranks alone.
double share_of(int ball, int round) {
  std::uint64_t hash = static_cast<std::uint64_t>(ball) * 0x9e3779b97f4a7c15U + static_cast<std::uint64_t>(round);
  hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9U;
  hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebU;
  return static_cast<double>((hash ^ (hash >> 31)) >> 11) * 0x1p-53;
}

/// Marks arcs of at most a millionth of the smaller radius. A small loop with a longer arc, or an arc of such a loop,
/// keeps all of its arcs: otherwise the others would not close.
void mark_tiny_arcs(Arrangement& a) {
  constexpr double tiny = 1e-6, small_loop = 1e3;  // small_loop: longest arc of a loop, in lengths of a tiny one
  std::vector<double> share;                       // of the length of a tiny arc
  for (const Arc& arc : a.arcs) {
    const Circle& c = a.circles[arc.circle];
    share.push_back(c.radius * (arc.b - arc.a) / (tiny * std::min(a.balls[c.i].radius, a.balls[c.j].radius)));
  }
  std::vector<char> kept(a.arcs.size());
  std::transform(share.begin(), share.end(), kept.begin(), [](double s) { return s > 1 ? 1 : 0; });
  std::vector<const Loop*> small;
  for (const Component& component : a.components)
    for (const Loop& loop : component.loops)
      if (std::all_of(loop.begin(), loop.end(), [&](const ArcUse& use) { return share[use.arc] <= small_loop; }))
        small.push_back(&loop);
  for (bool changed = true; changed;) {
    const auto whole = std::partition(small.begin(), small.end(), [&](const Loop* loop) {
      return std::none_of(loop->begin(), loop->end(), [&](const ArcUse& use) { return kept[use.arc] != 0; });
    });
    changed = whole != small.end();
    for (auto loop = whole; loop != small.end(); ++loop)
      for (const ArcUse& use : **loop) kept[use.arc] = 1;
    small.erase(whole, small.end());
  }
  for (std::size_t k = 0; k < a.arcs.size(); ++k) a.arcs[k].tiny = kept[k] == 0;
}

/// True when all decisions are sure.
bool decide(Arrangement& a, int threads, Monitor& monitor, Doubts& doubts) {
  const Neighbours neighbours(a.balls);
  a.meeting_pairs = neighbours.pair_count();
  for (std::size_t i = 0; i < a.balls.size(); ++i) a.held_by[i] = neighbours.held_by(static_cast<int>(i));
  a.circles.clear(), a.arcs.clear(), a.components.clear();
  a.vertices = all_vertices(a.balls, neighbours, threads, monitor, doubts);
  if (!doubts.none()) return false;
  find_arcs(neighbours, a, doubts);
  if (!doubts.none() || !find_components(neighbours, a)) return false;
  mark_tiny_arcs(a);
  return true;
}

}  // namespace

SpaceLoop Arrangement::space_loop(const Loop& loop) const {
  SpaceLoop arcs_in_space;
  for (const ArcUse& use : loop) arcs_in_space.push_back(space_arc(use));
  return arcs_in_space;
}

int Arrangement::euler_number() const {
  int number = static_cast<int>(vertices.size());
  for (const Component& c : components) number += 2 - static_cast<int>(c.loops.size());
  for (const Arc& arc : arcs) number -= arc.whole() ? 0 : 1;
  return number;
}

Arrangement arrange(std::span<const Ball> balls, int threads, Monitor& monitor) {
  check_balls(balls);
  Arrangement a;
  a.balls.assign(balls.begin(), balls.end());
  a.held_by.assign(balls.size(), -1);
  constexpr int rounds = 8;
  for (int round = 0; round < rounds; ++round) {
    Doubts doubts;
    if (decide(a, threads, monitor, doubts)) return a;
    const std::vector<int> doubted = doubts.list();
    constexpr double most = 1e-9;
    for (const int i : doubted) a.balls[i].radius = balls[i].radius * (1 + most * (1 + share_of(i, round)));
    const std::vector<int> before = a.moved;
    a.moved.clear();
    std::set_union(before.begin(), before.end(), doubted.begin(), doubted.end(), std::back_inserter(a.moved));
  }
  throw InvalidArgument("the spheres of atoms " + std::to_string(a.moved.empty() ? 0 : a.moved.front() + 1) +
                        " and others meet too nearly in one point to decide their order");
}

}  // namespace carreau::molecule
