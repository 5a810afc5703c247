// SPDX-License-Identifier: BSD-3-Clause
#include "measure/beside_patches.h"

#include <algorithm>
#include <limits>

namespace carreau {

namespace {

/// Ranks in the whole of a part's entities.
struct Ranks {
  std::vector<std::size_t> edge, vertex, triangle;
  [[nodiscard]] const std::vector<std::size_t>& of(EvaluationEntity entity) const {
    return entity == EvaluationEntity::edge ? edge : entity == EvaluationEntity::vertex ? vertex : triangle;
  }
};

/// Triangles of the faces of a part follow one another in both.
Ranks ranks_of(const SurfaceMesh& mesh, const MeshEdges& edges, const MeshEvaluation& part,
               const std::function<bool(std::size_t)>& is_of_part) {
  Ranks ranks;
  ranks.edge.resize(part.edges.vertices.size());
  std::size_t t = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (std::size_t k = 0; k < mesh.faces[f].triangles.size(); ++k, ++t) {
      if (!is_of_part(f)) continue;
      const auto& own = part.edges.of_triangle[ranks.triangle.size()];
      for (std::size_t i = 0; i < own.size(); ++i)
        ranks.edge[static_cast<std::size_t>(own[i])] = static_cast<std::size_t>(edges.of_triangle[t][i]);
      ranks.triangle.push_back(t);
    }
  return ranks;
}

void take(const EvaluatedMeasure& measure, const MeshEvaluation& part, const Ranks& ranks, MeshEvaluation& whole) {
  const Delivery& from = part[measure.kind];
  Delivery& to = whole[measure.kind];
  const std::vector<std::size_t>& rank = ranks.of(measure.entity);
  for (std::size_t k = 0; k < from.values.size() && k < rank.size(); ++k) to.values[rank[k]] = from.values[k];
  to.limit = std::min(to.limit, from.limit);
  to.forced += from.forced;
  to.shortest = std::max(to.shortest, from.shortest);
}

}  // namespace

MeshEvaluation beside_each_other(const SurfaceMesh& mesh, const MeshEvaluation& patches, const MeshEvaluation& triangles,
                                 const std::function<bool(std::size_t face)>& of_triangles) {
  MeshEvaluation whole;
  whole.edges = edges_of(mesh);
  Ranks first = ranks_of(mesh, whole.edges, patches, [&](std::size_t f) { return !of_triangles(f); });
  Ranks second = ranks_of(mesh, whole.edges, triangles, of_triangles);
  const std::size_t behind = patches[EvaluationKind::length_ratio].values.size();
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) (v < behind ? first : second).vertex.push_back(v);
  for (const EvaluatedMeasure& measure : delivered_measures()) {
    const std::size_t n = measure.entity == EvaluationEntity::edge     ? whole.edges.vertices.size()
                          : measure.entity == EvaluationEntity::vertex ? mesh.vertices.size()
                                                                       : whole.edges.of_triangle.size();
    whole[measure.kind].values.assign(n, std::numeric_limits<double>::quiet_NaN());
    take(measure, patches, first, whole);
    take(measure, triangles, second, whole);
  }
  summarise(whole);
  for (const EvaluatedMeasure& measure : delivered_measures())
    whole[measure.kind].beyond = patches[measure.kind].beyond + triangles[measure.kind].beyond;
  whole.input = triangles.input;
  whole.calls = patches.calls;
  for (const auto count : {&CallCounts::surf0, &CallCounts::surf1, &CallCounts::surf2, &CallCounts::curv0,
                           &CallCounts::curv1, &CallCounts::curv2, &CallCounts::sizes})
    whole.calls.*count += triangles.calls.*count;
  whole.seconds = patches.seconds + triangles.seconds;
  return whole;
}

}  // namespace carreau
