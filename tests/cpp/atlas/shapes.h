// SPDX-License-Identifier: BSD-3-Clause
// Closed triangulations to test with.
#pragma once

#include <cmath>
#include <map>
#include <numbers>

#include "atlas/covering/triangulation.h"

namespace carreau::atlas::test {

/// Twenty triangles, divided `level` times, on the unit sphere.
inline Triangulation icosphere(int level) {
  const double g = std::numbers::phi;
  Triangulation s{{{-1, g, 0},
                   {1, g, 0},
                   {-1, -g, 0},
                   {1, -g, 0},
                   {0, -1, g},
                   {0, 1, g},
                   {0, -1, -g},
                   {0, 1, -g},
                   {g, 0, -1},
                   {g, 0, 1},
                   {-g, 0, -1},
                   {-g, 0, 1}},
                  {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                   {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                   {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (int k = 0; k < level; ++k) s = subdivided(s);
  for (Vec3& p : s.vertices) p /= norm(p);
  return s;
}

/// n x m vertices, rows shifted by half a step by turns; n even.
inline Triangulation torus(double large, double small, int n, int m) {
  Triangulation s;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const double a = 2 * std::numbers::pi * i / n, b = 2 * std::numbers::pi * (j + .5 * (i % 2)) / m;
      s.vertices.emplace_back((large + small * std::cos(b)) * std::cos(a), (large + small * std::cos(b)) * std::sin(a),
                              small * std::sin(b));
    }
  const auto at = [&](int i, int j) { return (i % n) * m + (j + m) % m; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const int shift = i % 2;
      s.triangles.push_back({at(i, j), at(i + 1, j + shift), at(i, j + 1)});
      s.triangles.push_back({at(i, j), at(i + 1, j + shift - 1), at(i + 1, j + shift)});
    }
  return s;
}

}  // namespace carreau::atlas::test
