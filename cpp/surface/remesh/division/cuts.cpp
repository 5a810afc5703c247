// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/division/cuts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/union_find.h"

namespace carreau {

namespace {

using Parts = std::vector<std::vector<std::int32_t>>;

class Cutter {
 public:
  Cutter(const CrossPatchMesh& mesh, std::span<const float> weight) : mesh_(mesh), weight_(weight) {}

  void cut(std::vector<std::int32_t> triangles, int parts, Parts& result) {
    if (parts <= 1) {
      std::ranges::sort(triangles);
      result.push_back(std::move(triangles));
      return;
    }
    const int axis = longest_axis(triangles);
    std::vector<std::pair<double, std::int32_t>> order;
    order.reserve(triangles.size());
    for (const std::int32_t t : triangles) order.emplace_back(centre(t)[axis], t);
    std::ranges::sort(order);
    const double share = weight_of(triangles) * (parts / 2) / parts;
    std::vector<std::int32_t> low, high;
    double sum = 0;
    for (const auto& [at, t] : order) {
      (sum < share ? low : high).push_back(t);
      sum += weight_[t];
    }
    cut(std::move(low), parts / 2, result);
    cut(std::move(high), parts - parts / 2, result);
  }

  [[nodiscard]] double weight_of(std::span<const std::int32_t> triangles) const {
    double sum = 0;
    for (const std::int32_t t : triangles) sum += weight_[t];
    return sum;
  }

 private:
  // Three times the centroid.
  [[nodiscard]] Vec3 centre(std::int32_t t) const {
    const auto& [a, b, c] = mesh_.triangles()[t];
    return mesh_.position(a) + mesh_.position(b) + mesh_.position(c);
  }
  [[nodiscard]] int longest_axis(std::span<const std::int32_t> triangles) const {
    Vec3 low = centre(triangles.front()), high = low;
    for (const std::int32_t t : triangles) {
      const Vec3 p = centre(t);
      for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
    }
    int axis = 0;
    for (int k = 1; k < 3; ++k)
      if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    return axis;
  }

  const CrossPatchMesh& mesh_;
  std::span<const float> weight_;
};

}  // namespace

Parts cut_across(const CrossPatchMesh& mesh, std::vector<std::int32_t> triangles, std::span<const float> weight, double most) {
  Parts parts;
  if (triangles.empty()) return parts;
  Cutter cutter(mesh, weight);
  const double n = std::clamp(std::ceil(cutter.weight_of(triangles) / most), 1.0, static_cast<double>(triangles.size()));
  cutter.cut(std::move(triangles), static_cast<int>(n), parts);
  std::erase_if(parts, [](const auto& part) { return part.empty(); });
  return parts;
}

Parts connected(const CrossPatchMesh& mesh, std::span<const std::int32_t> triangles) {
  UnionFind sets(mesh.vertices());
  for (const std::int32_t t : triangles)
    for (int i = 1; i < 3; ++i) sets.merge(static_cast<std::size_t>(mesh.triangles()[t][0]), static_cast<std::size_t>(mesh.triangles()[t][i]));
  Parts parts;
  std::vector<std::int32_t> number(mesh.vertices(), -1);
  for (const std::int32_t t : triangles) {
    std::int32_t& of_set = number[sets.find(static_cast<std::size_t>(mesh.triangles()[t][0]))];
    if (of_set < 0) of_set = static_cast<std::int32_t>(parts.size()), parts.emplace_back();
    parts[of_set].push_back(t);
  }
  return parts;
}

std::vector<char> near_vertices(const CrossPatchMesh& mesh, std::span<const std::int32_t> vertices, int edges) {
  std::vector<char> near(mesh.vertices(), 0);
  std::vector<std::int32_t> front(vertices.begin(), vertices.end()), next;
  for (const std::int32_t v : front) near[v] = 1;
  for (int k = 0; k < edges; ++k) {
    next.clear();
    for (const std::int32_t v : front)
      for (const EditableMesh::Place p : mesh.mesh().fan(v))
        for (const std::int32_t w : mesh.mesh().at(p))
          if (near[w] == 0) near[w] = 1, next.push_back(w);
    std::swap(front, next);
  }
  return near;
}

std::vector<std::int32_t> triangles_at(const CrossPatchMesh& mesh, const std::vector<char>& near) {
  std::vector<std::int32_t> found;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    const auto& c = mesh.triangles()[t];
    if (c[0] >= 0 && (near[c[0]] != 0 || near[c[1]] != 0 || near[c[2]] != 0)) found.push_back(static_cast<std::int32_t>(t));
  }
  return found;
}

}  // namespace carreau
