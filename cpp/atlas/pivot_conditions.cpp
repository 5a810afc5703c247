// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "atlas/pivots.h"
#include "atlas/thresholds.h"
#include "predicates/predicates.h"
#include "support/rounding_of.h"

namespace carreau::atlas {
namespace {

/// Returns whether the edge from a to b, relative to the pivot, is visible under an angle, and not along itself.
bool well_seen(const Vec2& a, const Vec2& b, const Vec2& edge) {
  const double twice_area = std::abs(cross(a, edge));
  return std::abs(std::atan2(cross(a, b), dot(a, b))) > rounding_of::sizes &&
         twice_area > thresholds::min_slope * norm(edge) * std::max(norm(a), norm(b));
}

class Conditions {
 public:
  Conditions(const Polygon& loop, Pivots& pivots)
      : loop_(loop), pivots_(pivots), n_(pivots.size()), m_(loop.size()), wrong_(n_, 0) {
    pivots_.crossed.assign(n_, m_);
  }

  std::vector<char> check() {
    for (std::size_t k = 0; k < n_; ++k) find_crossing(k);
    std::size_t turns = 0;
    for (std::size_t k = 0; k < n_; ++k) turns += check_part(k);
    if (turns != m_) wrong_.assign(n_, 1);
    for (std::size_t k = 0; k < n_; ++k) check_chain(k);
    if (!is_inside(loop_, place(0))) wrong_[0] = 1;
    return wrong_;
  }

 private:
  [[nodiscard]] const Vec2& place(std::size_t k) const { return pivots_.place[k % n_]; }
  [[nodiscard]] const Vec2& vertex(std::size_t v) const { return loop_[v % m_]; }

  /// One edge, and no vertex.
  void find_crossing(std::size_t k) {
    std::size_t met = 0;
    for (std::size_t e = 0; e < m_; ++e) {
      if (!segments_meet(place(k), place(k + 1), vertex(e), vertex(e + 1))) continue;
      ++met;
      if (segments_cross(place(k), place(k + 1), vertex(e), vertex(e + 1))) pivots_.crossed[k] = e;
    }
    if (met != 1 || pivots_.crossed[k] == m_) wrong_[k] = wrong_[(k + 1) % n_] = 1, pivots_.crossed[k] = m_;
  }

  /// Checks the part of the loop that pivot k sees; returns the number of its edges.
  std::size_t check_part(std::size_t k) {
    const std::size_t from = pivots_.crossed[(k + n_ - 1) % n_], to = pivots_.crossed[k];
    if (from == m_ || to == m_) return 0;
    const int side = pivots_.is_inside(k) ? 1 : -1;
    const bool ahead = orientation(place(k), place(k + n_ - 1), place(k + 1)) == side;
    const std::size_t edges = from != to ? (to + m_ - from) % m_ : (ahead ? 0 : m_);
    double angle = 0;
    for (std::size_t e = from; e <= from + edges; ++e) {
      if (orientation(place(k), vertex(e), vertex(e + 1)) != side) wrong_[k] = 1;
      const Vec2 a = e == from ? Vec2(place(k + n_ - 1) - place(k)) : Vec2(vertex(e) - place(k));
      const Vec2 b = e == from + edges ? Vec2(place(k + 1) - place(k)) : Vec2(vertex(e + 1) - place(k));
      if (!well_seen(vertex(e) - place(k), vertex(e + 1) - place(k), vertex(e + 1) - vertex(e))) wrong_[k] = 1;
      const double seen = std::abs(std::atan2(cross(a, b), dot(a, b)));
      if (!(seen > rounding_of::sizes)) wrong_[k] = 1;
      angle += seen;
    }
    if (!(angle < 2 * std::numbers::pi)) wrong_[k] = 1;
    return edges;
  }

  void check_chain(std::size_t k) {
    const Vec2 &a = place(k), &b = place(k + 1), &c = place(k + 2);
    if (a == b || (orientation(a, b, c) == 0 && dot(b - a, c - b) < 0)) wrong_[k] = wrong_[(k + 1) % n_] = 1;
    for (std::size_t l = k + 2; l < n_; ++l)
      if ((l + 1) % n_ != k && segments_meet(a, b, place(l), place(l + 1)))
        wrong_[k] = wrong_[k + 1] = wrong_[l] = wrong_[(l + 1) % n_] = 1;
  }

  const Polygon& loop_;
  Pivots& pivots_;
  std::size_t n_, m_;
  std::vector<char> wrong_;
};

}  // namespace

std::vector<char> wrong_pivots(const Polygon& loop, Pivots& pivots) {
  if (pivots.size() > 2) return Conditions(loop, pivots).check();
  std::vector<char> wrong(pivots.size(), pivots.size() == 2);
  pivots.crossed.assign(pivots.size(), 0);
  for (std::size_t v = 0; v < loop.size() && pivots.size() == 1; ++v) {
    const Vec2 a = loop[v] - pivots.place[0], b = loop[next_of(v, loop.size())] - pivots.place[0];
    const bool seen = orientation(pivots.place[0], loop[v], loop[next_of(v, loop.size())]) == 1;
    if (!seen || !well_seen(a, b, b - a)) wrong[0] = 1;
  }
  return wrong;
}

double room_around(const Polygon& loop, const Vec2& place) {
  double nearest = std::numeric_limits<double>::infinity(), reach = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 edge = loop[next_of(i, loop.size())] - loop[i];
    nearest = std::min(nearest, cross(edge, place - loop[i]) / norm(edge)),
    reach = std::max(reach, norm(loop[i] - loop[0]));
  }
  return std::max(0.0, nearest / reach);
}

StarCentre star_centre(const Polygon& loop) {
  Vec2 centroid(0, 0);
  double area = 0, reach = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 a = loop[i] - loop[0], b = loop[next_of(i, loop.size())] - loop[0];
    area += cross(a, b) / 2, centroid += (a + b) * (cross(a, b) / 6), reach = std::max(reach, norm(a));
  }
  // Searches the point that is farthest from the lines of all edges: steps away from the nearest line, ever smaller.
  StarCentre best;
  double furthest = 0, step = reach / 4;
  Vec2 place = loop[0] + centroid / area;
  constexpr int steps = 60;
  for (int k = 0; k < steps; ++k, step *= .9) {
    double nearest = std::numeric_limits<double>::infinity();
    Vec2 away(0, 0);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 edge = (loop[next_of(i, loop.size())] - loop[i]) / norm(loop[next_of(i, loop.size())] - loop[i]);
      const double distance = cross(edge, place - loop[i]);
      if (distance < nearest) nearest = distance, away = Vec2(-edge.y(), edge.x());
    }
    if (nearest > furthest) furthest = nearest, best = {true, place, nearest / reach};
    place += step * away;
  }
  Pivots single{{best.place}};
  if (!best.found || wrong_pivots(loop, single)[0] != 0) return {};
  return best;
}

}  // namespace carreau::atlas
