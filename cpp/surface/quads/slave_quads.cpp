// SPDX-License-Identifier: BSD-3-Clause
#include "surface/quads/slave_quads.h"

#include <algorithm>
#include <cstddef>

#include "periodic/thresholds.h"
#include "surface/carry/carry_faces.h"
#include "surface/carry/image_vertices.h"

namespace carreau {

namespace {

std::int32_t image_of(SlaveQuads& quads, std::int32_t v) {
  if (static_cast<std::size_t>(v) >= quads.image.size()) quads.image.resize(quads.master->patch.uv.size(), -1);
  std::int32_t& image = quads.image[v];
  if (image >= 0) return image;
  FaceQuads& slave = *quads.slave;
  image = static_cast<std::int32_t>(slave.patch.uv.size());
  slave.patch.uv.push_back(slave.patch.uv.front());
  slave.patch.fixed.push_back(0);
  slave.vertex.push_back(-1);
  return image;
}

// The first corner stays the first one.
int corner_of(int k, int n, bool flipped) { return flipped ? (n - k) % n : k; }

}  // namespace

void copy_cells(SlaveQuads& quads) {
  std::vector<MixedCell> cells;
  for (const MixedCell& cell : quads.master->patch.cells) {
    MixedCell image{-1, -1, -1, -1};
    for (int k = 0, n = corners_of(cell); k < n; ++k) image[k] = image_of(quads, cell[corner_of(k, n, quads.pair->flipped)]);
    cells.push_back(image);
  }
  quads.slave->patch.cells = std::move(cells);
}

// A cell with corners c and middles m of the sides behind them is cut into (c[k], m[k], centre, m[k - 1]).
void match_halves(const std::vector<int>& corners, SlaveQuads& quads) {
  const bool flipped = quads.pair->flipped;
  quads.image.resize(quads.master->patch.uv.size(), -1);
  std::size_t first = 0;
  for (const int n : corners) {
    for (int k = 0; k < n; ++k) {
      const MixedCell& there = quads.slave->patch.cells[first + k];
      const MixedCell& here = quads.master->patch.cells[first + static_cast<std::size_t>(corner_of(k, n, flipped))];
      for (int i = 0; i < 4; ++i) quads.image[here[corner_of(i, 4, flipped)]] = there[i];
    }
    first += static_cast<std::size_t>(n);
  }
  for (std::size_t t = 0; t < quads.master->flattened.size() && t < quads.slave->flattened.size(); ++t)
    for (int i = 0; i < 3; ++i) quads.image[quads.master->flattened[t][corner_of(i, 3, flipped)]] = quads.slave->flattened[t][i];
}

void place_cells(const ElementWork& work, SlaveQuads& quads) {
  const FaceQuads& master = *quads.master;
  FaceQuads& slave = *quads.slave;
  const std::size_t n = slave.patch.uv.size(), known = slave.xyz.size();
  slave.xyz.resize(n), slave.size.resize(n, -1);
  for (std::size_t v = known; v < n; ++v)
    if (slave.vertex[v] >= 0) slave.xyz[v] = work.result.mesh.vertices[slave.vertex[v]];
  ImageVertices vertices{.cad = work.cad(), .face = work.result.mesh.faces[slave.face].ref, .target = slave.xyz,
                         .from_uv = std::vector<Vec2>(n), .known = std::vector<char>(n, 1)};
  for (std::size_t v = 0; v < quads.image.size(); ++v) {
    const std::int32_t w = quads.image[v];
    if (w < 0) continue;
    vertices.from_uv[w] = master.patch.uv[v];
    if (slave.patch.fixed[w] != 0) continue;
    vertices.known[w] = 0;
    vertices.target[w] = quads.pair->map(master.xyz[v]);
    slave.size[w] = master.size[v] >= 0 ? master.size[v] : work.result.vertex_size[master.vertex[v]];
  }
  // What the master has left is not fitted.
  std::vector<char> used(n, 0);
  for (const std::int32_t w : quads.image)
    if (w >= 0) used[w] = 1;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const MixedCell& c : slave.patch.cells) {
    triangles.push_back({c[0], c[1], c[2]});
    if (corners_of(c) == 4) triangles.push_back({c[0], c[2], c[3]});
  }
  ImageVertices fitted{.cad = vertices.cad, .face = vertices.face, .target = {}, .from_uv = {}, .known = {}};
  std::vector<std::int32_t> rank(n, -1), of;
  std::vector<Vec2> uv;
  std::vector<Vec3> xyz;
  for (std::size_t w = 0; w < n; ++w) {
    if (used[w] == 0) continue;
    rank[w] = static_cast<std::int32_t>(of.size());
    of.push_back(static_cast<std::int32_t>(w));
    fitted.target.push_back(vertices.target[w]), fitted.from_uv.push_back(vertices.from_uv[w]), fitted.known.push_back(vertices.known[w]);
    uv.push_back(slave.patch.uv[w]), xyz.push_back(slave.xyz[w]);
  }
  for (auto& t : triangles)
    for (std::int32_t& w : t) w = rank[w];
  place_images(fitted, triangles, thresholds::periodic::exact_images * work.periodic->gap, uv, xyz);
  for (std::size_t i = 0; i < of.size(); ++i) slave.patch.uv[of[i]] = uv[i], slave.xyz[of[i]] = xyz[i];
  slave.lifted = slave.patch.uv;
}

void carry_back(const SlaveQuads& quads, SurfaceMesh& mesh) {
  const FaceMesh& from = mesh.faces[quads.master->face];
  std::vector<std::int32_t> image(from.uv.size(), -1);
  for (std::size_t v = 0; v < quads.image.size() && v < quads.master->now.size(); ++v)
    if (quads.master->now[v] >= 0 && quads.image[v] >= 0) image[quads.master->now[v]] = quads.slave->now[quads.image[v]];
  carry_elements(from, image, quads.pair->flipped, mesh.faces[quads.slave->face]);
}

}  // namespace carreau
