// SPDX-License-Identifier: BSD-3-Clause
// A discrete surface as an evaluator of the engine.
#pragma once

#include <memory>

#include "cad/cad.h"
#include "geometry/built_geometry.h"
#include "geometry/discrete/surface.h"

namespace carreau::discrete {

/// The plane of (u, v) has a tile for each triangle, far from all others. Triangle t of the surface, with the whole
/// numbers (i, j) = (t mod w, t div w), has the corners (d i, d j), (d i + 1, d j), (d i, d j + 1), d = tile_distance.
/// Faces are regions of the surface; the location of points does not use them. There are no curves of the parameter
/// plane.
inline constexpr double tile_distance = 64;

class DiscreteCad final : public Cad {
 public:
  explicit DiscreteCad(std::shared_ptr<const DiscreteSurface> surface);

  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override;
  Interval curve_interval(int face, int ic) override;
  CurveJet curve(int face, int ic, unsigned want, double t) override;
  [[nodiscard]] bool reentrant() const noexcept override { return true; }

  [[nodiscard]] const DiscreteSurface& discrete() const noexcept { return *surface_; }
  /// The first corner of a surface triangle's tile.
  [[nodiscard]] Vec2 corner_of_tile(std::int32_t triangle) const noexcept;
  /// The triangle that has a place of (u, v), with room around; -1: none.
  [[nodiscard]] std::int32_t patch_of(const Vec2& uv) const noexcept;

 private:
  std::shared_ptr<const DiscreteSurface> surface_;
  std::int32_t width_;
};

/// Evaluator, and a model with faces only (Face::discrete): one for each reference of face_refs().
BuiltGeometry discrete_geometry(std::shared_ptr<const DiscreteSurface> surface);

}  // namespace carreau::discrete
