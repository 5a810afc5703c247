// SPDX-License-Identifier: BSD-3-Clause
#include "model/near_points.h"

#include <array>
#include <cmath>
#include <map>

namespace carreau {

namespace {

/// Indices of a cell, kept as doubles: exact wherever two points can differ by less than the tolerance.
using Cell = std::array<double, 3>;
using Cells = std::map<Cell, std::vector<std::size_t>>;

bool any_near(std::span<const Vec3> points, const std::vector<std::size_t>& some,
              const std::vector<std::size_t>& others, double eps) {
  for (const std::size_t i : some)
    for (const std::size_t j : others)
      if (norm(points[i] - points[j]) < eps) return true;
  return false;
}

}  // namespace

void merge_near_points(std::span<const Vec3> points, double eps, UnionFind& sets) {
  // Cells of half the tolerance: all points of a cell are one (its diagonal is 0.87 eps), and near points lie at most
  // two cells away.
  const double side = eps / 2;
  constexpr int reach = 2;
  Cells cells;
  for (std::size_t i = 0; i < points.size(); ++i) {
    auto& members =
        cells[{std::floor(points[i].x() / side), std::floor(points[i].y() / side), std::floor(points[i].z() / side)}];
    if (!members.empty()) sets.merge(members.front(), i);
    members.push_back(i);
  }
  for (const auto& [cell, members] : cells)
    for (int dx = 0; dx <= reach; ++dx)
      for (int dy = -reach; dy <= reach; ++dy)
        for (int dz = -reach; dz <= reach; ++dz) {
          const Cell other{cell[0] + dx, cell[1] + dy, cell[2] + dz};
          if (!(cell < other)) continue;  // each pair once
          const auto it = cells.find(other);
          if (it == cells.end() || sets.find(members.front()) == sets.find(it->second.front())) continue;
          if (any_near(points, members, it->second, eps)) sets.merge(members.front(), it->second.front());
        }
}

}  // namespace carreau
