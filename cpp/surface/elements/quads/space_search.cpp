// SPDX-License-Identifier: BSD-3-Clause
#include "surface/elements/quads/space_search.h"

#include <algorithm>

#include "mesh/shape_levels.h"
#include "surface/elements/quads/quad_shape.h"
#include "surface/elements/quads/worst_quads.h"
#include "surface/sample/face_metric.h"

namespace carreau {

namespace {

using namespace thresholds::quads;

/// The cells of a face on its surface, for WorstQuads: each trial evaluates the host.
class LiftedQuads {
 public:
  struct Place {
    Vec2 uv;
    Vec3 xyz;
  };
  using Frame = Chart;
  static constexpr bool on_surface = false;

  LiftedQuads(const ElementWork& work, const ControlSpace& metric, FaceQuads& quads)
      : cad_(work.cad()),
        ref_(work.result.mesh.faces[quads.face].ref),
        metric_(metric),
        charts_(metric),
        quads_(quads),
        by_angles_(!work.isotropic()) {}

  [[nodiscard]] double poor() const noexcept { return by_angles_ ? poor_jacobian_in_metric : shape_level::poor; }
  [[nodiscard]] const std::vector<MixedCell>& cells() const noexcept { return quads_.patch.cells; }
  [[nodiscard]] std::size_t vertices() const noexcept { return quads_.patch.uv.size(); }
  [[nodiscard]] bool is_fixed(std::size_t v) const noexcept { return quads_.patch.fixed[v] != 0; }
  [[nodiscard]] Frame about(const MixedCell& cell) const noexcept { return charts_.about(quads_.patch, cell); }
  [[nodiscard]] Frame about(std::int32_t v) const noexcept { return charts_.about(quads_.patch.uv[v]); }
  static Vec2 way(const Frame& frame, const Vec2& y) noexcept { return frame.offset(y); }

  /// The shape in space, at least -1, and below -1 for cells that are turned over in (u, v): no cell turns over for shapes in space.
  [[nodiscard]] double untangling_quality(const Frame& frame, const MixedCell& cell) const noexcept {
    return is_convex(quads_.patch, cell) ? shape(cell) : carreau::untangling_quality(quads_.patch, frame, cell) - 1;
  }

  [[nodiscard]] Place place(std::size_t v) const { return {quads_.patch.uv[v], quads_.xyz[v]}; }
  void put(std::size_t v, const Place& place) { quads_.patch.uv[v] = place.uv, quads_.xyz[v] = place.xyz; }
  void try_at(std::size_t v, const Place& from, const Vec2& way) {
    const Vec2 uv = from.uv + way;
    put(v, {uv, surface_at(cad_, ref_, want_position, uv).s});
  }
  bool settle(std::size_t v, const Place& /*from*/) {
    const Vec2 uv = quads_.lifted[v] = quads_.patch.uv[v];
    quads_.size[v] = geometric_mean_size(surface_at(cad_, ref_, want_position | want_first, uv), metric_.at(uv));
    return true;
  }

 private:
  // The scaled Jacobian, for a triangle of its parallelograms; the quality if it is less: good angles must not be
  // bought by long rectangles beside them, unless sizes ask for these.
  [[nodiscard]] double shape(const MixedCell& c) const noexcept {
    const auto at = [&](int k) -> const Vec3& { return quads_.xyz[c[k]]; };
    if (corners_of(c) == 4) {
      const std::array<Vec3, 4> p{at(0), at(1), at(2), at(3)};
      return by_angles_ ? scaled_jacobian(p) : min_shape(p);
    }
    const Vec3 a = at(1) - at(0), b = at(2) - at(0), d = at(2) - at(1);
    const double longest = std::max({norm(a) * norm(b), norm(a) * norm(d), norm(b) * norm(d)});
    return longest > 0 ? norm(cross(a, b)) / longest : 0;
  }

  Cad& cad_;
  int ref_;
  const ControlSpace& metric_;
  FaceCharts charts_;
  FaceQuads& quads_;
  bool by_angles_;
};

}  // namespace

void improve_in_space(const ElementWork& work, const ControlSpace& metric, FaceQuads& quads, Monitor& monitor) {
  LiftedQuads lifted(work, metric, quads);
  WorstQuads<LiftedQuads>(lifted, lifted.poor(), monitor).run();
}

}  // namespace carreau
