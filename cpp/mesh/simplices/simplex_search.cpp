// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/simplices/simplex_search.h"

#include <algorithm>
#include <cmath>

#include "mesh/triangle_search.h"
#include "support/infinity.h"
#include "support/segment.h"

namespace carreau {

namespace {

using Box = BoxTree::Box;

Box box_of(std::span<const Vec3> corners) noexcept {
  Box box;
  for (const Vec3& p : corners) box.add(p);
  return box;
}

NearestOnSimplices nearest_on_edge(const Vec3& p, std::span<const Vec3> corner) noexcept {
  const double t = fraction_on_segment(p, corner[0], corner[1]);
  const Vec3 point = lerp(corner[0], corner[1], t);
  return {-1, {1 - t, t, 0, 0}, point, norm(point - p)};
}

/// Inside it is the point itself; else on one of the faces.
NearestOnSimplices nearest_on_tetrahedron(const Vec3& p, std::span<const Vec3> corner) noexcept {
  const double all = volume6(corner[0], corner[1], corner[2], corner[3]);
  if (all != 0) {
    const std::array<double, 4> w{
        volume6(p, corner[1], corner[2], corner[3]) / all, volume6(corner[0], p, corner[2], corner[3]) / all,
        volume6(corner[0], corner[1], p, corner[3]) / all, volume6(corner[0], corner[1], corner[2], p) / all};
    if (const double sum = w[0] + w[1] + w[2] + w[3]; *std::min_element(w.begin(), w.end()) >= 0 && sum > 0)
      return {-1, {w[0] / sum, w[1] / sum, w[2] / sum, w[3] / sum}, p, 0};
  }
  NearestOnSimplices best;
  for (const auto& face : faces_of_tetrahedron) {
    const NearestOnMesh found = nearest_on_triangle(p, {corner[face[0]], corner[face[1]], corner[face[2]]});
    if (!(found.distance < best.distance)) continue;
    best = {-1, {0, 0, 0, 0}, found.point, found.distance};
    for (std::size_t k = 0; k < 3; ++k) best.weight[face[k]] = found.weight[k];
  }
  return best;
}

}  // namespace

NearestOnSimplices nearest_on_simplex(const Vec3& p, std::span<const Vec3> corners) noexcept {
  if (corners.size() == 2) return nearest_on_edge(p, corners);
  if (corners.size() == 4) return nearest_on_tetrahedron(p, corners);
  const NearestOnMesh found = nearest_on_triangle(p, {corners[0], corners[1], corners[2]});
  return {-1, {found.weight[0], found.weight[1], found.weight[2], 0}, found.point, found.distance};
}

SimplexSearch::SimplexSearch(std::span<const Vec3> vertices, std::span<const Simplex> simplices) {
  std::vector<Box> boxes;
  std::vector<Vec3> centres;
  for (const Simplex& s : simplices) {
    Corners corners;
    corners.count = static_cast<std::size_t>(s.corners);
    Vec3 sum{0, 0, 0};
    for (std::size_t k = 0; k < corners.count; ++k) {
      corners.at[k] = vertices[static_cast<std::size_t>(s.vertex[k])];
      sum = sum + corners.at[k];
    }
    corners_.push_back(corners);
    boxes.push_back(box_of(corners.all()));
    centres.push_back((1.0 / s.corners) * sum);
  }
  tree_ = BoxTree(boxes, centres);
}

/// `distance` of best is squared here.
void SimplexSearch::look_at(std::int32_t simplex, const Vec3& p, NearestOnSimplices& best) const noexcept {
  const std::span<const Vec3> corners = corners_[static_cast<std::size_t>(simplex)].all();
  if (box_of(corners).squared_distance(p) > best.distance) return;
  const NearestOnSimplices found = nearest_on_simplex(p, corners);
  const double squared = dot(found.point - p, found.point - p);
  if (squared > best.distance || (squared == best.distance && simplex >= best.simplex)) return;
  best = {simplex, found.weight, found.point, squared};
}

NearestOnSimplices SimplexSearch::nearest(const Vec3& p, std::int32_t guess) const noexcept {
  NearestOnSimplices best;
  look_at(guess >= 0 && static_cast<std::size_t>(guess) < corners_.size() ? guess : 0, p, best);
  tree_.nearest_first([&](std::int32_t n) { return tree_.node(static_cast<std::size_t>(n)).box.squared_distance(p); },
                      [&](double squared) { return !(squared > best.distance); },
                      [&](const BoxTree::Node& leaf) {
                        for (const std::int32_t s : tree_.things(leaf)) look_at(s, p, best);
                      });
  best.distance = std::sqrt(best.distance);
  return best;
}

double SimplexSearch::longest_edge(std::int32_t simplex) const noexcept {
  const std::span<const Vec3> corners = corners_[static_cast<std::size_t>(simplex)].all();
  double longest = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) longest = std::max(longest, norm(corners[i] - corners[j]));
  return longest;
}

}  // namespace carreau
