// SPDX-License-Identifier: BSD-3-Clause
// The triangulation that the plane mesher works on: flat arrays of plain numbers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "metric/chart.h"
#include "metric/metric2.h"
#include "support/vec.h"

namespace carreau::plane {

/// 32 bytes. The tensor is cached in single precision: it steers, it decides no topology.
struct Vertex {
  double x = 0, y = 0;
  float a = 1, b = 0, c = 1;
  std::int32_t triangle = -1;  ///< one that holds it

  [[nodiscard]] Vec2 point() const noexcept { return {x, y}; }
  [[nodiscard]] Metric2 metric() const noexcept { return {a, b, c}; }
  void set_metric(Metric2 m) noexcept {
    a = static_cast<float>(m.a), b = static_cast<float>(m.b), c = static_cast<float>(m.c);
  }
};

/// The change of the field's directions and shapes about a vertex.
enum class Bend : std::uint8_t {
  none,    ///< mean tensors of vertices do
  smooth,  ///< a chart gives distances
  kinked,  ///< the field must be evaluated halfway, neither chart nor tensor is accurate
};

/// Half-edge i of triangle t lies opposite to its corner i and is written 4 t + i; -1: nothing beyond.
using HalfEdge = std::int32_t;
constexpr HalfEdge no_edge = -1;

/// State of a triangle for the front.
enum class Done : std::uint8_t {
  no,      ///< too large: points are still to be placed in it
  yes,     ///< small enough
  frozen,  ///< imposed with all its edges (round a degenerate side)
};

/// 32 bytes, counterclockwise. Edge i runs from corner i+1 to corner i+2.
struct Triangle {
  std::int32_t v[3] = {-1, -1, -1};
  HalfEdge n[3] = {no_edge, no_edge, no_edge};
  std::uint8_t imposed = 0;     ///< bit i: edge i is never swapped, crossed or removed
  std::uint8_t degenerate = 0;  ///< bit i: edge i is one point in space
  Done done = Done::no;
  std::uint8_t mark = 0;   ///< scratch, 0 between uses
  std::int32_t spare = 0;  ///< keeps triangles aligned to half a cache line
};

/// Hint to the processor; means nothing for the result.
inline void prefetch(const void* address) noexcept {
#if defined(__GNUC__) || defined(__clang__)
  __builtin_prefetch(address);
#else
  (void)address;
#endif
}

constexpr int next3[3] = {1, 2, 0}, prev3[3] = {2, 0, 1};

/// Vertex of a cavity as seen from the new point p.
struct RimPoint {
  double x, y;  ///< relative to p
  double d2;    ///< squared distance to p in the metric of p
  std::int32_t v;
};

/// Edge of the rim of a cavity: from rim point a to rim point b, counterclockwise about the new point p.
struct RimEdge {
  std::int32_t a, b;
  HalfEdge outside;
  std::uint8_t imposed, degenerate;
  bool crossed;  ///< p lies on it, so that it cannot stay
  double area;   ///< cross(a - p, b - p)
};

/// Distances that a new point keeps; zero: none.
struct InsertRules {
  double distance2 = 0;                    ///< squared metric distance to the cavity's vertices
  double height = 0;                       ///< to an imposed edge, in units of its length, at most 1
  double degenerate_height = 0;            ///< to a degenerate edge as a whole
  std::span<const std::int32_t> exempt{};  ///< vertices that need no distance
};

class Triangulation {
 public:
  std::vector<Vertex> vertices;
  std::vector<Triangle> triangles;
  /// By vertex. Empty: the field bends nowhere.
  std::vector<Bend> bends;

  /// Triangle that contains p (on its border counts), walking from triangle `hint`; -1 when the walk leaves the
  /// triangulation or meets an imposed edge.
  [[nodiscard]] int locate(const Vec2& p, int hint) const noexcept;
  /// Like locate(); returns -1 also when p is more than `max_steps` triangles away.
  [[nodiscard]] int locate_near(const Vec2& p, int hint, int max_steps) const noexcept;

  /// Digs the cavity of p from its triangle `start` (RR-2928 eq. 3-8, see README): star-shaped about p by exact tests.
  /// Returns false if the rules reject the point, or if it lies on an imposed edge or a vertex. `chart`: the chart of
  /// p, if the field bends much.
  bool dig(Vec2 p, Metric2 metric, int start, const InsertRules& rules, const Chart* chart = nullptr);
  /// The triangles dug out, until they are filled.
  [[nodiscard]] std::span<const std::int32_t> cavity() const noexcept { return {cavity_.data(), cavity_size_}; }
  /// Fills the cavity with triangles around the vertex p; `star()` lists them, `rim()` their outer edges in the same
  /// order (edge 0, opposite to p).
  void fill(int p);
  [[nodiscard]] std::span<const std::int32_t> star() const noexcept { return {cavity_.data(), rim_size_}; }
  [[nodiscard]] std::span<const RimEdge> rim() const noexcept { return {rim_.data(), rim_size_}; }
  [[nodiscard]] const RimPoint& rim_point(std::int32_t k) const noexcept { return points_[k]; }

  /// Sorts the triangles of a large mesh by their vertices, so that passes over them find memory in order. The kernel
  /// reuses the numbers of removed triangles for new ones anywhere.
  void renumber_if_large();

  /// The last triangles of the list take the places of the removed ones (without vertices).
  void drop_removed();

  /// Exchanges the diagonal of the two triangles at half-edge (t, i). They keep their numbers; the new diagonal is edge
  /// 1 of t and edge 2 of the other.
  void swap_edge(int t, int i) noexcept;
  /// True if both triangles of the other diagonal are counterclockwise. Exact.
  [[nodiscard]] bool can_swap(int t, int i) const noexcept;
  /// Puts vertex m, which lies on edge i of t, not imposed, between its ends: the two triangles keep their numbers, two
  /// more come last. Edge 0 of each of the four is a half of the edge.
  void split_edge(int t, int i, int m);
  /// A half-edge u - v in either direction among the triangles of u's fan, or no_edge.
  [[nodiscard]] HalfEdge find_edge(int u, int v) const noexcept;

  [[nodiscard]] Vec2 at(int v) const noexcept { return vertices[v].point(); }
  [[nodiscard]] int corner_of(int t, int v) const noexcept {
    const Triangle& T = triangles[t];
    return T.v[0] == v ? 0 : T.v[1] == v ? 1 : 2;
  }
  [[nodiscard]] bool is_bent(int u, int v) const noexcept {
    return !bends.empty() && (bends[u] != Bend::none || bends[v] != Bend::none);
  }
  [[nodiscard]] bool is_bent(int u, int v, int w) const noexcept {
    return !bends.empty() && (bends[u] != Bend::none || bends[v] != Bend::none || bends[w] != Bend::none);
  }
  [[nodiscard]] bool is_kinked(int u, int v) const noexcept {
    return !bends.empty() && (bends[u] == Bend::kinked || bends[v] == Bend::kinked);
  }
  [[nodiscard]] bool is_imposed(int t, int i) const noexcept { return (triangles[t].imposed >> i & 1) != 0; }
  /// Marks the edge imposed in both its triangles.
  void impose(HalfEdge he, bool degenerate) noexcept;
  /// Squared length of an edge in the mean of its ends' metrics.
  [[nodiscard]] double squared_length(int u, int v) const noexcept {
    const Vertex &P = vertices[u], &Q = vertices[v];
    const double dx = Q.x - P.x, dy = Q.y - P.y;
    return 0.5 * ((static_cast<double>(P.a) + Q.a) * dx * dx + 2.0 * (static_cast<double>(P.b) + Q.b) * dx * dy +
                  (static_cast<double>(P.c) + Q.c) * dy * dy);
  }
  /// Squared circumradius in the mean metric of the corners.
  [[nodiscard]] double squared_radius(int t) const noexcept;
  /// Q2 (HDR eq. 1.6) of the corners in their mean metric; 0 unless counterclockwise (exactly).
  [[nodiscard]] double quality(int p, int q, int r) const noexcept;

 private:
  static constexpr int blocked_walk = -1, unfinished_walk = -2;
  [[nodiscard]] int walk(const Vec2& p, int hint, std::size_t max_steps) const noexcept;
  template <bool charted>
  bool dig_in(Vec2 p, Metric2 metric, int start, const InsertRules& rules, const Chart* chart);
  [[nodiscard]] bool too_near(const Vec2& p, int v, double d2, const InsertRules& rules, bool in_chart) const noexcept;
  [[nodiscard]] bool in_far_circle(const Metric2& metric, const RimPoint& a, const RimPoint& b, const RimPoint& d,
                                   double sum, double area) const noexcept;
  [[nodiscard]] bool in_circle_of_chart(std::int32_t a, std::int32_t b, std::int32_t d) const noexcept;
  void reserve_cavity(std::size_t triangles);

  // Scratch of dig(), used as plain arrays: their sizes are capacities.
  std::vector<std::int32_t> cavity_;
  std::vector<RimPoint> points_;
  std::vector<Vec2> charted_;  // the same points in the chart of p, if there is one
  std::vector<RimEdge> rim_, stack_;
  std::size_t cavity_size_ = 0, rim_size_ = 0;
};

}  // namespace carreau::plane
