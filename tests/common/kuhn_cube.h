// SPDX-License-Identifier: BSD-3-Clause
// A cube of tetrahedra.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "support/vec.h"

namespace carreau::testing {

struct Tetrahedra {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::int32_t, 4>> tetrahedra;
};

/// [0, 1]^3 in n^3 cubes, each in the six tetrahedra around its diagonal (Kuhn's): they fit together.
inline Tetrahedra kuhn_cube(int n) {
  Tetrahedra cube;
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) cube.vertices.push_back(Vec3{double(i), double(j), double(k)} / n);
  for (int cell = 0; cell < n * n * n; ++cell) {
    std::array<int, 3> axes{0, 1, 2};
    do {
      std::array<int, 3> at{cell % n, cell / n % n, cell / (n * n)};
      std::array<std::int32_t, 4> t{};
      for (std::size_t corner = 0;; ++corner) {
        t[corner] = static_cast<std::int32_t>((at[2] * (n + 1) + at[1]) * (n + 1) + at[0]);
        if (corner == 3) break;
        ++at[static_cast<std::size_t>(axes[corner])];
      }
      cube.tetrahedra.push_back(t);
    } while (std::next_permutation(axes.begin(), axes.end()));
  }
  return cube;
}

}  // namespace carreau::testing
