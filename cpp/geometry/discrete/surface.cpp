// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/discrete/surface.h"

#include <algorithm>

#include "geometry/discrete/normals.h"
#include "geometry/discrete/unfolding.h"

namespace carreau::discrete {

DiscreteSurface::DiscreteSurface(Triangulation triangulation, SharpLines found, std::vector<std::int32_t> faces)
    : mesh_(std::move(triangulation)), lines_(std::move(found)), faces_(std::move(faces)) {
  Frames frames = find_frames(mesh_, lines_);
  curves_ = find_curves(mesh_, lines_, frames);
  const Unfolding done = unfold(mesh_, lines_, frames, curves_);
  unfolded_ = done.unfolded, folded_ = done.folded;
  normals_ = std::move(frames.normal);
  patches_.reserve(mesh_.triangles.size());
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh_.triangles.size()); ++t) {
    std::array<Cubic, 3> sides;
    std::array<Vec3, 6> normals;
    for (int i = 0; i < 3; ++i) {
      const std::int32_t e = mesh_.edge(t, i);
      Cubic& z = sides[static_cast<std::size_t>(i)] = curve(e);
      if (mesh_.edges[static_cast<std::size_t>(e)][0] != mesh_.corner(t, i)) std::ranges::reverse(z);
      normals[static_cast<std::size_t>(2 * i)] = normal(t, i);
      normals[static_cast<std::size_t>(2 * i + 1)] = normal(t, i + 1);
    }
    patches_.push_back(gregory_triangle(sides, normals));
  }
}

double DiscreteSurface::deviation() const noexcept {
  double most = 0;
  for (const GregoryTriangle& patch : patches_) most = std::max(most, patch.deviation());
  return most;
}

}  // namespace carreau::discrete
