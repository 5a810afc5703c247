// SPDX-License-Identifier: BSD-3-Clause
#include "surface/quads/space_search.h"

#include <algorithm>
#include <optional>

#include "mesh/local_search.h"
#include "support/incidence.h"
#include "surface/quads/quad_shape.h"
#include "surface/quads/thresholds.h"
#include "surface/sample/face_metric.h"

namespace carreau {

namespace {

using namespace thresholds::quads;

class SpaceSearch {
 public:
  SpaceSearch(const ElementWork& work, const ControlSpace& metric, FaceQuads& quads, Monitor& monitor)
      : cad_(work.cad()),
        ref_(work.result.mesh.faces[quads.face].ref),
        metric_(metric),
        charts_(metric),
        quads_(quads),
        by_angles_(!work.isotropic()),
        poor_(by_angles_ ? poor_jacobian_in_metric : poor_in_space),
        monitor_(monitor),
        shape_(quads.patch.cells.size(), 0),
        stale_(quads.patch.cells.size(), 1),
        in_vain_(quads.patch.uv.size(), 0) {}

  void run() {
    improve_in_passes(
        worst_passes, monitor_, [this] { return corners_of_poor(); }, [this](std::int32_t v) { return improve(v); });
  }

 private:
  static std::vector<MixedCell> closed(std::vector<MixedCell> cells) {
    for (MixedCell& cell : cells)
      if (cell[3] < 0) cell[3] = cell[0];
    return cells;
  }

  // The scaled Jacobian (for a triangle, of its parallelograms), or the quality if it is less. Long rectangles must not
  // appear beside cells with good angles, unless the sizes require them.
  [[nodiscard]] double shape(const MixedCell& c) const {
    const auto at = [&](int k) -> const Vec3& { return quads_.xyz[c[k]]; };
    if (corners_of(c) == 4) {
      const std::array<Vec3, 4> p{at(0), at(1), at(2), at(3)};
      return by_angles_ ? scaled_jacobian(p) : least_shape(p);
    }
    const Vec3 a = at(1) - at(0), b = at(2) - at(0), d = at(2) - at(1);
    const double longest = std::max({norm(a) * norm(b), norm(a) * norm(d), norm(b) * norm(d)});
    return longest > 0 ? norm(cross(a, b)) / longest : 0;
  }

  [[nodiscard]] std::vector<std::int32_t> corners_of_poor() {
    std::vector<std::pair<double, std::int32_t>> poor;
    for (std::size_t c = 0; c < quads_.patch.cells.size(); ++c) {
      const MixedCell& cell = quads_.patch.cells[c];
      if (stale_[c] != 0) shape_[c] = is_convex(quads_.patch, cell) ? shape(cell) : -1;
      stale_[c] = 0;
      if (shape_[c] < poor_) poor.emplace_back(shape_[c], static_cast<std::int32_t>(c));
    }
    std::sort(poor.begin(), poor.end());
    std::vector<std::int32_t> corners;
    for (const auto& [j, c] : poor)
      for (int k = 0; k < corners_of(quads_.patch.cells[c]); ++k)
        if (const std::int32_t v = quads_.patch.cells[c][k]; quads_.patch.fixed[v] == 0) corners.push_back(v);
    return corners;
  }

  [[nodiscard]] double least_around(std::int32_t v, double enough) const {
    double least = poor_;
    for (const std::int32_t c : around_->of(v)) {
      const MixedCell& cell = quads_.patch.cells[c];
      least = std::min(least, shape(cell));
      if (!is_convex(quads_.patch, cell))
        least = std::min(least, untangling_quality(quads_.patch, charts_.about(quads_.patch, cell), cell));
      if (least < enough) break;
    }
    return least;
  }

  void place(std::int32_t v, const Vec2& uv) {
    quads_.patch.uv[v] = uv;
    quads_.xyz[v] = surface_at(cad_, ref_, want_position, uv).s;
  }

  bool improve(std::int32_t v) {
    if (in_vain_[v] != 0) return false;
    if (!around_) around_.emplace(quads_.patch.uv.size(), closed(quads_.patch.cells));
    const double start = least_around(v, -2);
    if (start >= poor_) return false;
    const Vec2 home = quads_.patch.uv[v];
    const Vec3 at_home = quads_.xyz[v];
    const Chart chart = charts_.about(home);
    const Vec2 way = search_along_compass(start, first_step, last_step, [&](const Vec2& there, double best) {
      place(v, home + chart.offset(there));
      return least_around(v, best);
    });
    quads_.patch.uv[v] = home, quads_.xyz[v] = at_home;
    in_vain_[v] = 1;
    if (way == Vec2{0, 0}) return false;
    const Vec2 uv = home + chart.offset(way);
    const SurfaceJet jet = surface_at(cad_, ref_, want_position | want_first, uv);
    quads_.patch.uv[v] = quads_.lifted[v] = uv, quads_.xyz[v] = jet.s;
    quads_.size[v] = geometric_mean_size(jet, metric_.at(uv));
    for (const std::int32_t c : around_->of(v)) {
      stale_[c] = 1;
      for (int k = 0; k < corners_of(quads_.patch.cells[c]); ++k) in_vain_[quads_.patch.cells[c][k]] = 0;
    }
    return true;
  }

  Cad& cad_;
  int ref_;
  const ControlSpace& metric_;
  FaceCharts charts_;
  FaceQuads& quads_;
  bool by_angles_;
  double poor_;
  Monitor& monitor_;
  std::optional<Incidence> around_;
  std::vector<double> shape_;  // by cell, unless
  std::vector<char> stale_;    // its vertices have moved since
  std::vector<char> in_vain_;  // by vertex: nothing around has moved since a search
};

}  // namespace

void improve_in_space(const ElementWork& work, const ControlSpace& metric, FaceQuads& quads, Monitor& monitor) {
  SpaceSearch(work, metric, quads, monitor).run();
}

}  // namespace carreau
