// SPDX-License-Identifier: BSD-3-Clause
// An atlas as a geometry of the engine.
#include <cmath>
#include <map>

#include "geometry/atlas/blended_surface.h"
#include "support/error.h"
#include "support/infinity.h"

namespace carreau::atlas {
namespace {

class AtlasCad final : public Cad {
 public:
  explicit AtlasCad(std::shared_ptr<const BlendedSurface> surface) : surface_(std::move(surface)) {}

  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override {
    const std::size_t chart = chart_of(face);
    const int order = (want & want_second) != 0 ? 2 : 1;
    for (std::size_t k = 0; k < uv.size(); ++k) out[k] = surface_->at(chart, uv[k], order);
  }
  Interval curve_interval(int face, int ic) override {
    (void)side_of(face, ic);
    return {-1, 1};
  }
  CurveJet curve(int face, int ic, unsigned, double t) override {
    return surface_->side(chart_of(face), side_of(face, ic), t);
  }
  /// The radius of the surface along the curve. A border of charts is an arbitrary cut of a smooth surface, and its
  /// bends inside the surface need no short edges.
  std::optional<double> curve_radius(int face, int ic, double t) override {
    const CurveJet c = surface_->side(chart_of(face), side_of(face, ic), t);
    const SurfaceJet s = surface_->at(chart_of(face), c.c);
    const Vec3 along = c.ct.x() * s.su + c.ct.y() * s.sv, normal = cross(s.su, s.sv);
    const Vec3 bend = c.ct.x() * c.ct.x() * s.suu + 2 * c.ct.x() * c.ct.y() * s.suv + c.ct.y() * c.ct.y() * s.svv;
    const double curvature = std::abs(dot(bend, normal)), scale = dot(along, along) * norm(normal);
    return curvature > 0 ? scale / curvature : infinity;
  }
  [[nodiscard]] bool reentrant() const noexcept override { return true; }

 private:
  [[nodiscard]] std::size_t chart_of(int face) const {
    if (face < 1 || static_cast<std::size_t>(face) > surface_->covering().charts().size())
      throw InvalidArgument(Where{.face = face}, "the atlas has no such face");
    return static_cast<std::size_t>(face) - 1;
  }
  [[nodiscard]] std::size_t side_of(int face, int ic) const {
    const std::size_t sides = surface_->covering().charts()[chart_of(face)].corners.size();
    if (ic < 1 || static_cast<std::size_t>(ic) > sides)
      throw InvalidArgument(Where{.face = face, .curve_index = ic}, "the face has no such curve");
    return static_cast<std::size_t>(ic) - 1;
  }

  std::shared_ptr<const BlendedSurface> surface_;
};

/// A side of a T, by the corner that is not on it.
using SideOfT = std::pair<std::int32_t, int>;

/// The zone behind side k, equal for both charts of a double zone: the smaller of the sides of its two triangles T.
SideOfT zone_behind(const Chart& chart, std::size_t k) {
  const Corner &here = chart.corners[k], &next = chart.corners[(k + 1) % chart.corners.size()];
  return std::min(SideOfT{here.triple, (here.corner + 1) % 3}, SideOfT{next.triple, (next.corner + 2) % 3});
}

}  // namespace

BuiltGeometry build_atlas(std::shared_ptr<const BlendedSurface> surface) {
  Model model;
  std::map<SideOfT, int> curves;
  const std::vector<Chart>& charts = surface->covering().charts();
  for (std::size_t i = 0; i < charts.size(); ++i) {
    Face face{.ref = static_cast<int>(i) + 1, .curves = {}, .points = {}};
    const std::size_t n = charts[i].corners.size();
    for (std::size_t k = 0; k < n; ++k) {
      const int number =
          curves.try_emplace(zone_behind(charts[i], k), static_cast<int>(curves.size()) + 1).first->second;
      FaceCurve curve;
      curve.ref = number;
      curve.end1 = charts[i].corners[k].triple + 1, curve.end2 = charts[i].corners[(k + 1) % n].triple + 1;
      face.curves.push_back(curve);
    }
    model.faces.push_back(std::move(face));
  }
  return {std::make_shared<AtlasCad>(std::move(surface)), std::move(model)};
}

}  // namespace carreau::atlas
