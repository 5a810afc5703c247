// SPDX-License-Identifier: BSD-3-Clause
#include "gradation/gradation.h"

#include <algorithm>
#include <cmath>

#include "gradation/graph_walk.h"
#include "gradation/thresholds.h"
#include "support/angles.h"
#include "support/error.h"
#include "support/format.h"
#include "support/incidence.h"
#include "support/infinity.h"

namespace carreau {

namespace {

using detail::facing;
using detail::roll;

using namespace thresholds::gradation;

Vec3 resized(const Vec3& v, double length) noexcept {
  const double l = norm(v);
  return l > 0 ? (length / l) * v : Vec3{};
}

/// Front at a vertex: h = source_h + slope |line|.
struct Front {
  double h = infinity, source_h = infinity;
  Vec3 line;      // from the source, in the tangent plane of `place`
  int place = 0;  // in GradationGraph::places; -1: a vertex without place
  int source = 0;
  bool accepted = false;
};

/// Dijkstra's order over the vertices. Each holds the line from its source, as a tangent vector. An edge away, the line
/// is this vector plus the edge (Danielsson's transform, rolled over the surface). A front from many sources passes
/// through the inside of triangles as a plane wave.
class Grading : detail::GraphWalk<Front> {
 public:
  Grading(const GradationGraph& graph, const std::vector<double>& h, double slope, Monitor& monitor)
      : GraphWalk(graph, std::vector<Front>(graph.xyz.size()), slope, monitor),
        segments_(graph.xyz.size(), graph.segments),
        joined_(graph.xyz.size(), graph.joined) {
    for (std::size_t v = 0; v < h.size(); ++v) front_[v].h = front_[v].source_h = h[v];
  }

  void add(const GradationSource& s, int id) {
    Front& f = front_[graph_.places[s.place].vertex];
    const double h = s.front.source_h + slope_ * norm(s.front.line);
    if (h < f.h) f = {h, s.front.source_h, s.front.line, s.place, id, false};
  }

  void run() {
    for (std::size_t v = 0; v < front_.size(); ++v) {
      if (dot(front_[v].line, front_[v].line) == 0) {
        front_[v].source = static_cast<int>(v);
        front_[v].place = fans_.first(static_cast<int>(v));
      }
      if (std::isfinite(front_[v].h)) queue_.push(front_[v].h, static_cast<int>(v));
    }
    queue_.run([this](double h, int v) { return !front_[v].accepted && h == front_[v].h; }, [this](int v) { leave(v); },
               monitor_);
  }

  [[nodiscard]] GradationFronts fronts() const {
    GradationFronts result;
    result.h.reserve(front_.size());
    for (const Front& f : front_) {
      result.h.push_back(f.h);
      const bool is_vertex = std::isfinite(f.h) && f.source < static_cast<int>(front_.size());
      result.source.push_back(is_vertex ? f.source : -1);
    }
    result.front.resize(graph_.places.size());
    for (std::size_t p = 0; p < graph_.places.size(); ++p) {
      const int v = graph_.places[p].vertex;
      Vec3 line;
      if (carry(v, static_cast<int>(p), line))
        result.front[p] = {front_[v].source_h, line};
      else
        result.front[p] = {front_[v].h, {}};
    }
    return result;
  }

 private:
  [[nodiscard]] Front& front_at(int place) noexcept { return front_[vertex(place)]; }

  /// Carries the line of a vertex to another of its places; returns false when the surface cannot be unfolded there.
  bool carry(int v, int to, Vec3& line) const noexcept {
    line = front_[v].line;
    return fans_.carry(front_[v].place, to, line);
  }

  void leave(int v) {
    front_[v].accepted = true;
    for (int p = fans_.first(static_cast<int>(v)); p >= 0; p = fans_.next(p)) {
      Front from = front_[v];
      from.place = p;
      if (!carry(v, p, from.line)) from = restarted(v, p);
      step_from(p, [&](int beside, int to) {
        along_edge(from, v, to);
        through_triangle(from, beside, to);
      });
    }
    leave_joined(v);
    for (const std::int32_t s : segments_.of(v)) {
      const int to = graph_.segments[s][graph_.segments[s][0] == v ? 1 : 0];
      const double length = norm(graph_.xyz[to] - graph_.xyz[v]);
      improve(to, {front_[v].h + slope_ * length, front_[v].h + slope_ * length, {}, fans_.first(to), v, false});
    }
  }

  void leave_joined(int v) {
    for (const std::int32_t s : joined_.of(v)) {
      const int to = graph_.joined[s][graph_.joined[s][0] == v ? 1 : 0];
      improve(to, {front_[v].h, front_[v].h, {}, fans_.first(to), v, false});
    }
  }

  [[nodiscard]] Front restarted(int v, int place) const noexcept {
    return {front_[v].h, front_[v].h, {}, place, v, false};
  }

  void improve(int v, const Front& candidate) {
    if (front_[v].accepted || !(candidate.h < front_[v].h)) return;
    front_[v] = candidate;
    queue_.push(candidate.h, v);
  }

  /// The edge from `from` to place `to` in the tangent plane of `from`, as long as the arc above it.
  [[nodiscard]] Vec3 unrolled_edge(int from, int to) const noexcept {
    const Vec3 n = normal(from), e = position(to) - position(from);
    const double length = norm(e);
    if (!(length > 0)) return {};
    // A circle that turns by t has the chord sin(t / 2) / (t / 2) times the arc.
    const Vec3 m = facing(n, normal(to));
    const double turn = std::min(1., std::abs(dot(m - n, e)) / length);
    return resized(e - dot(n, e) * n, length * (1 + turn * turn / 24));
  }

  void along_edge(const Front& from, int v, int to) {
    if (front_at(to).accepted) return;
    const Vec3 e = unrolled_edge(from.place, to);
    const Vec3 line = from.line + e;
    const double length = norm(line), edge = norm(e);
    const bool seen = dot(line, e) >= angles::cosine_of_45 * length * edge;
    Front candidate = seen ? Front{from.source_h + slope_ * length, from.source_h, line, to, from.source, false}
                           : Front{front_[v].h + slope_ * edge, front_[v].h, e, to, v, false};
    const Vec3 n = normal(from.place);
    candidate.line = resized(roll(candidate.line, n, facing(n, normal(to))), norm(candidate.line));
    improve(vertex(to), candidate);
  }

  /// Plane wave through the edge between two accepted vertices of a triangle (as in fast marching).
  void through_triangle(const Front& from, int beside, int to) {
    const Front& other = front_at(beside);
    if (!other.accepted || front_at(to).accepted || other.source == from.source) return;
    Vec3 line;
    if (!carry(vertex(beside), beside, line)) return;
    if (dot(from.line, line) < angles::cosine_of_45 * norm(from.line) * norm(line)) return;
    const Vec3 a = position(from.place), ab = position(beside) - a, ac = position(to) - a;
    const double width = norm(ab);
    if (!(width > 0)) return;
    const Vec3 x = (1 / width) * ab;
    const double along = dot(ac, x);
    const Vec3 up = ac - along * x;
    const double height = norm(up);
    const double climb = (other.h - front_at(from.place).h) / (slope_ * width);
    if (!(height > 0) || std::abs(climb) >= 1) return;
    const double steep = std::sqrt(1 - climb * climb);
    const double crossing = along - climb * height / steep;
    if (!(crossing > 0 && crossing < width)) return;
    const double h = front_at(from.place).h + slope_ * (climb * along + steep * height);
    const double length = std::lerp(norm(from.line), norm(line), crossing / width) + height / steep;
    const Vec3 n = normal(to), direction = climb * x + (steep / height) * up;
    improve(vertex(to), {h, h - slope_ * length, resized(direction - dot(n, direction) * n, length), to,
                                       2 * crossing < width ? from.source : other.source, false});
  }

  std::vector<Front>& front_ = values_;  // by vertex
  Incidence segments_, joined_;
};

void check(const GradationGraph& graph, const std::vector<double>& h, double slope) {
  detail::check_slope(slope);
  if (h.size() != graph.xyz.size())
    throw InvalidArgument("a gradation has " + std::to_string(h.size()) + " sizes for " +
                          std::to_string(graph.xyz.size()) + " vertices");
  const auto outside = [](int i, std::size_t n) { return i < 0 || static_cast<std::size_t>(i) >= n; };
  bool fits = true;
  for (const auto& p : graph.places) fits = fits && !outside(p.vertex, graph.xyz.size());
  for (const auto& t : graph.triangles)
    for (const int p : t) fits = fits && !outside(p, graph.places.size());
  for (const auto& s : graph.segments)
    for (const int v : s) fits = fits && !outside(v, graph.xyz.size());
  if (!fits) throw InvalidArgument("an index of a gradation's graph is out of range");
  for (const double size : h)
    if (!(size > 0)) throw InvalidArgument("a size of a gradation must be positive; it is " + format_number(size));
}

}  // namespace

void detail::check_slope(double slope) {
  if (!(slope > 0) || !std::isfinite(slope))
    throw InvalidArgument("the slope of a gradation must be positive; it is " + format_number(slope));
}

double slope_of_gradation(double beta) {
  if (!(beta > 1) || !std::isfinite(beta))
    throw InvalidArgument("a gradation must be greater than 1; it is " + format_number(beta));
  return std::log(beta);
}

double size_from_segment(double h_a, double h_b, const Vec3& edge, const Vec3& d, double slope) noexcept {
  const double length = norm(edge);
  if (!(length > 0)) return infinity;
  const double climb = (h_b - h_a) / (slope * length);
  const double along = dot(d, edge) / length;
  const double up = std::sqrt(std::max(0., dot(d, d) - along * along));
  double foot = climb >= 1 ? 0. : climb <= -1 ? length : along - climb * up / std::sqrt(1 - climb * climb);
  foot = std::clamp(foot, 0., length);
  return h_a + (h_b - h_a) * (foot / length) + slope * std::hypot(along - foot, up);
}

GradationFronts grade_fronts(const GradationGraph& graph, const std::vector<double>& h,
                             const std::vector<GradationSource>& sources, double slope, Monitor& monitor) {
  check(graph, h, slope);
  Grading grading(graph, h, slope, monitor);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (sources[i].place < 0 || static_cast<std::size_t>(sources[i].place) >= graph.places.size())
      throw InvalidArgument("an index of a gradation's source is out of range");
    // Numbers after the numbers of vertices.
    grading.add(sources[i], static_cast<int>(graph.xyz.size() + i));
  }
  grading.run();
  return grading.fronts();
}

}  // namespace carreau
