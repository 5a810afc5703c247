// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/molecule/models/probes.h"

#include <algorithm>
#include <map>
#include <numbers>

#include "geometry/molecule/triples.h"

namespace carreau::molecule {

namespace {

constexpr double turn = 2 * std::numbers::pi;

/// A place of a circle of crossing where the situation may change.
struct Mark {
  double angle = 0;
  int point = 0;
};

/// Circles of the arrangement by their balls.
using CircleOf = std::map<std::pair<int, int>, int>;

class Crossings {
 public:
  Crossings(const Arrangement& a, std::span<const ProbeTriangle> probes, std::span<const Tips> tips,
            NextReferences& next)
      : a_(a), probes_(probes), tips_(tips), next_(next) {
    for (const ProbeTriangle& probe : probes) balls_.push_back(probe.ball());
    for (std::size_t c = 0; c < a.circles.size(); ++c)
      circle_of_[{a.circles[c].i, a.circles[c].j}] = static_cast<int>(c);
  }

  std::vector<ProbeCrossing> find() {
    const Neighbours neighbours(balls_);
    find_triple_points(neighbours);
    std::vector<ProbeCrossing> found;
    for (int v = 0; v < static_cast<int>(balls_.size()); ++v)
      for (const int w : neighbours.of(v))
        if (w > v) add_pair(v, w, neighbours, found);
    return found;
  }

 private:
  /// Spindles about which all of some probes roll.
  [[nodiscard]] std::vector<const Tips*> common_spindles(std::span<const int> vertices) const {
    std::vector<const Tips*> common;
    const std::array<int, 3>& b = a_.vertices[vertices.front()].balls;
    for (const auto& [i, j] : {std::pair{b[0], b[1]}, {b[0], b[2]}, {b[1], b[2]}}) {
      const bool all = std::all_of(vertices.begin(), vertices.end(), [&, i = i, j = j](int v) {
        const std::array<int, 3>& other = a_.vertices[v].balls;
        return std::count(other.begin(), other.end(), i) != 0 && std::count(other.begin(), other.end(), j) != 0;
      });
      if (!all) continue;
      const Tips& tips = tips_[circle_of_.at({i, j})];
      if (tips.low != 0) common.push_back(&tips);
    }
    return common;
  }

  void find_triple_points(const Neighbours& neighbours) {
    std::vector<Vertex> points;
    Doubts ignored;  // tips of spindles, where many probes meet
    for (int v = 0; v < static_cast<int>(balls_.size()); ++v) find_vertices(balls_, neighbours, v, points, ignored);
    for (const Vertex& point : points) {
      if (!common_spindles(point.balls).empty()) continue;
      const auto& b = point.balls;
      if (!std::all_of(b.begin(), b.end(), [&](int v) { return probes_[v].holds(point.x); })) continue;
      const int reference = next_.point++;
      for (const auto& [v, w] : {std::pair{b[0], b[1]}, {b[0], b[2]}, {b[1], b[2]}})
        triple_points_[{v, w}].push_back({point.x, reference});
    }
  }

  void add_pair(int v, int w, const Neighbours& neighbours, std::vector<ProbeCrossing>& found) {
    const Circle c = circle_of_pair(balls_, v, w);
    std::vector<Mark> marks;
    const std::array<int, 2> both{v, w};
    for (const Tips* tips : common_spindles(both)) {
      marks.push_back({c.angle(tips->at_low), tips->low});
      marks.push_back({c.angle(tips->at_high), tips->high});
    }
    if (const auto points = triple_points_.find({v, w}); points != triple_points_.end())
      for (const auto& [x, reference] : points->second) marks.push_back({c.angle(x), reference});
    std::sort(marks.begin(), marks.end(), [](const Mark& p, const Mark& q) { return p.angle < q.angle; });
    const CoverTest test{balls_, neighbours.of(v), 0};
    const auto bare = [&](double angle) {
      const Vec3 p = c.point(angle);
      int ignored = -1;
      return probes_[v].holds(p) && probes_[w].holds(p) && test.of(p, both, ignored) == Cover::no;
    };
    const auto add = [&](int start, int end, double a, double b) {
      found.push_back({v, w, {next_.curve++, start, end, {c.centre, c.e1, c.e2, c.radius, a, b, false}}});
    };
    if (marks.empty() && bare(0.3)) {
      const int p = next_.point++, q = next_.point++;
      add(p, q, 0, turn / 2);
      add(q, p, turn / 2, turn);
    }
    for (std::size_t k = 0; k < marks.size(); ++k) {
      const bool last = k + 1 == marks.size();
      const Mark& to = marks[last ? 0 : k + 1];
      const double b = to.angle + (last ? turn : 0);
      if (bare((marks[k].angle + b) / 2)) add(marks[k].point, to.point, marks[k].angle, b);
    }
  }

  const Arrangement& a_;
  std::span<const ProbeTriangle> probes_;
  std::span<const Tips> tips_;
  NextReferences& next_;
  std::vector<Ball> balls_;
  CircleOf circle_of_;
  struct TriplePoint {
    Vec3 x;
    int reference = 0;
  };
  std::map<std::pair<int, int>, std::vector<TriplePoint>> triple_points_;
};

}  // namespace

ProbeTriangle::ProbeTriangle(const Arrangement& a, int vertex, double probe) : ball_{a.vertices[vertex].x, probe} {
  const std::array<int, 3>& b = a.vertices[vertex].balls;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 p = a.balls[b[k]].centre - ball_.centre, q = a.balls[b[(k + 1) % 3]].centre - ball_.centre;
    const Vec3 r = a.balls[b[(k + 2) % 3]].centre - ball_.centre, normal = cross(p, q);
    inward_[k] = dot(normal, r) > 0 ? normal : Vec3(-normal);
  }
}

bool ProbeTriangle::holds(const Vec3& p) const {
  const Vec3 d = p - ball_.centre;
  return std::all_of(inward_.begin(), inward_.end(), [&](const Vec3& n) { return dot(d, n) > 0; });
}

std::vector<ProbeCrossing> find_crossings(const Arrangement& a, std::span<const ProbeTriangle> probes,
                                          std::span<const Tips> tips, NextReferences& next) {
  return Crossings(a, probes, tips, next).find();
}

std::optional<std::vector<ProbePart>> parts_of_probe(int vertex, const ProbeTriangle& triangle,
                                                     std::vector<ProbeArc> pieces,
                                                     const std::function<bool(const Vec3&)>& bare) {
  std::vector<ProbeLoop> loops;
  std::vector<SpaceLoop> in_space;
  while (!pieces.empty()) {
    ProbeLoop loop{pieces.front()};
    pieces.erase(pieces.begin());
    while (loop.back().end != loop.front().start) {
      const auto next = std::find_if(pieces.begin(), pieces.end(),
                                     [&](const ProbeArc& piece) { return piece.start == loop.back().end; });
      if (next == pieces.end()) return {};
      loop.push_back(*next);
      pieces.erase(next);
    }
    SpaceLoop arcs;
    for (const ProbeArc& piece : loop) arcs.push_back(piece.arc);
    in_space.push_back(std::move(arcs));
    loops.push_back(std::move(loop));
  }
  const std::vector<std::size_t> part = parts_of_loops(triangle.ball(), in_space, bare);
  std::vector<ProbePart> parts;
  std::vector<int> rank(loops.size(), -1);
  for (std::size_t l = 0; l < loops.size(); ++l) {
    int& p = rank[part[l]];
    if (p < 0) p = static_cast<int>(parts.size()), parts.push_back({vertex, {}});
    parts[p].loops.push_back(std::move(loops[l]));
  }
  return parts;
}

}  // namespace carreau::molecule
