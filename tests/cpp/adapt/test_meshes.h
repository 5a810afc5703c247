// SPDX-License-Identifier: BSD-3-Clause
// Meshes for tests of estimators and transfers: made without a mesher, irregular, the same everywhere.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "adapt/scalar_field.h"

namespace carreau::testing {

struct TestMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<double> values;
  std::vector<char> inside;  ///< not on the border

  [[nodiscard]] ScalarField field() const { return {vertices, triangles, values}; }
  TestMesh& with(const std::function<double(Vec3)>& f) {
    values.clear();
    for (const Vec3& p : vertices) values.push_back(f(p));
    return *this;
  }
};

/// [-1, 1]^2 in n x n cells, diagonals alternating, inner vertices moved by up to `jitter` of a cell.
inline TestMesh square_mesh(int n, double jitter = 0.3) {
  TestMesh mesh;
  const auto shift = [&](int i, int j, int k) {
    const double x = std::sin(12.9898 * i + 78.233 * j + 37.719 * k) * 43758.5453;
    return 2 * (x - std::floor(x)) - 1;
  };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const bool inside = i > 0 && j > 0 && i < n && j < n;
      const double k = inside ? jitter : 0;
      mesh.vertices.push_back({2 * (i + k * shift(i, j, 0)) / n - 1, 2 * (j + k * shift(i, j, 1)) / n - 1, 0});
      mesh.inside.push_back(inside ? 1 : 0);
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const std::int32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      if ((i + j) % 2 == 0) {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({a, d, c});
      } else {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({b, d, c});
      }
    }
  mesh.values.assign(mesh.vertices.size(), 0);
  return mesh;
}

/// A mesh whose vertices are moved by a map of space.
inline TestMesh mapped(TestMesh mesh, const std::function<Vec3(Vec3)>& map) {
  for (Vec3& p : mesh.vertices) p = map(p);
  return mesh;
}

}  // namespace carreau::testing
