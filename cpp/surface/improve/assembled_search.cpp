// SPDX-License-Identifier: BSD-3-Clause
#include "surface/improve/assembled_search.h"

#include <algorithm>

#include "support/angles.h"
#include "surface/improve/thresholds.h"
#include "surface/sample/face_metric.h"

namespace carreau {

namespace {

Budget budget_of(const SurfaceMesh& mesh) {
  // Points of surfaces, whatever the mesh, and for each vertex of larger meshes. If the curves of a model contradict its sizes, edges need
  // improvement everywhere.
  constexpr double min_budget = 5'000, budget_a_vertex = 0.25;
  return Budget(
      static_cast<std::int64_t>(std::max(min_budget, budget_a_vertex * static_cast<double>(mesh.vertices.size()))));
}

}  // namespace

AssembledSearch::AssembledSearch(std::span<const std::int32_t> centres, const SizeRules& rules, Cad& cad,
                                 CompositeResult& result)
    : rules_(rules),
      cad_(cad),
      result_(result),
      mesh_(result.mesh, centres, thresholds::assembled::rings),
      budget_(budget_of(result.mesh)) {}

SurfaceJet AssembledSearch::ask(std::int32_t face, const Vec2& uv) {
  budget_.spend();
  return surface_at(cad_, result_.mesh.faces[face].ref, want_position | want_first, uv);
}

bool AssembledSearch::agree(std::span<const Place> places, const Vec3& mean) const {
  return std::all_of(places.begin(), places.end(), [&](Place p) {
    const Vec3 n = mesh_.normal(p);
    return dot(n, mean) > angles::cosine_of_45 * norm(n);
  });
}

std::vector<std::int32_t> AssembledSearch::left_around(std::int32_t v) const {
  std::vector<std::int32_t> around = mesh_.with_ring(v);
  std::erase_if(around, [this](std::int32_t w) { return !mesh_.is_known(w); });
  return around;
}

void AssembledSearch::update_sizes(double (*size_of)(const SurfaceJet&, Metric2), Monitor& monitor) {
  std::sort(changed_.begin(), changed_.end());
  changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
  for (const Vertex v : changed_) {
    FaceMetric prescribed(v.face, rules_, result_.interfaces[v.face], monitor, {.field = result_.graded.get()});
    const Vec2 uv = mesh_.uv(v);
    prescribed.sample(cad_, result_.mesh.faces[v.face].ref, 0, {&uv, 1},
                      [&](std::size_t, const SurfaceJet& jet, Metric2 metric) {
                        if (const double h = size_of(jet, metric); h > 0) result_.vertex_size[mesh_.global(v)] = h;
                      });
  }
}

}  // namespace carreau
