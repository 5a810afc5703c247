// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/discrete/discrete_cad.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/discrete/refinement.h"
#include "support/error.h"

namespace carreau::discrete {

DiscreteCad::DiscreteCad(std::shared_ptr<const DiscreteSurface> surface)
    : surface_(std::move(surface)),
      width_(static_cast<std::int32_t>(std::ceil(std::sqrt(static_cast<double>(surface_->triangles()))))) {}

Vec2 DiscreteCad::corner_of_tile(std::int32_t triangle) const noexcept {
  return {tile_distance * (triangle % width_), tile_distance * (triangle / width_)};
}

std::int32_t DiscreteCad::patch_of(const Vec2& uv) const noexcept {
  const double i = std::floor((uv.x() + 1) / tile_distance), j = std::floor((uv.y() + 1) / tile_distance),
               triangle = j * width_ + i;
  const bool known = i >= 0 && i < width_ && triangle >= 0 && triangle < static_cast<double>(surface_->triangles());
  return known ? static_cast<std::int32_t>(triangle) : -1;
}

void DiscreteCad::surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) {
  for (std::size_t k = 0; k < uv.size(); ++k) {
    const std::int32_t triangle = patch_of(uv[k]);
    if (triangle < 0) throw InvalidArgument(Where{.face = face, .uv = uv[k]}, "no triangle has this place");
    out[k] = surface_->at(triangle, uv[k] - corner_of_tile(triangle), want);
  }
}

Interval DiscreteCad::curve_interval(int face, int ic) {
  throw InvalidArgument(Where{.face = face, .curve_index = ic},
                        "a surface of triangles has no curves of the parameter plane");
}

CurveJet DiscreteCad::curve(int face, int ic, unsigned, double) {
  throw InvalidArgument(Where{.face = face, .curve_index = ic},
                        "a surface of triangles has no curves of the parameter plane");
}

BuiltGeometry discrete_geometry(std::shared_ptr<const DiscreteSurface> surface) {
  BuiltGeometry built;
  const std::vector<std::int32_t> refs = face_refs(*surface);
  for (const int ref : std::set<int>(refs.begin(), refs.end())) {
    Face& face = built.model.faces.emplace_back();
    face.ref = ref, face.discrete = true;
  }
  built.cad = std::make_shared<DiscreteCad>(std::move(surface));
  return built;
}

}  // namespace carreau::discrete
