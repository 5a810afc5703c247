// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/simplices/simplices.h"

#include <algorithm>
#include <map>
#include <set>

namespace carreau {

namespace {

template <std::size_t N>
std::array<std::int32_t, N> sorted(std::array<std::int32_t, N> vertices) {
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

/// All subsets of N of the vertices of an element, sorted.
template <std::size_t N, std::size_t M>
void add_sides(const std::array<std::int32_t, M>& element, std::set<std::array<std::int32_t, N>>& sides) {
  std::array<bool, M> chosen{};
  std::fill(chosen.begin(), chosen.begin() + N, true);
  do {
    std::array<std::int32_t, N> side;
    std::size_t k = 0;
    for (std::size_t i = 0; i < M; ++i)
      if (chosen[i]) side[k++] = element[i];
    sides.insert(sorted(side));
  } while (std::prev_permutation(chosen.begin(), chosen.end()));
}

}  // namespace

std::vector<Simplex> simplices_of(std::span<const std::array<std::int32_t, 4>> tetrahedra,
                                  std::span<const std::array<std::int32_t, 3>> triangles,
                                  std::span<const std::array<std::int32_t, 2>> edges) {
  std::vector<Simplex> simplices;
  for (const auto& t : tetrahedra) simplices.push_back({sorted(t), 4});
  std::set<std::array<std::int32_t, 3>> faces;
  std::set<std::array<std::int32_t, 2>> sides;
  if (!triangles.empty())
    for (const auto& t : tetrahedra) add_sides(t, faces);
  if (!edges.empty()) {
    for (const auto& t : tetrahedra) add_sides(t, sides);
    for (const auto& t : triangles) add_sides(t, sides);
  }
  for (const auto& t : triangles)
    if (!faces.contains(sorted(t))) simplices.push_back({{t[0], t[1], t[2], -1}, 3});
  for (const auto& e : edges)
    if (!sides.contains(sorted(e))) simplices.push_back({{e[0], e[1], -1, -1}, 2});
  return simplices;
}

std::vector<std::array<std::int32_t, 3>> boundary_of(std::span<const Vec3> vertices,
                                                     std::span<const std::array<std::int32_t, 4>> tetrahedra) {
  std::map<std::array<std::int32_t, 3>, int> uses;
  const auto face_of = [](const std::array<std::int32_t, 4>& t, const std::array<std::size_t, 3>& corner) {
    return std::array{t[corner[0]], t[corner[1]], t[corner[2]]};
  };
  for (const auto& t : tetrahedra)
    for (const auto& corner : faces_of_tetrahedron) ++uses[sorted(face_of(t, corner))];
  std::vector<std::array<std::int32_t, 3>> boundary;
  const auto at = [&](std::int32_t v) { return vertices[static_cast<std::size_t>(v)]; };
  for (const auto& t : tetrahedra) {
    const bool positive = volume6(at(t[0]), at(t[1]), at(t[2]), at(t[3])) > 0;
    for (const auto& corner : faces_of_tetrahedron) {
      const auto face = face_of(t, corner);
      if (uses[sorted(face)] == 1) boundary.push_back(positive ? std::array{face[0], face[2], face[1]} : face);
    }
  }
  return boundary;
}

}  // namespace carreau
