// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/discrete/sharp_angle.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "geometry/discrete/thresholds.h"
#include "model/union_find.h"
#include "support/shares.h"

namespace carreau::discrete {

namespace {

std::size_t offset(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

/// Looks for edges inside tessellated curved surfaces: beyond the flat facets on both sides, parallel edges turn the
/// normal on by about the same angle.
class RoundEdges {
 public:
  RoundEdges(const Triangulation& mesh, const std::vector<double>& bends) : mesh_(mesh), bends_(bends) {}

  std::vector<char> run() {
    std::vector<char> round(bends_.size(), 0);
    std::vector<std::int32_t> asked;
    for (std::int32_t e = 0; e < static_cast<std::int32_t>(bends_.size()); ++e)
      if (bends_[offset(e)] > thresholds::min_sharp && bends_[offset(e)] <= thresholds::max_round) asked.push_back(e);
    if (asked.empty()) return round;
    find_facets();
    for (const std::int32_t e : asked) {
      const auto sides = mesh_.sides(e);
      const std::optional<double> one = width(e, sides[0]), other = width(e, sides[1]);
      if (one && other && std::max(*one, *other) <= thresholds::round_widths * std::min(*one, *other))
        round[offset(e)] = 1;
    }
    return round;
  }

 private:
  [[nodiscard]] bool may_turn(std::int32_t e) const {
    return bends_[offset(e)] > thresholds::min_turn * thresholds::min_sharp &&
           bends_[offset(e)] <= thresholds::max_turn * thresholds::max_round;
  }

  // Facets are flat; each gets the sides over which it may turn on.
  void find_facets() {
    UnionFind sets(mesh_.triangles.size());
    for (std::size_t e = 0; e < bends_.size(); ++e)
      if (bends_[e] <= thresholds::flat_bend) {
        const auto sides = mesh_.sides(static_cast<std::int32_t>(e));
        sets.merge(offset(sides[0].triangle), offset(sides[1].triangle));
      }
    facet_.resize(mesh_.triangles.size());
    for (std::size_t t = 0; t < facet_.size(); ++t) facet_[t] = sets.find(t);
    for (std::int32_t e = 0; e < static_cast<std::int32_t>(bends_.size()); ++e)
      if (may_turn(e))
        for (const Side& side : mesh_.sides(e)) sides_.push_back({facet_[offset(side.triangle)], side});
    std::ranges::stable_sort(sides_, {}, &FacetSide::facet);
  }

  /// The turn of the normal over a side, outwards: its axis, times degrees.
  [[nodiscard]] Vec3 turn(const Side& side) const {
    const Side out = mesh_.beyond(side.triangle, side.side);
    const Vec3 axis = cross(mesh_.normal(side.triangle), mesh_.normal(out.triangle));
    return axis * (bends_[offset(mesh_.edge(side.triangle, side.side))] / norm(axis));
  }
  [[nodiscard]] Vec3 middle(const Side& side) const {
    return 0.5 * (mesh_.at(mesh_.corner(side.triangle, side.side)) + mesh_.at(mesh_.corner(side.triangle, side.side + 1)));
  }

  /// Distance across the facet of `from` to the next edge over which the normal turns on; empty if it does not.
  [[nodiscard]] std::optional<double> width(std::int32_t e, const Side& from) const {
    const Vec3 here = turn(from), place = middle(from);
    const double angle = bends_[offset(e)];
    const Vec3 axis = here / angle;
    const std::size_t facet = facet_[offset(from.triangle)];
    const auto first = std::ranges::lower_bound(sides_, facet, {}, &FacetSide::facet);
    const auto last = std::ranges::upper_bound(sides_, facet, {}, &FacetSide::facet);
    if (last - first > (angle > thresholds::chamfer_angle ? thresholds::max_sides_beside_chamfer : thresholds::max_sides_of_facet))
      return {};
    std::optional<double> nearest;
    for (auto each = first; each != last; ++each) {
      if (mesh_.edge(each->side.triangle, each->side.side) == e) continue;
      const double turned = -dot(turn(each->side), axis);
      if (turned < thresholds::min_turn * angle || turned > thresholds::max_turn * angle) continue;
      const Vec3 way = middle(each->side) - place;
      const double across = norm(Vec3(way - dot(way, axis) * axis));
      if (!nearest || across < *nearest) nearest = across;
    }
    return nearest;
  }

  struct FacetSide {
    std::size_t facet;
    Side side;
  };

  const Triangulation& mesh_;
  const std::vector<double>& bends_;
  std::vector<std::size_t> facet_;  // by triangle
  std::vector<FacetSide> sides_;    // by facet
};

double gap_of(const Triangulation& mesh, const std::vector<double>& bends, const std::vector<char>& round) {
  std::vector<std::pair<double, double>> edges;  // degrees, length
  for (std::size_t e = 0; e < bends.size(); ++e)
    if (round[e] == 0 && bends[e] > thresholds::min_sharp - thresholds::gap_width && bends[e] < 180)
      edges.emplace_back(bends[e], norm(mesh.at(mesh.edges[e][1]) - mesh.at(mesh.edges[e][0])));
  std::ranges::sort(edges);
  std::vector<double> beyond(edges.size() + 1, 0);  // lengths from here on
  for (std::size_t k = edges.size(); k-- > 0;) beyond[k] = beyond[k + 1] + edges[k].second;
  const auto longer = [&](double degrees) {
    const auto from = std::ranges::upper_bound(edges, degrees, {}, &std::pair<double, double>::first);
    return beyond[static_cast<std::size_t>(from - edges.begin())];
  };
  constexpr double step = 0.5, half = thresholds::gap_width / 2;
  const double clear = longer(thresholds::usual_sharp);
  for (double angle = thresholds::min_sharp; angle < thresholds::usual_sharp; angle += step) {
    if (longer(angle) > 2 * clear) continue;  // most edges that bend are flatter: a coarse curved surface
    const double above = longer(angle + half);
    if (longer(angle - half) - above <= shares::notable * above) return angle;
  }
  return thresholds::usual_sharp;
}

}  // namespace

SharpAngle find_sharp_angle(const Triangulation& mesh, const std::vector<double>& bends) {
  SharpAngle found{.angle = 0, .round = RoundEdges(mesh, bends).run()};
  found.angle = gap_of(mesh, bends, found.round);
  return found;
}

}  // namespace carreau::discrete
