// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/atlas/fold_check.h"

#include <algorithm>
#include <cmath>

#include "geometry/atlas/thresholds.h"
#include "model/format_point.h"
#include "support/rounding_of.h"

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

/// Places of phi across which curvatures of a chart's parameters jump: vertices, ends of arcs, and knots of the ratio of
/// both borders. Beside joints these angles also depend on tau, by little.
std::vector<double> knots_of(const Part& part) {
  std::vector<double> angles = part.ratio_angle, knots = part.phi;
  for (const Rounding& arc : part.rounding) angles.push_back(arc.first), angles.push_back(arc.last);
  for (const double at : angles)
    knots.push_back(hermite_inverse(part.angle_data(interval_of(part.angle, at), .5), at));
  return knots;
}

/// The strips of a T between knots of phi of the chart at a corner that are narrower than cells: the area has steep
/// waves in them. Each strip is a pair of angles about the corner.
std::vector<Vec2> narrow_strips(const Covering& covering, std::size_t triple, int corner) {
  const auto c = static_cast<std::size_t>(corner);
  const Triple& t = covering.triples()[triple];
  const Annulus& annulus = covering.charts()[static_cast<std::size_t>(t.chart[c])].annulus;
  std::vector<double> knots{0, sixth_turn};
  for (const Part& part : annulus.parts())
    for (const double phi : knots_of(part))
      if (const double at = std::fmod(phi - t.slot[c] * sixth_turn + 2 * annulus.period(), annulus.period());
          at < sixth_turn)
        knots.push_back(at);
  std::sort(knots.begin(), knots.end());
  constexpr double wide = 2.0 / thresholds::cells_of_t;
  std::vector<Vec2> strips;
  for (std::size_t k = 0; k + 1 < knots.size(); ++k)
    if (const double width = knots[k + 1] - knots[k]; width <= wide && width > rounding_of::places)
      strips.emplace_back(knots[k], knots[k + 1]);
  return strips;
}

class FoldSearch {
 public:
  explicit FoldSearch(const BlendedSurface& surface) : surface_(surface) {}

  void look_at_triple(std::size_t triple) {
    constexpr int n = thresholds::cells_of_t;
    const auto place = [&](int i, int j) -> Vec2 { return (i * corner_of_t(1) + j * corner_of_t(2)) / n; };
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        look_at(triple, {place(i, j), place(i + 1, j), place(i, j + 1)});
        if (i + j < n - 1) look_at(triple, {place(i + 1, j + 1), place(i, j + 1), place(i + 1, j)});
      }
    for (int corner = 0; corner < 3; ++corner)
      for (const Vec2& phi : narrow_strips(surface_.covering(), triple, corner))
        for (int i = 0; i < thresholds::cells_of_strip; ++i)
          (void)look_at_strip(triple, corner, Vec2(i, i + 1) / thresholds::cells_of_strip, phi, 0);
  }

  void look_at_pure_zone(std::size_t chart) {
    const Annulus& annulus = surface_.covering().charts()[chart].annulus;
    Vec2 low = annulus.outer()[0], high = low;  // the smooth inner border is not inside the given one
    for (const Vec2& p : annulus.outer()) low = low.cwiseMin(p), high = high.cwiseMax(p);
    (void)look_at_square(chart, (low + high) / 2, (high - low).maxCoeff() / 2, 0);
  }

  [[nodiscard]] const std::string& first() const { return found_.first; }
  [[nodiscard]] FoundFolds found() && { return std::move(found_); }

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

  /// A fold is mostly wider than its first place: if a cell has one, the repair needs places of the whole cell.
  void look_at(std::size_t triple, const Cell& cell) {
    if (look_at_cell(triple, cell, 0)) return;
    // Parts of the sides of a cell that has a fold: folds may be as narrow as .003 of T.
    constexpr int n = 16;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j)
        found_.places.push_back({triple, cell[0] + (i * (cell[1] - cell[0]) + j * (cell[2] - cell[0])) / n});
  }

  /// Returns whether the cell has a bound everywhere; notes the first place without one.
  [[nodiscard]] bool look_at_cell(std::size_t triple, const Cell& cell, int depth) {
    const Vec2 centre = (cell[0] + cell[1] + cell[2]) / 3;
    const double reach = norm(cell[1] - cell[0]) / std::numbers::sqrt3;
    for (int c = 0; c < 3; ++c)
      if (norm(centre - corner_of_t(c)) + reach < inner_length) return true;  // in a pure zone
    const Turn turn = turn_at(triple, centre);
    if (turn.holds(reach)) return true;
    if (turn.area <= 0 || depth == thresholds::cell_divisions) {
      found_.places.push_back({triple, centre});
      return note(turn, charts_of(triple)[0]);
    }
    const Cell middle{(cell[1] + cell[2]) / 2, (cell[2] + cell[0]) / 2, (cell[0] + cell[1]) / 2};
    if (!look_at_cell(triple, middle, depth + 1)) return false;
    for (std::size_t c = 0; c < 3; ++c)
      if (!look_at_cell(triple, {cell[c], middle[(c + 2) % 3], middle[(c + 1) % 3]}, depth + 1)) return false;
    return true;
  }

  /// A rectangle of tau and phi about a corner: the longer side is halved.
  [[nodiscard]] bool look_at_strip(std::size_t triple, int corner, const Vec2& tau, const Vec2& phi, int depth) {
    const auto place = [&](double t, double x) { return value_of(from_polar(corner, polar_at(t, x))); };
    const double t = tau.sum() / 2, x = phi.sum() / 2;
    const double along = norm(place(tau[1], x) - place(tau[0], x)), across = norm(place(t, phi[1]) - place(t, phi[0]));
    const Turn turn = turn_at(triple, place(t, x));
    if (turn.holds(std::hypot(along, across) / 2)) return true;
    if (turn.area <= 0 || depth == 2 * thresholds::cell_divisions) {
      found_.places.push_back({triple, place(t, x)});
      return note(turn, charts_of(triple)[static_cast<std::size_t>(corner)]);
    }
    const bool is_long = along > across;
    return look_at_strip(triple, corner, is_long ? Vec2(tau[0], t) : tau, is_long ? phi : Vec2(phi[0], x), depth + 1) &&
           look_at_strip(triple, corner, is_long ? Vec2(t, tau[1]) : tau, is_long ? phi : Vec2(x, phi[1]), depth + 1);
  }

  [[nodiscard]] bool look_at_square(std::size_t chart, const Vec2& centre, double half, int depth) {
    const Chart& own = surface_.covering().charts()[chart];
    const bool is_small = depth >= thresholds::square_divisions;
    if (is_small && !own.annulus.encloses(centre)) return true;  // the cells of T reach the border
    const Turn turn = turn_of(surface_.at(chart, centre), own.frame.normal);
    if (depth > 0 && turn.holds(std::numbers::sqrt2 * half)) return true;
    if (is_small && (turn.area <= 0 || depth == thresholds::square_divisions + thresholds::cell_divisions))
      return note(turn, static_cast<std::int32_t>(chart));
    for (const double x : {-.5, .5})
      for (const double y : {-.5, .5})
        if (!look_at_square(chart, centre + half * Vec2(x, y), half / 2, depth + 1)) return false;
    return true;
  }

  bool note(const Turn& turn, std::int32_t chart) {
    if (!found_.first.empty()) return false;
    found_.first = "the blended surface is turned over near " + format_point(turn.at) + ", in chart " +
             std::to_string(chart + 1) +
             ": charts disagree there; smaller clusters (reach 1) or more even triangles help";
    return false;
  }

  const BlendedSurface& surface_;
  FoundFolds found_;
};

}  // namespace

FoundFolds find_folds(const BlendedSurface& surface, bool needs_places) {
  FoldSearch search(surface);
  const auto goes_on = [&] { return needs_places || search.first().empty(); };
  for (std::size_t t = 0; t < surface.covering().triples().size() && goes_on(); ++t) search.look_at_triple(t);
  for (std::size_t i = 0; i < surface.covering().charts().size() && goes_on(); ++i) search.look_at_pure_zone(i);
  return std::move(search).found();
}

}  // namespace carreau::atlas
