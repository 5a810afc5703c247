// The triangulation that the plane mesher works on: flat arrays of plain numbers.
#pragma once

#include <cstdint>
#include <vector>

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
};

/// Half-edge i of triangle t lies opposite to its corner i and is written 4 t + i; -1: nothing beyond.
using HalfEdge = std::int32_t;
constexpr HalfEdge no_edge = -1;

/// 32 bytes, counterclockwise. Edge i runs from corner i+1 to corner i+2.
struct Triangle {
  std::int32_t v[3] = {-1, -1, -1};
  HalfEdge n[3] = {no_edge, no_edge, no_edge};
  float radius2 = 0;            ///< squared circumradius in the metric, as last judged
  std::uint8_t imposed = 0;     ///< bit i: edge i is never swapped, crossed or removed
  std::uint8_t degenerate = 0;  ///< bit i: edge i is one point in space
  std::uint8_t done = 0;        ///< small enough: the front has passed
  std::uint8_t mark = 0;
};

constexpr int next3[3] = {1, 2, 0}, prev3[3] = {2, 0, 1};

/// Edge of the rim of a cavity as seen from the new point, with its ends relative to the point in units of its metric.
struct RimEdge {
  std::int32_t a, b;
  HalfEdge outside;
  std::uint8_t imposed, degenerate;
  double ax, ay, bx, by;
};

/// How a point is inserted.
struct InsertRules {
  double least_distance2 = 0;  ///< squared metric distance to the cavity's vertices below which a point is refused
  double least_height = 0;     ///< height over an imposed edge, in lengths of that edge
  double least_degenerate_height = 0;  ///< metric distance to a degenerate edge as a whole
};

class Triangulation {
 public:
  std::vector<Vertex> vertices;
  std::vector<Triangle> triangles;

  /// Triangle that contains p (on its border counts), walking from triangle `hint`; -1 when the walk leaves the
  /// triangulation or meets an imposed edge that it may not cross.
  [[nodiscard]] int locate(Vec2 p, int hint, bool cross_imposed = false) const noexcept;

  /// Inserts p into the cavity of its triangle `start` (RR-2928 eq. 3-8): true when done, then `star()` lists the
  /// triangles around the new vertex, the last of `vertices`. The cavity is star-shaped about p by exact tests, so the
  /// result is always a triangulation.
  bool insert(Vec2 p, Metric2 metric, int start, const InsertRules& rules);
  [[nodiscard]] const std::vector<std::int32_t>& star() const noexcept { return cavity_; }
  [[nodiscard]] const std::vector<RimEdge>& rim() const noexcept { return rim_; }

  /// Exchanges the diagonal of the two triangles at half-edge (t, i). They keep their numbers.
  void swap_edge(int t, int i) noexcept;
  /// Whether both triangles of the other diagonal are counterclockwise. Exact.
  [[nodiscard]] bool can_swap(int t, int i) const noexcept;

  [[nodiscard]] Vec2 at(int v) const noexcept { return vertices[v].point(); }
  [[nodiscard]] int corner_of(int t, int v) const noexcept {
    const Triangle& T = triangles[t];
    return T.v[0] == v ? 0 : T.v[1] == v ? 1 : 2;
  }
  /// Squared length of an edge in the mean of its ends' metrics.
  [[nodiscard]] double squared_length(int u, int v) const noexcept;
  /// Squared circumradius in the mean metric of the corners.
  [[nodiscard]] double squared_radius(int t) const noexcept;

 private:
  bool dig(Vec2 p, Metric2 metric, int start, const InsertRules& rules);
  void fill(int p);

  std::vector<std::int32_t> cavity_;
  std::vector<RimEdge> rim_, stack_;
};

/// Cholesky factor of a metric: maps the plane to one where the metric is Euclidean.
struct Factor {
  double p, q, r;
  explicit Factor(Metric2 m) noexcept;
  void apply(double dx, double dy, double& X, double& Y) const noexcept {
    X = p * dx + q * dy;
    Y = r * dy;
  }
};

}  // namespace carreau::plane
