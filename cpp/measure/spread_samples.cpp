// SPDX-License-Identifier: BSD-3-Clause
#include "measure/spread_samples.h"

#include <algorithm>
#include <functional>

#include "measure/thresholds.h"

namespace carreau {

SpreadTriangle::SpreadTriangle(const SurfaceMesh& mesh, const SpreadAtlas& atlas, Cad& cad, std::size_t f, std::size_t t)
    : atlas_(atlas), cad_(cad) {
  const FaceMesh& face = mesh.faces[f];
  for (int i = 0; i < 3; ++i) {
    const std::int32_t local = face.triangles[t][i];
    corner_[i] = mesh.vertices[face.vertex[local]];
    place_[i] = atlas.charts->evaluate(cad, {atlas.feet[f][local], face.uv[local]});
  }
  const auto& all = atlas.charts->triangles();
  const std::int32_t any = place_[0].foot.triangle;
  turned_ = all[any].turned != atlas.is_turned(static_cast<std::int32_t>(f), any);
}

Vec3 SpreadTriangle::flat(const std::array<double, 3>& weight) const {
  return weight[0] * corner_[0] + weight[1] * corner_[1] + weight[2] * corner_[2];
}

std::optional<SurfacePlace> SpreadTriangle::over(const std::array<double, 3>& weight) const {
  const Vec3 target = flat(weight);
  std::array<int, 3> order{0, 1, 2};
  std::ranges::stable_sort(order, std::greater<>(), [&](int i) { return weight[i]; });
  for (const int i : order)
    if (place_[i].regular)
      if (const auto found = atlas_.charts->towards(cad_, place_[i], target, true, thresholds::measure::near_foot)) return found;
  return {};
}

// Normals of places are those of the atlas.
Vec3 SpreadTriangle::normal(const SurfacePlace& place) const { return turned_ ? Vec3(-place.normal) : place.normal; }

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
      const SpreadTriangle triangle(mesh, atlas, cad, f, t);
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
