// SPDX-License-Identifier: BSD-3-Clause
#include "association/edge_marks.h"

#include <cmath>
#include <numbers>
#include <string>

#include "support/error.h"

namespace carreau::refining {

namespace {

std::vector<Key> all_edges(const SurfaceMesh& mesh) {
  std::vector<Key> all;
  all.reserve(3 * mesh.triangle_count());
  for (const FaceMesh& face : mesh.faces)
    for_sides(face, [&](std::int32_t a, std::int32_t b) { all.push_back(ordered(face.vertex[a], face.vertex[b])); });
  for (const CurveMesh& curve : mesh.curves)
    for (std::size_t k = 1; k < curve.vertices.size(); ++k) all.push_back(ordered(curve.vertices[k - 1], curve.vertices[k]));
  return all;
}

}  // namespace

EdgeMarks::EdgeMarks(const SurfaceMesh& mesh) : mesh_(mesh), edges_(all_edges(mesh), mesh.vertices.size()), marked_(edges_.size(), 0) {}

std::int64_t EdgeMarks::count() const { return std::count(marked_.begin(), marked_.end(), 1); }

double EdgeMarks::length(std::int32_t edge) const { return norm(mesh_.vertices[edges_[edge][1]] - mesh_.vertices[edges_[edge][0]]); }

void EdgeMarks::mark_all() { std::fill(marked_.begin(), marked_.end(), 1); }

void EdgeMarks::mark_edges(std::span<const Key> edges) {
  for (const Key& edge : edges) {
    const std::int32_t e = edges_.find(edge[0], edge[1]);
    if (e < 0) throw InvalidArgument("the mesh has no edge between the vertices " + std::to_string(edge[0]) + " and " + std::to_string(edge[1]));
    marked_[e] = 1;
  }
}

void EdgeMarks::mark_elements(std::vector<std::int64_t> elements) {
  std::sort(elements.begin(), elements.end());
  std::int64_t first = 0;
  auto next = elements.begin();
  if (!elements.empty() && *next < 0) throw InvalidArgument("there is no element " + std::to_string(*next));
  for (const FaceMesh& face : mesh_.faces) {
    const auto count = static_cast<std::int64_t>(face.cell_count());
    for (; next != elements.end() && *next < first + count; ++next) {
      const std::int64_t k = *next - first, quads = face.quads;
      for (std::int64_t t = k < quads ? 2 * k : k + quads; t < (k < quads ? 2 * k + 2 : k + quads + 1); ++t)
        for (int i = 0; i < 3; ++i) {
          const Triangle& corners = face.triangles[t];
          const std::int32_t e = edges_.find(face.vertex[corners[i]], face.vertex[corners[(i + 1) % 3]]);
          if (e >= 0 && !(k < quads && i == (t % 2 == 0 ? 2 : 0))) marked_[e] = 1;
        }
    }
    first += count;
  }
  if (next != elements.end()) throw InvalidArgument("there is no element " + std::to_string(*next) + ": the mesh has " + std::to_string(first));
}

bool EdgeMarks::mark_long(std::span<const double> sizes) {
  bool any = false;
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const auto [a, b] = edges_[e];
    // Two halves of a longer edge are nearer to the size than the whole.
    if (length(static_cast<std::int32_t>(e)) > std::numbers::sqrt2 * std::sqrt(sizes[a] * sizes[b])) marked_[e] = 1, any = true;
  }
  return any;
}

void EdgeMarks::close() {
  std::vector<double> lengths(edges_.size());
  for (std::size_t e = 0; e < lengths.size(); ++e) lengths[e] = length(static_cast<std::int32_t>(e));
  // Each edge leads to the longest edges of its triangles.
  std::vector<Key> leads;
  for (const FaceMesh& face : mesh_.faces)
    for (std::size_t t = 2 * static_cast<std::size_t>(face.quads); t < face.triangles.size(); ++t) {
      Triangle sides{};
      for (std::size_t i = 0; i < 3; ++i) sides[i] = edges_.find(face.vertex[face.triangles[t][i]], face.vertex[face.triangles[t][(i + 1) % 3]]);
      const std::int32_t longest = *std::max_element(
          sides.begin(), sides.end(), [&](std::int32_t d, std::int32_t e) { return std::pair(lengths[d], d) < std::pair(lengths[e], e); });
      for (const std::int32_t side : sides)
        if (side != longest) leads.push_back({side, longest});
    }
  std::sort(leads.begin(), leads.end());
  std::vector<std::int32_t> queue;
  for (std::size_t e = 0; e < marked_.size(); ++e)
    if (marked_[e] != 0) queue.push_back(static_cast<std::int32_t>(e));
  for (std::size_t k = 0; k < queue.size(); ++k)
    for (auto to = std::lower_bound(leads.begin(), leads.end(), Key{queue[k], 0}); to != leads.end() && (*to)[0] == queue[k]; ++to)
      if (marked_[(*to)[1]] == 0) marked_[(*to)[1]] = 1, queue.push_back((*to)[1]);
}

}  // namespace carreau::refining
