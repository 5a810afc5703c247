// SPDX-License-Identifier: BSD-3-Clause
#include "measure/base/spread_samples.h"

#include <algorithm>
#include <functional>

namespace carreau {

namespace {

// Places of a vertex of the atlas, by face and (u, v).
std::vector<SurfacePlace> places_of(const Charts& charts, Cad& cad, const SurfacePlace& vertex) {
  std::int32_t v = -1;
  for (int i = 0; i < 3; ++i)
    if (charts.uv(vertex.foot.triangle, i) == vertex.foot.uv) v = charts.triangles()[vertex.foot.triangle].vertex[i];
  std::vector<SurfacePlace> places;
  for (std::size_t t = 0; v >= 0 && t < charts.triangles().size(); ++t)
    for (int i = 0; i < 3; ++i) {
      if (charts.triangles()[t].vertex[i] != v) continue;
      const auto here = static_cast<std::int32_t>(t);
      const Vec2 uv = charts.uv(here, i);
      const auto same = [&](const SurfacePlace& p) { return p.foot.uv == uv && charts.face(p.foot) == charts.triangles()[t].face; };
      if (std::ranges::none_of(places, same)) places.push_back(charts.evaluate(cad, {here, uv}));
    }
  return places;
}

}  // namespace

SpreadTriangle spread_triangle(const SurfaceMesh& mesh, const SpreadAtlas& atlas, Cad& cad, std::size_t f, std::size_t t) {
  const FaceMesh& face = mesh.faces[f];
  std::array<Vec3, 3> corners;
  std::array<SurfacePlace, 3> places;
  for (int i = 0; i < 3; ++i) {
    const std::int32_t local = face.triangles[t][i];
    corners[i] = mesh.vertices[face.vertex[local]];
    places[i] = atlas.charts->evaluate(cad, {atlas.feet[f][local], face.uv[local]});
  }
  const std::int32_t any = places[0].foot.triangle;
  const bool turned = atlas.charts->triangles()[any].turned != atlas.is_turned(static_cast<std::int32_t>(f), any);
  SpreadTriangle made(*atlas.charts, cad, corners, places, turned);
  for (const SurfacePlace& p : places)
    if (!p.regular) made.set_pole(places_of(*atlas.charts, cad, p));
  return made;
}

bool SpreadAtlas::is_turned(std::int32_t face, std::int32_t triangle) const {
  const auto& all = charts->triangles();
  const auto own = std::ranges::lower_bound(all, face, {}, &Charts::Triangle::face);
  return own != all.end() && own->face == face && own->turned != all[triangle].turned;
}

std::vector<SpreadSample> spread_samples(const SurfaceMesh& mesh, const SpreadAtlas& atlas, Cad& cad,
                                         std::span<const double> nodes,
                                         std::span<const std::array<double, 3>> weights, Monitor& monitor) {
  std::vector<SpreadSample> samples;
  std::size_t first = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); first += mesh.faces[f++].triangles.size())
    for (std::size_t t = 0; t < mesh.faces[f].triangles.size(); ++t) {
      if (!mesh.faces[f].is_spread(t)) continue;
      monitor.checkpoint();
      const SpreadTriangle triangle = spread_triangle(mesh, atlas, cad, f, t);
      const auto add = [&](int side, std::size_t rank, const std::array<double, 3>& weight) {
        SpreadSample& sample = samples.emplace_back();
        sample.triangle = first + t, sample.side = side, sample.rank = static_cast<int>(rank);
        sample.flat = triangle.flat(weight);
        const auto found = triangle.over(weight);
        if (!found) return;
        sample.face = atlas.charts->face(found->foot);
        sample.uv = found->foot.uv;
        sample.turned = atlas.is_turned(static_cast<std::int32_t>(f), found->foot.triangle);
      };
      for (int i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < nodes.size(); ++k) {
          std::array<double, 3> weight{};
          weight[i] = 1 - nodes[k], weight[(i + 1) % 3] = nodes[k];
          add(i, k, weight);
        }
      for (std::size_t k = 0; k < weights.size(); ++k) add(-1, k, weights[k]);
    }
  std::ranges::stable_sort(samples, std::less<>(), &SpreadSample::face);
  return samples;
}

}  // namespace carreau
