// SPDX-License-Identifier: BSD-3-Clause
// Domains for the tests of the domain checks.
#pragma once

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "mesh/plane_mesh.h"

namespace carreau::test {

inline constexpr double pi = 3.141592653589793;

/// Adds a closed loop of boundary edges; returns the index of its first vertex.
inline int add_loop(PlaneDomain& domain, const std::vector<Vec2>& loop, int curve = 0) {
  const int first = static_cast<int>(domain.vertices.size()), n = static_cast<int>(loop.size());
  domain.vertices.insert(domain.vertices.end(), loop.begin(), loop.end());
  for (int i = 0; i < n; ++i)
    domain.edges.push_back({first + i, first + (i + 1) % n, PlaneEdgeKind::boundary, curve, i});
  return first;
}

inline std::vector<Vec2> circle(int n, Vec2 centre, double radius) {
  std::vector<Vec2> loop;
  for (int i = 0; i < n; ++i)
    loop.push_back({centre.x() + radius * std::cos(2 * pi * i / n), centre.y() + radius * std::sin(2 * pi * i / n)});
  return loop;
}

inline PlaneDomain polygon(const std::vector<Vec2>& loop) {
  PlaneDomain domain;
  add_loop(domain, loop);
  return domain;
}

inline double signed_area(const PlaneDomain& domain) {
  double twice = 0;
  for (const PlaneEdge& e : domain.edges)
    if (e.kind != PlaneEdgeKind::internal) twice += cross(domain.vertices[e.a], domain.vertices[e.b]);
  return 0.5 * twice;
}

/// A domain whose edges are pieces of curves: splitting puts the new vertex on the curve.
struct CurvedDomain {
  PlaneDomain plane;
  std::vector<std::function<Vec2(double)>> curves;
  std::vector<std::pair<double, double>> interval;  ///< of each edge on its curve, from a to b

  /// n edges of curve t -> point, t from 0 to 1, between vertices (indices, -1: a new one).
  int add_curve(const std::function<Vec2(double)>& curve, int n, int from, int to,
                PlaneEdgeKind kind = PlaneEdgeKind::boundary) {
    const int rank = static_cast<int>(curves.size());
    curves.push_back(curve);
    int previous = from >= 0 ? from : add_vertex(curve(0));
    for (int i = 1; i <= n; ++i) {
      const int next = i == n && to >= 0 ? to : add_vertex(curve(static_cast<double>(i) / n));
      plane.edges.push_back({previous, next, kind, rank, i - 1});
      interval.emplace_back(static_cast<double>(i - 1) / n, static_cast<double>(i) / n);
      previous = next;
    }
    return previous;
  }
  int add_vertex(Vec2 p) {
    plane.vertices.push_back(p);
    return static_cast<int>(plane.vertices.size()) - 1;
  }
  void split(int edge) {
    const auto [t0, t1] = interval[edge];
    const double t = 0.5 * (t0 + t1);
    PlaneEdge second = plane.edges[edge];
    const int middle = add_vertex(curves[second.curve](t));
    second.a = middle;
    plane.edges[edge].b = middle;
    plane.edges.push_back(second);
    interval[edge] = {t0, t};
    interval.emplace_back(t, t1);
  }
};

inline std::function<Vec2(double)> segment(Vec2 p, Vec2 q) {
  return [=](double t) { return lerp(p, q, t); };
}
inline std::function<Vec2(double)> arc(Vec2 centre, double radius, double from, double to) {
  return [=](double t) {
    const double angle = from + t * (to - from);
    return Vec2{centre.x() + radius * std::cos(angle), centre.y() + radius * std::sin(angle)};
  };
}

}  // namespace carreau::test
