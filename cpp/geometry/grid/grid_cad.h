// SPDX-License-Identifier: BSD-3-Clause
// Grids as an evaluator of the engine.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "cad/cad.h"
#include "geometry/grid/coons_surface.h"

namespace carreau::grid {

/// A straight line of the parameter plane, run through at unit speed.
struct SideLine {
  Vec2 start, end;
};

class GridCad final : public Cad {
 public:
  /// Adds a face that is part of a block; several faces may share a surface. Not while others evaluate.
  void add(int ref, std::shared_ptr<const CoonsSurface> surface, std::vector<SideLine> sides);

  /// The surfaces of faces, by the smallest reference of a face on them.
  [[nodiscard]] std::vector<std::shared_ptr<const CoonsSurface>> surfaces() const;

  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override;
  Interval curve_interval(int face, int ic) override;
  CurveJet curve(int face, int ic, unsigned want, double t) override;
  [[nodiscard]] bool reentrant() const noexcept override { return true; }

 private:
  struct Part {
    std::shared_ptr<const CoonsSurface> surface;
    std::vector<SideLine> sides;
  };
  [[nodiscard]] const Part& part(int face) const;
  [[nodiscard]] const SideLine& side(int face, int ic) const;

  std::map<int, Part> parts_;
};

}  // namespace carreau::grid
