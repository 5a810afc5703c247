// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/atlas/fold_check.h"

#include <cmath>

#include "geometry/atlas/fold_places.h"
#include "geometry/atlas/thresholds.h"
#include "model/format_point.h"

namespace carreau::atlas {
namespace {

/// The area of the surface against the normal of planes, and the size of its gradient.
struct Turn {
  Vec3 at{0, 0, 0};
  double area = 0, slope = 0;
  /// Returns whether the area is positive at all places this near.
  [[nodiscard]] bool holds(double distance) const { return area > thresholds::fold_safety * slope * distance; }
};

Turn turn_of(const SurfaceJet& jet, const Vec3& normal) {
  const Vec3 by_u = cross(jet.suu, jet.sv) + cross(jet.su, jet.suv);
  const Vec3 by_v = cross(jet.suv, jet.sv) + cross(jet.su, jet.svv);
  return {jet.s, dot(cross(jet.su, jet.sv), normal), std::hypot(dot(by_u, normal), dot(by_v, normal))};
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
    for (int corner = 0; corner < 3; ++corner)
      for (const Vec2& phi : narrow_strips(surface_.covering(), triple, corner))
        for (int i = 0; i < thresholds::cells_of_strip; ++i)
          look_at_strip(triple, corner, Vec2(i, i + 1) / thresholds::cells_of_strip, phi, 0);
  }

  void look_at_pure_zone(std::size_t chart) {
    const Annulus& annulus = surface_.covering().charts()[chart].annulus;
    Vec2 low = annulus.outer()[0], high = low;  // the smooth inner border is not inside the given one
    for (const Vec2& p : annulus.outer()) low = low.cwiseMin(p), high = high.cwiseMax(p);
    look_at_square(chart, (low + high) / 2, (high - low).maxCoeff() / 2, 0);
  }

  /// The first fold, as a sentence.
  [[nodiscard]] const std::string& found() const { return found_; }

 private:
  using Cell = std::array<Vec2, 3>;

  [[nodiscard]] const std::array<std::int32_t, 3>& charts_of(std::size_t triple) const {
    return surface_.covering().triples()[triple].chart;
  }
  [[nodiscard]] const Chart& chart(std::int32_t i) const {
    return surface_.covering().charts()[static_cast<std::size_t>(i)];
  }

  [[nodiscard]] Turn turn_at(std::size_t triple, const Vec2& place) const {
    const std::array<double, 3> weights = Covering::weights(pair_of(place));
    Vec3 normal(0, 0, 0);
    for (std::size_t c = 0; c < 3; ++c) normal += weights[c] * chart(charts_of(triple)[c]).frame.normal;
    return turn_of(surface_.at_triple(triple, place), normal);
  }

  void look_at_cell(std::size_t triple, const Cell& cell, int depth) {
    if (!found_.empty()) return;
    const Vec2 centre = (cell[0] + cell[1] + cell[2]) / 3;
    const double reach = norm(cell[1] - cell[0]) / std::numbers::sqrt3;
    for (int c = 0; c < 3; ++c)
      if (norm(centre - corner_of_t(c)) + reach < inner_length) return;  // in a pure zone
    const Turn turn = turn_at(triple, centre);
    if (turn.holds(reach)) return;
    if (turn.area <= 0 || depth == thresholds::cell_divisions) return note(turn, charts_of(triple)[0]);
    const Cell middle{(cell[1] + cell[2]) / 2, (cell[2] + cell[0]) / 2, (cell[0] + cell[1]) / 2};
    look_at_cell(triple, middle, depth + 1);
    for (std::size_t c = 0; c < 3; ++c)
      look_at_cell(triple, {cell[c], middle[(c + 2) % 3], middle[(c + 1) % 3]}, depth + 1);
  }

  /// A rectangle of tau and phi about a corner: the longer side is halved.
  void look_at_strip(std::size_t triple, int corner, const Vec2& tau, const Vec2& phi, int depth) {
    if (!found_.empty()) return;
    const auto place = [&](double t, double x) { return value_of(from_polar(corner, polar_at(t, x))); };
    const double t = tau.sum() / 2, x = phi.sum() / 2;
    const double along = norm(place(tau[1], x) - place(tau[0], x)), across = norm(place(t, phi[1]) - place(t, phi[0]));
    const Turn turn = turn_at(triple, place(t, x));
    if (turn.holds(std::hypot(along, across) / 2)) return;
    if (turn.area <= 0 || depth == 2 * thresholds::cell_divisions)
      return note(turn, charts_of(triple)[static_cast<std::size_t>(corner)]);
    const bool is_long = along > across;
    look_at_strip(triple, corner, is_long ? Vec2(tau[0], t) : tau, is_long ? phi : Vec2(phi[0], x), depth + 1);
    look_at_strip(triple, corner, is_long ? Vec2(t, tau[1]) : tau, is_long ? phi : Vec2(x, phi[1]), depth + 1);
  }

  void look_at_square(std::size_t chart, const Vec2& centre, double half, int depth) {
    if (!found_.empty()) return;
    const Chart& own = surface_.covering().charts()[chart];
    const bool is_small = depth >= thresholds::square_divisions;
    if (is_small && !own.annulus.encloses(centre)) return;  // the cells of T reach the border
    const Turn turn = turn_of(surface_.at(chart, centre), own.frame.normal);
    if (depth > 0 && turn.holds(std::numbers::sqrt2 * half)) return;
    if (is_small && (turn.area <= 0 || depth == thresholds::square_divisions + thresholds::cell_divisions))
      return note(turn, static_cast<std::int32_t>(chart));
    for (const double x : {-.5, .5})
      for (const double y : {-.5, .5}) look_at_square(chart, centre + half * Vec2(x, y), half / 2, depth + 1);
  }

  void note(const Turn& turn, std::int32_t chart) {
    found_ = "the blended surface is turned over near " + format_point(turn.at) + ", in chart " +
             std::to_string(chart + 1) +
             ": charts disagree there; smaller clusters (reach 1) or more even triangles help";
  }

  const BlendedSurface& surface_;
  std::string found_;
};

}  // namespace

std::string find_fold(const BlendedSurface& surface) {
  FoldSearch search(surface);
  for (std::size_t t = 0; t < surface.covering().triples().size() && search.found().empty(); ++t)
    search.look_at_triple(t);
  for (std::size_t i = 0; i < surface.covering().charts().size(); ++i) search.look_at_pure_zone(i);
  return search.found();
}

}  // namespace carreau::atlas
