// SPDX-License-Identifier: BSD-3-Clause
// Surfaces that are cut into many patches for no reason.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "common/analytic_cad.h"

namespace carreau::testing {

/// Rectangles of a surface S(u, v) over `columns` by `rows`; every other one has u and v exchanged, so that normals of
/// neighbours point to different sides. References from `first`.
inline void add_grid(AnalyticCad& cad, int first, const std::function<SurfaceJet(Vec2)>& surface, Vec2 low, Vec2 high,
                     int columns, int rows) {
  const auto exchanged = [surface](Vec2 p) {
    const SurfaceJet s = surface({p.y(), p.x()});
    return SurfaceJet{s.s, s.sv, s.su, s.svv, s.suv, s.suu};
  };
  const double w = (high.x() - low.x()) / columns, h = (high.y() - low.y()) / rows;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      const Vec2 p{low.x() + i * w, low.y() + j * h}, q{low.x() + (i + 1) * w, low.y() + (j + 1) * h};
      const bool turned = (i + j) % 2 == 1;
      cad.faces[first + i * rows + j] = {
          turned ? std::function<SurfaceJet(Vec2)>(exchanged) : surface,
          turned ? rectangle({p.y(), p.x()}, {q.y(), q.x()}) : rectangle(p, q)};
    }
}

/// The unit cube, each side cut into n by n squares.
inline AnalyticCad cube_of_squares(int n) {
  AnalyticCad cad;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      const auto plane = [axis, side](Vec2 p) {
        SurfaceJet jet{};
        jet.s[axis] = side, jet.s[(axis + 1) % 3] = p.x(), jet.s[(axis + 2) % 3] = p.y();
        jet.su[(axis + 1) % 3] = jet.sv[(axis + 2) % 3] = 1;
        return jet;
      };
      add_grid(cad, 1 + (2 * axis + side) * n * n, plane, {0, 0}, {1, 1}, n, n);
    }
  return cad;
}

/// Radius 1, height 10, open at both ends, strips along the axis.
inline AnalyticCad cylinder_of_strips(int strips) {
  AnalyticCad cad;
  add_grid(
      cad, 1,
      [](Vec2 p) {
        const double c = std::cos(p.x()), s = std::sin(p.x());
        return SurfaceJet{{c, s, p.y()}, {-s, c, 0}, {0, 0, 1}, {-c, -s, 0}, {0, 0, 0}, {0, 0, 0}};
      },
      {0, 0}, {2 * std::numbers::pi, 10}, strips, 1);
  return cad;
}

/// The unit sphere over the triangles of an icosahedron, divided `divisions` times: 20 * 4^divisions patches.
inline AnalyticCad sphere_of_triangles(int divisions) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  const std::array<Vec3, 12> v{Vec3{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0}, {0, -1, g}, {0, 1, g},
                               {0, -1, -g},    {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  constexpr int faces[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                                {11, 10, 2}, {10, 7, 6}, {7, 1, 8}, {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                                {3, 8, 9},  {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  std::vector<std::array<Vec3, 3>> triangles;
  for (const auto& f : faces)
    triangles.push_back({v[f[0]] / norm(v[f[0]]), v[f[1]] / norm(v[f[1]]), v[f[2]] / norm(v[f[2]])});
  for (int k = 0; k < divisions; ++k) {
    std::vector<std::array<Vec3, 3>> finer;
    const auto middle = [](const Vec3& p, const Vec3& q) -> Vec3 { return (p + q) / norm(p + q); };
    for (const auto& [a, b, c] : triangles) {
      const Vec3 ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  AnalyticCad cad;
  for (const auto& [a, b, c] : triangles) {
    const auto at = [a = a, b = b, c = c](Vec2 p) {
      const Vec3 x = a + p.x() * (b - a) + p.y() * (c - a), s = x / norm(x);
      const auto tangent = [&](const Vec3& d) -> Vec3 { return (d - dot(d, s) * s) / norm(x); };
      SurfaceJet jet{};
      jet.s = s, jet.su = tangent(b - a), jet.sv = tangent(c - a);
      return jet;
    };
    cad.faces[static_cast<int>(cad.faces.size()) + 1] = {
        at, {segment({0, 0}, {1, 0}), segment({1, 0}, {0, 1}), segment({0, 1}, {0, 0})}};
  }
  return cad;
}

}  // namespace carreau::testing
