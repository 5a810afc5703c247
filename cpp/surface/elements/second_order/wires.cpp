// SPDX-License-Identifier: BSD-3-Clause
#include "surface/elements/second_order/wires.h"

#include <optional>
#include <utility>

#include "surface/elements/base/curve_middles.h"

namespace carreau {

namespace {

template <typename Use>
void for_wires(const ElementWork& work, const Use& use) {
  for (std::size_t c = 0; c < work.curves.size(); ++c) {
    CurveMesh& curve = work.result.mesh.curves[c];
    if (!curve.loose || curve.vertices.size() < 2 || curve.vertices.size() != work.curves[c].xyz.size()) continue;
    work.monitor.checkpoint();
    use(c, curve);
  }
}

}  // namespace

void halve_wires(const ElementWork& work) {
  for_wires(work, [&](std::size_t c, CurveMesh& wire) {
    DiscreteCurve finer = work.curves[c];
    for (int k = finer.segments() - 1; k >= 0; --k)
      if (!split_segment(finer, k, work.model, middle_share(work.curves[c], static_cast<std::size_t>(k)))) return;
    SurfaceMesh& mesh = work.result.mesh;
    std::vector<double>& sizes = work.result.vertex_size;
    std::vector<std::int32_t> vertices{wire.vertices.front()};
    for (std::size_t k = 1; k < wire.vertices.size(); ++k) {
      vertices.insert(vertices.end(), {static_cast<std::int32_t>(mesh.vertices.size()), wire.vertices[k]});
      mesh.vertices.push_back(finer.xyz[2 * k - 1]);
      mesh.vertex_ref.push_back(0);
      sizes.push_back(0.5 * (sizes[wire.vertices[k - 1]] + sizes[wire.vertices[k]]));
    }
    wire.vertices = std::move(vertices);
    work.curves[c] = std::move(finer);
    std::vector<double>& along = work.result.curve_size[c];
    along.clear();
    for (const std::int32_t v : wire.vertices) along.push_back(sizes[v]);
  });
}

void give_nodes_to_wires(const ElementWork& work) {
  EdgeMiddles middles(work);
  for_wires(work, [&](std::size_t c, CurveMesh& wire) {
    SurfaceMesh& mesh = work.result.mesh;
    wire.mid.clear();
    for (std::size_t k = 0; k + 1 < wire.vertices.size(); ++k) {
      const std::optional<CurveMiddle> middle = middles.at(c, k);
      const Vec3 straight = 0.5 * (mesh.vertices[wire.vertices[k]] + mesh.vertices[wire.vertices[k + 1]]);
      wire.mid.push_back(static_cast<std::int32_t>(mesh.mid_vertices.size()));
      mesh.mid_vertices.push_back(middle ? middle->xyz : straight);
    }
  });
}

}  // namespace carreau
