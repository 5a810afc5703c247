// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/atlas/fold_check.h"

#include <cmath>

#include "geometry/atlas/thresholds.h"
#include "model/format_point.h"

namespace carreau::atlas {
namespace {

/// The area of the surface against the normal of planes, and the size of its gradient.
struct Turn {
  double area = 0, slope = 0;
  /// Returns whether the area is positive at all places this near.
  [[nodiscard]] bool holds(double distance) const { return area > thresholds::fold_safety * slope * distance; }
};

Turn turn_of(const SurfaceJet& jet, const Vec3& normal) {
  const Vec3 by_u = cross(jet.suu, jet.sv) + cross(jet.su, jet.suv);
  const Vec3 by_v = cross(jet.suv, jet.sv) + cross(jet.su, jet.svv);
  return {dot(cross(jet.su, jet.sv), normal), std::hypot(dot(by_u, normal), dot(by_v, normal))};
}

class FoldSearch {
 public:
  explicit FoldSearch(const BlendedSurface& surface) : surface_(surface) {}

  void look_at_triple(std::size_t triple) {
    constexpr int n = thresholds::cells_of_t;
    const auto place = [&](int i, int j) -> Vec2 { return (i * corner_of_t(1) + j * corner_of_t(2)) / n; };
    for (int i = 0; i < n && found_.empty(); ++i)
      for (int j = 0; i + j < n; ++j) {
        look_at_cell(triple, {place(i, j), place(i + 1, j), place(i, j + 1)}, 0);
        if (i + j < n - 1) look_at_cell(triple, {place(i + 1, j + 1), place(i, j + 1), place(i + 1, j)}, 0);
      }
  }

  /// The pure zone of a chart whose primitive is no height field.
  void look_at_pure_zone(std::size_t chart) {
    const Annulus& annulus = surface_.covering().charts()[chart].annulus;
    Vec2 low = annulus.inner()[0], high = low;
    for (const Vec2& p : annulus.inner()) low = low.cwiseMin(p), high = high.cwiseMax(p);
    look_at_square(chart, (low + high) / 2, (high - low).maxCoeff() / 2, 0);
  }

  /// The first fold, as a sentence.
  [[nodiscard]] const std::string& found() const { return found_; }

 private:
  using Cell = std::array<Vec2, 3>;

  void look_at_cell(std::size_t triple, const Cell& cell, int depth) {
    if (!found_.empty()) return;
    const Vec2 centre = (cell[0] + cell[1] + cell[2]) / 3;
    const double reach = norm(cell[1] - cell[0]) / std::numbers::sqrt3;
    for (int c = 0; c < 3; ++c)
      if (norm(centre - corner_of_t(c)) + reach < inner_length) return;  // in a pure zone
    const auto weights = Covering::weights(pair_of(centre));
    const auto& charts = surface_.covering().triples()[triple].chart;
    Vec3 normal(0, 0, 0);
    for (std::size_t c = 0; c < 3; ++c)
      normal += weights[c] * surface_.covering().charts()[static_cast<std::size_t>(charts[c])].frame.normal;
    const SurfaceJet jet = surface_.at_triple(triple, centre);
    const Turn turn = turn_of(jet, normal);
    if (turn.holds(reach)) return;
    if (turn.area <= 0) return note(jet.s, charts[0]);
    if (depth == thresholds::cell_divisions) return;
    const Cell middle{(cell[1] + cell[2]) / 2, (cell[2] + cell[0]) / 2, (cell[0] + cell[1]) / 2};
    look_at_cell(triple, middle, depth + 1);
    for (std::size_t c = 0; c < 3; ++c)
      look_at_cell(triple, {cell[c], middle[(c + 2) % 3], middle[(c + 1) % 3]}, depth + 1);
  }

  void look_at_square(std::size_t chart, const Vec2& centre, double half, int depth) {
    if (!found_.empty()) return;
    const Chart& own = surface_.covering().charts()[chart];
    const bool is_small = depth >= thresholds::square_divisions;
    if (is_small && !own.annulus.encloses(centre)) return;  // the cells of T reach the border
    const SurfaceJet jet = surface_.at(chart, centre);
    const Turn turn = turn_of(jet, own.frame.normal);
    if (depth > 0 && turn.holds(std::numbers::sqrt2 * half)) return;
    if (is_small && turn.area <= 0) return note(jet.s, static_cast<std::int32_t>(chart));
    if (depth == thresholds::square_divisions + thresholds::cell_divisions) return;
    for (const double x : {-.5, .5})
      for (const double y : {-.5, .5}) look_at_square(chart, centre + half * Vec2(x, y), half / 2, depth + 1);
  }

  void note(const Vec3& at, std::int32_t chart) {
    found_ = "the blended surface is turned over near " + format_point(at) + ", in chart " + std::to_string(chart + 1) +
             ": charts disagree there; smaller clusters (reach 1) or more even triangles help";
  }

  const BlendedSurface& surface_;
  std::string found_;
};

}  // namespace

std::string find_fold(const BlendedSurface& surface) {
  FoldSearch search(surface);
  for (std::size_t t = 0; t < surface.covering().triples().size() && search.found().empty(); ++t) search.look_at_triple(t);
  for (std::size_t i = 0; i < surface.covering().charts().size(); ++i)
    if (surface.is_moved(i)) search.look_at_pure_zone(i);
  return search.found();
}

}  // namespace carreau::atlas
