// SPDX-License-Identifier: BSD-3-Clause
#include "measure/spread_samples.h"

#include <algorithm>
#include <optional>

namespace carreau {

namespace {

class SpreadTriangle {
 public:
  SpreadTriangle(const SurfaceMesh& mesh, const SpreadAtlas& atlas, Cad& cad, std::size_t f, std::size_t t)
      : atlas_(atlas), cad_(cad), face_(static_cast<std::int32_t>(f)) {
    const FaceMesh& face = mesh.faces[f];
    for (int i = 0; i < 3; ++i) {
      const std::int32_t local = face.triangles[t][i];
      corner_[i] = mesh.vertices[face.vertex[local]];
      place_[i] = atlas.charts->evaluate(cad, {atlas.feet[f][local], face.uv[local]});
    }
  }

  /// From the corner of the largest weight that leads there, or to a barrier beside.
  void sample(const std::array<double, 3>& weight, SpreadSample& sample) const {
    sample.flat = weight[0] * corner_[0] + weight[1] * corner_[1] + weight[2] * corner_[2];
    std::array<int, 3> order{0, 1, 2};
    std::ranges::stable_sort(order, std::greater<>(), [&](int i) { return weight[i]; });
    for (const int i : order) {
      if (!place_[i].regular) continue;
      if (const auto found = atlas_.charts->towards(cad_, place_[i], sample.flat, true)) {
        sample.face = atlas_.charts->face(found->foot);
        sample.uv = found->foot.uv;
        sample.turned = atlas_.is_turned(face_, found->foot.triangle);
        return;
      }
    }
  }

 private:
  const SpreadAtlas& atlas_;
  Cad& cad_;
  std::int32_t face_;
  std::array<Vec3, 3> corner_;
  std::array<SurfacePlace, 3> place_;
};

}  // namespace

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
        triangle.sample(weight, sample);
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
