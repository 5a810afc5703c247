// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/planes/flat_atlas.h"

namespace carreau {

FlatAtlas::FlatAtlas(const Charts& atlas, const SurfaceMesh& of, const VertexJets& jets) : charts(atlas), mesh(of) {
  const std::size_t n = atlas.triangles().size();
  normal.reserve(n), centre.reserve(n), area.reserve(n), corner.reserve(n);
  for (const Charts::Triangle& t : atlas.triangles()) {
    const Vec3 &a = xyz(t.vertex[0]), &b = xyz(t.vertex[1]), &c = xyz(t.vertex[2]);
    const Vec3 across = cross(b - a, c - a);
    area.push_back(norm(across));
    normal.push_back(area.back() > 0 ? Vec3(across / area.back()) : Vec3{0, 0, 0});
    centre.push_back((a + b + c) / 3);
    auto& here = corner.emplace_back();
    for (int i = 0; i < 3; ++i) {
      const SurfaceJet& jet = jets[t.face][t.local[i]];
      const Vec3 up = cross(jet.su, jet.sv);
      const double length = norm(up);
      here[i] = length > 0 ? Vec3(up / length) : normal.back();
    }
  }
}

Vec3 FlatAtlas::flat(const Foot& f) const {
  const std::array<double, 3> w = charts.weights(f.triangle, f.uv);
  const auto& v = at(f.triangle).vertex;
  return w[0] * xyz(v[0]) + w[1] * xyz(v[1]) + w[2] * xyz(v[2]);
}

}  // namespace carreau
