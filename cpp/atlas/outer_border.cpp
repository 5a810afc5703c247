// SPDX-License-Identifier: BSD-3-Clause
#include "atlas/outer_border.h"

#include <cmath>
#include <limits>

#include "atlas/thresholds.h"
#include "support/error.h"
#include "support/rounding_of.h"

namespace carreau::atlas {
namespace {

/// A segment that stops rays.
struct Obstacle {
  Vec2 a, b;
  double kept;  ///< the share of the way to it that the annulus may use
};

std::vector<Obstacle> obstacles_of(const Polygon& inner, const Polygon& outer, std::span<const Part> parts) {
  std::vector<Obstacle> obstacles;
  const auto add = [&](const Polygon& loop, double kept) {
    for (std::size_t i = 0; i < loop.size(); ++i) obstacles.push_back({loop[i], loop[next_of(i, loop.size())], kept});
  };
  constexpr double whole = 1, nearly = 0.9;
  add(outer, whole), add(inner, thresholds::shared_gap);
  Polygon chain;
  for (const Part& p : parts) chain.push_back(p.pivot);
  if (chain.size() > 2) add(chain, nearly);
  return obstacles;
}

/// The view of one pivot beyond the inner border; a pivot outside looks at the near side of it.
class View {
 public:
  View(const Part& part, std::span<const Obstacle> obstacles) : part_(part), obstacles_(obstacles) {}

  OuterPieces pieces() const {
    const std::vector<double> knots = directions();
    OuterPieces result;
    double before = unlimited();
    for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
      const double from = knots[k], to = knots[k + 1];
      const Sight sight = look((from + to) / 2);
      const double at_from = radius(sight, from), at_to = radius(sight, to);
      const double nearest = nearer(before, at_from);
      result.angle.push_back(from), result.radius.push_back(nearest);
      // If the view jumps, the border goes to the far side within a small part of the interval.
      constexpr double jump = 1.2, small_part = 0.1;
      const double after = k + 2 < knots.size() ? radius(look((to + knots[k + 2]) / 2), to) : at_to;
      const auto jumps = [&](double r, double limit) { return part_.side > 0 ? r > jump * limit : r * jump < limit; };
      for (const double share : {small_part, 1 - small_part})
        if (share < 0.5 ? jumps(at_from, nearest) : jumps(at_to, after)) {
          const double at = from + share * (to - from);
          result.angle.push_back(at), result.radius.push_back(radius(sight, at));
        }
      before = at_to;
    }
    result.angle.push_back(knots.back()), result.radius.push_back(before);
    return result;
  }

 private:
  /// The line that a ray meets, or nothing.
  struct Sight {
    const Obstacle* obstacle = nullptr;
    double radius = 0;
  };

  [[nodiscard]] double unlimited() const { return part_.side > 0 ? std::numeric_limits<double>::infinity() : 0; }
  [[nodiscard]] double nearer(double a, double b) const { return part_.side > 0 ? std::min(a, b) : std::max(a, b); }
  [[nodiscard]] double inner(double at) const { return radius_on(part_.line[interval_of(part_.angle, at)], at); }

  /// The first obstacle behind the inner border, as seen from the pivot.
  [[nodiscard]] Sight look(double at) const {
    const Pair<double> d = part_.direction(at);
    const Vec2 u(d[0], d[1]);
    const double rho = inner(at);
    constexpr double clear = 1e-9;
    Sight best{nullptr, unlimited()};
    for (const Obstacle& o : obstacles_) {
      const Vec2 a = o.a - part_.pivot, edge = o.b - o.a;
      const double determinant = cross(u, edge);
      if (determinant == 0) continue;
      const double r = cross(a, edge) / determinant, share = cross(a, u) / determinant;
      if (share < 0 || share > 1) continue;
      if (part_.side > 0 ? (r > rho * (1 + clear) && r < best.radius) : (r < rho * (1 - clear) && r > best.radius))
        best = {&o, r};
    }
    return best;
  }

  /// Radius of the outer border in a direction near the direction of the sight.
  [[nodiscard]] double radius(const Sight& sight, double at) const {
    const double rho = inner(at);
    const double least = part_.side > 0 ? 0 : thresholds::nearest_to_pivot * rho;
    if (sight.obstacle == nullptr) return least;
    double r = radius_on(line_through(part_, sight.obstacle->a, sight.obstacle->b), at);
    if (!(r > 0)) r = part_.side > 0 ? sight.radius : least;
    return std::max(least, rho + sight.obstacle->kept * (r - rho));
  }

  /// Angles between which one obstacle is visible and the inner border is straight.
  [[nodiscard]] std::vector<double> directions() const {
    std::vector<double> list = part_.angle;
    for (const Obstacle& o : obstacles_) {
      const Pair<double> p = part_.polar(Pair<double>{o.a.x(), o.a.y()});
      if (!(p[0] > 0 && p[0] < part_.total())) continue;
      const double rho = inner(p[0]), seen = look(p[0]).radius;
      constexpr double same = 1e-9;
      const bool visible = part_.side > 0 ? p[1] > rho * (1 + same) && p[1] <= seen * (1 + same)
                                          : p[1] < rho * (1 - same) && p[1] >= seen * (1 - same);
      if (visible) list.push_back(p[0]);
    }
    std::sort(list.begin(), list.end());
    return without_twins(list);
  }

  /// Knots of the part stay.
  [[nodiscard]] std::vector<double> without_twins(const std::vector<double>& list) const {
    const auto is_knot = [&](double at) { return std::binary_search(part_.angle.begin(), part_.angle.end(), at); };
    std::vector<double> kept;
    for (const double at : list) {
      if (kept.empty() || at - kept.back() > rounding_of::places)
        kept.push_back(at);
      else if (is_knot(at) && at != kept.back()) {
        if (is_knot(kept.back()))
          kept.push_back(at);
        else
          kept.back() = at;
      }
    }
    return kept;
  }

  const Part& part_;
  std::span<const Obstacle> obstacles_;
};

class Border {
 public:
  Border(std::span<const Part> parts, std::vector<OuterPieces> pieces) : parts_(parts), pieces_(std::move(pieces)) {
    for (std::size_t n = 0; n < parts_.size(); ++n)
      for (std::size_t k = 0; k < pieces_[n].angle.size(); ++k) room(n, k) = std::abs(room(n, k) - inner(n, k));
    agree_at_joints();
  }

  std::vector<OuterPieces> settle() {
    for (int round = 0; round < rounding_of::max_steps; ++round) {
      set_radii();
      if (!shrink_crossings()) return std::move(pieces_);
      agree_at_joints();
    }
    throw DomainError(Where{.uv = parts_[worst_].pivot},
                      "the outer border of the annulus crosses itself however near it comes to the inner one; its "
                      "parts are too near to one another there");
  }

 private:
  double& room(std::size_t n, std::size_t k) {
    if (rooms_.size() <= n) rooms_.resize(n + 1);
    if (rooms_[n].empty()) rooms_[n] = pieces_[n].radius;
    return rooms_[n][k];
  }
  [[nodiscard]] double inner(std::size_t n, std::size_t k) const {
    const double at = pieces_[n].angle[k];
    return radius_on(parts_[n].line[interval_of(parts_[n].angle, at)], at);
  }

  void agree_at_joints() {
    for (std::size_t n = 0; n < rooms_.size(); ++n) {
      std::vector<double>& next = rooms_[next_of(n, rooms_.size())];
      rooms_[n].back() = next.front() = std::min(rooms_[n].back(), next.front());
    }
  }

  void set_radii() {
    for (std::size_t n = 0; n < pieces_.size(); ++n)
      for (std::size_t k = 0; k < pieces_[n].angle.size(); ++k)
        pieces_[n].radius[k] = inner(n, k) + parts_[n].side * rooms_[n][k];
  }

  /// Leaves less room at the ends of edges that meet others.
  bool shrink_crossings() {
    struct Edge {
      Vec2 a, b;
      std::size_t part, k;
    };
    std::vector<Edge> edges;
    for (std::size_t n = 0; n < pieces_.size(); ++n)
      for (std::size_t k = 0; k + 1 < pieces_[n].angle.size(); ++k)
        edges.push_back({point_at(parts_[n], pieces_[n].angle[k], pieces_[n].radius[k]), Vec2(0, 0), n, k});
    for (std::size_t i = 0; i < edges.size(); ++i) edges[i].b = edges[next_of(i, edges.size())].a;
    std::vector<char> wrong(edges.size(), 0);
    for (std::size_t i = 0; i < edges.size(); ++i)
      for (std::size_t j = i + 2; j < edges.size(); ++j)
        if (next_of(j, edges.size()) != i && segments_meet(edges[i].a, edges[i].b, edges[j].a, edges[j].b))
          wrong[i] = wrong[j] = 1;
    std::vector<std::vector<char>> marked(pieces_.size());
    for (std::size_t n = 0; n < pieces_.size(); ++n) marked[n].assign(pieces_[n].angle.size(), 0);
    bool any = false;
    for (std::size_t i = 0; i < edges.size(); ++i)
      if (wrong[i] != 0)
        marked[edges[i].part][edges[i].k] = marked[edges[i].part][edges[i].k + 1] = 1, any = true,
        worst_ = edges[i].part;
    for (std::size_t n = 0; n < pieces_.size(); ++n)
      for (std::size_t k = 0; k < marked[n].size(); ++k)
        if (marked[n][k] != 0) rooms_[n][k] *= thresholds::slide;
    return any;
  }

  std::span<const Part> parts_;
  std::vector<OuterPieces> pieces_;
  std::vector<std::vector<double>> rooms_;
  std::size_t worst_ = 0;
};

}  // namespace

Vec2 OuterPieces::line(std::size_t k) const {
  const auto point = [&](std::size_t i) -> Vec2 {
    return {radius[i] * std::cos(angle[i]), radius[i] * std::sin(angle[i])};
  };
  const Vec2 p = point(k), q = point(k + 1);
  return Vec2(q.y() - p.y(), p.x() - q.x()) / cross(p, q);
}

Vec2 point_at(const Part& part, double angle, double radius) {
  const Pair<double> d = part.direction(angle);
  return {part.pivot.x() + radius * d[0], part.pivot.y() + radius * d[1]};
}

Polygon polygon_of(std::span<const Part> parts, std::span<const OuterPieces> pieces) {
  Polygon polygon;
  for (std::size_t n = 0; n < parts.size(); ++n)
    for (std::size_t k = 0; k + 1 < pieces[n].angle.size(); ++k)
      polygon.push_back(point_at(parts[n], pieces[n].angle[k], pieces[n].radius[k]));
  return polygon;
}

std::vector<OuterPieces> outer_pieces(const Polygon& inner, const Polygon& outer, std::span<const Part> parts) {
  const std::vector<Obstacle> obstacles = obstacles_of(inner, outer, parts);
  std::vector<OuterPieces> pieces;
  for (const Part& part : parts) pieces.push_back(View(part, obstacles).pieces());
  return Border(parts, std::move(pieces)).settle();
}

}  // namespace carreau::atlas
