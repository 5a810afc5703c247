// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/grid/grid_cad.h"

#include <algorithm>

#include "support/error.h"

namespace carreau::grid {

void GridCad::add(int ref, std::shared_ptr<const CoonsSurface> surface, std::vector<SideLine> sides) {
  parts_[ref] = {std::move(surface), std::move(sides)};
}

std::vector<std::shared_ptr<const CoonsSurface>> GridCad::surfaces() const {
  std::vector<std::shared_ptr<const CoonsSurface>> all;
  for (const auto& [ref, part] : parts_)
    if (std::find(all.begin(), all.end(), part.surface) == all.end()) all.push_back(part.surface);
  return all;
}

const GridCad::Part& GridCad::part(int face) const {
  const auto found = parts_.find(face);
  if (found == parts_.end()) throw InvalidArgument(Where{.face = face}, "the grids have no such face");
  return found->second;
}

const SideLine& GridCad::side(int face, int ic) const {
  const Part& p = part(face);
  if (ic < 1 || static_cast<std::size_t>(ic) > p.sides.size())
    throw InvalidArgument(Where{.face = face, .curve_index = ic}, "the face has no such curve");
  return p.sides[static_cast<std::size_t>(ic) - 1];
}

void GridCad::surface(int face, unsigned, std::span<const Vec2> uv, std::span<SurfaceJet> out) {
  const CoonsSurface& s = *part(face).surface;
  for (std::size_t k = 0; k < uv.size(); ++k) out[k] = s.at(uv[k]);
}

Interval GridCad::curve_interval(int face, int ic) {
  const SideLine& line = side(face, ic);
  return {0, norm(line.end - line.start)};
}

CurveJet GridCad::curve(int face, int ic, unsigned, double t) {
  const SideLine& line = side(face, ic);
  const double length = norm(line.end - line.start);
  const Vec2 direction = (line.end - line.start) / length;
  return {t >= length ? line.end : Vec2(line.start + t * direction), direction, {}};
}

}  // namespace carreau::grid
