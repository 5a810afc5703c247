// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/bounds/triangle_bound.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "mesh/distance/triangle_distance.h"
#include "support/rounding_of.h"
#include "surface/remesh/bounds/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::bounds;

constexpr int cells = 4;  // of a side

/// Rank in the lattice of j cells towards the second corner and k towards the third one.
constexpr std::size_t rank_of(int j, int k) noexcept { return static_cast<std::size_t>(k * (cells + 1) - k * (k - 1) / 2 + j); }

/// The largest distance of a function from the linear interpolation of its corners. Its second derivatives along the sides of a triangle,
/// times their squared lengths, are the sum of a constant and a variable part. The constants are at most m and make 1/2 sum x_i x_j m_ij at
/// the place with weights x. The variable part is at most m, since heights of parts count a sixteenth of the height of the triangle. It makes 1/2 sum x_i x_j (1 + 2 x_k) m_ij by Taylor's
/// formula at the place for each corner.
double max_off(double m0, double m1, double m2) noexcept {
  const double largest = std::max({m0, m1, m2}), sides = (m0 + m1 + m2) / 8;
  return std::min(largest / 6, sides) + std::min(5. / 18 * largest, sides);
}

double angle_between(const Vec3& p, const Vec3& q) noexcept { return std::atan2(norm(cross(p, q)), dot(p, q)); }

}  // namespace

BoundedTriangle::BoundedTriangle(const std::array<Vec3, 3>& corners) noexcept : p(corners) {
  const Vec3 n = cross(p[1] - p[0], p[2] - p[0]);
  const double area = norm(n);
  normal = area > 0 ? Vec3(n / area) : Vec3(0, 0, 0);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 side = p[(i + 1) % 3] - p[i];
    longest = std::max(longest, norm(side));
    outward[i] = area > 0 ? Vec3(cross(side, normal) / norm(side)) : Vec3(0, 0, 0);
  }
}

const std::array<PlaceInTriangle, TriangleBound::lattice_size>& TriangleBound::lattice() noexcept {
  static const std::array<PlaceInTriangle, lattice_size> places = [] {
    std::array<PlaceInTriangle, lattice_size> made;
    for (int k = 0; k <= cells; ++k)
      for (int j = 0; j + k <= cells; ++j) made[rank_of(j, k)] = {static_cast<double>(j) / cells, static_cast<double>(k) / cells};
    return made;
  }();
  return places;
}

void TriangleBound::Bend::raise(const Bend& other) noexcept {
  height = std::max(height, other.height), whole = std::max(whole, other.whole);
  upright = std::max(upright, other.upright), leaning = std::max(leaning, other.leaning);
  for (std::size_t k = 0; k < 3; ++k) across[k] = std::max(across[k], other.across[k]);
}

TriangleBound::Bend TriangleBound::Bend::times(double factor) const noexcept {
  return {factor * height, factor * whole, factor * upright, factor * leaning, {factor * across[0], factor * across[1], factor * across[2]}};
}

TriangleBound::Bend TriangleBound::bend_of(const BoundPlace& p, const BoundPlace& middle, const BoundPlace& q) const noexcept {
  const Vec3 s = p.s - 2 * middle.s + q.s, n = p.n - 2 * middle.n + q.n;
  const double upright = dot(n, triangle_.normal);
  Bend bend{std::abs(dot(s, triangle_.normal)), norm(s), std::abs(upright), norm(n - upright * triangle_.normal), {}};
  for (std::size_t k = 0; k < 3; ++k) bend.across[k] = std::abs(dot(s, triangle_.outward[k]));
  return bend;
}

TriangleBound::TriangleBound(const BoundedTriangle& triangle, std::span<const BoundPlace, lattice_size> places)
    : triangle_(triangle) {
  for (const BoundPlace& p : places) singular_ = std::max(singular_, rounding_of::places * norm(p.n));
  std::array<Seen, lattice_size> seen;
  for (std::size_t i = 0; i < lattice_size; ++i) seen[i] = see(places[i], lattice()[i]);
  // The differences of all rows of the lattice count for each of its triangles.
  constexpr std::array<std::array<int, 2>, 3> way{{{1, 0}, {-1, 1}, {0, -1}}};
  const auto inside = [](int j, int k) { return j >= 0 && k >= 0 && j + k <= cells; };
  Bends bends;
  for (std::size_t d = 0; d < 3; ++d)
    for (int k = 0; k <= cells; ++k)
      for (int j = 0; j + k <= cells; ++j) {
        const auto [dj, dk] = way[d];
        if (inside(j - dj, k - dk) && inside(j + dj, k + dk))
          bends[d].raise(bend_of(places[rank_of(j - dj, k - dk)], places[rank_of(j, k)], places[rank_of(j + dj, k + dk)]));
      }
  const auto at = [&](int j, int k) -> const Seen& { return seen[rank_of(j, k)]; };
  cut({at(0, 0), at(2, 0), at(0, 2)}, {at(1, 0), at(1, 1), at(0, 1)}, bends, 2);
  cut({at(2, 0), at(4, 0), at(2, 2)}, {at(3, 0), at(3, 1), at(2, 1)}, bends, 2);
  cut({at(0, 2), at(2, 2), at(0, 4)}, {at(1, 2), at(1, 3), at(0, 3)}, bends, 2);
  cut({at(2, 2), at(0, 2), at(2, 0)}, {at(1, 2), at(1, 1), at(2, 1)}, bends, 2);
  want_middles();
}

TriangleBound::Seen TriangleBound::see(const BoundPlace& place, const PlaceInTriangle& at) {
  Seen seen{.place = place, .at = at};
  seen.height = dot(place.s - triangle_.p[0], triangle_.normal);
  bool beyond_mesh = false;
  for (std::size_t k = 0; k < 3; ++k) {
    seen.beyond[k] = dot(place.s - triangle_.p[k], triangle_.outward[k]);
    beyond_mesh = beyond_mesh || (triangle_.open_side[k] && seen.beyond[k] > 0);
  }
  const double distance = beyond_mesh ? distance_to_triangle(place.s, triangle_.p[0], triangle_.p[1], triangle_.p[2]) : std::abs(seen.height);
  seen_deviation_ = std::max(seen_deviation_, distance);
  seen.singular = !(norm(place.n) > singular_);
  if (!seen.singular) {
    seen.upright = dot(place.n, triangle_.normal);
    seen.angle = angle_between(place.n, triangle_.normal);
    seen_angle_ = std::max(seen_angle_, seen.angle);
  }
  return seen;
}

// Cuts the part into four; sides of each are parallel to the sides of the whole.
void TriangleBound::cut(const std::array<Seen, 3>& corner, const std::array<Seen, 3>& middle, const Bends& bends, int cuts) {
  judge({{corner[0], middle[0], middle[2]}, bends, cuts});
  judge({{middle[0], corner[1], middle[1]}, bends, cuts});
  judge({{middle[2], middle[1], corner[2]}, bends, cuts});
  judge({{middle[1], middle[2], middle[0]}, bends, cuts});
}

// Cuts the part into two, from the pole on: there are many ways to the pole, however near.
void TriangleBound::cut_at_pole(const Part& part, const std::array<Seen, 3>& middle, Bends bends) {
  const std::size_t pole = part.corner[0].singular ? 0 : part.corner[1].singular ? 1 : 2, next = (pole + 1) % 3, last = (pole + 2) % 3;
  for (const std::size_t side : {pole, last}) {  // to the pole: as long as before
    bends[side] = bends[side].times(4);
    bends[side].raise(part.bends[side].times(min_of_parent));
  }
  bends[pole].raise(bends[last]);
  bends[last] = bends[pole];
  Part first{part.corner, bends, part.cuts + 1}, second = first;
  first.corner[last] = second.corner[next] = middle[next];
  judge(std::move(first));
  judge(std::move(second));
}

void TriangleBound::judge(Part&& part) {
  const double deviation = deviation_of(part), angle = angle_of(part);
  const auto is_near = [&](double bound, double seen, double floor, double tolerance) {
    if (bound <= tolerance || (triangle_.decides && seen > tolerance)) return bound <= (1 + bound_gap) * seen + floor;
    // If the observed value is within the tolerance, the bound must decide.
    return seen > tolerance ? bound <= (1 + bound_gap_beyond) * seen + floor : bound <= (1 + bound_gap_undecided) * seen;
  };
  // Parts of a triangle do not improve a normal that is unknown.
  const bool leans = std::ranges::any_of(part.corner, [](const Seen& c) { return c.place.lean > 0; });
  const bool near = is_near(deviation, seen_deviation_, triangle_.deviation_floor, triangle_.deviation_tolerance) &&
                    (leans || is_near(angle, seen_angle_, triangle_.angle_floor, triangle_.angle_tolerance));
  const bool known = triangle_.decides && (seen_deviation_ > triangle_.deviation_tolerance || seen_angle_ > triangle_.angle_tolerance);
  const int most = known ? max_parts_beyond : max_parts;
  if (near || part.cuts >= max_cuts || parts_ >= (triangle_.roughly ? most / roughly_parts : most)) {
    deviation_ = std::max(deviation_, deviation);
    angle_ = std::max(angle_, angle);
    return;
  }
  ++parts_;
  open_.push_back(std::move(part));
}

double TriangleBound::deviation_of(const Part& part) const noexcept {
  double height = 0;
  for (const Seen& c : part.corner) height = std::max(height, std::abs(c.height));
  height += max_off(part.bends[0].height, part.bends[1].height, part.bends[2].height);
  const double beyond = overshoot_of(part);
  if (beyond == 0) return height;
  const double distance = std::hypot(height, beyond);
  // The mesh is a graph there, no steeper than the triangles around.
  return goes_on_beside(part, beyond) ? std::min(distance, height + beyond * triangle_.slope) : distance;
}

// Largest distance of the surface beyond the triangle, seen along its normal.
double TriangleBound::overshoot_of(const Part& part) const noexcept {
  const double rounding = rounding_of::heights * triangle_.longest;
  const Bends& b = part.bends;
  const double off = max_off(b[0].whole, b[1].whole, b[2].whole);
  std::array<double, 3> beyond{};
  int sides = 0;
  std::size_t one = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    for (const Seen& c : part.corner) beyond[k] = &c == &part.corner[0] ? c.beyond[k] : std::max(beyond[k], c.beyond[k]);
    beyond[k] += max_off(b[0].across[k], b[1].across[k], b[2].across[k]);
    if (beyond[k] > rounding) ++sides, one = k;
  }
  if (sides == 0) return 0;
  double most = 0;
  bool beside = sides == 1;  // the side itself is nearest
  const Vec3 along = triangle_.p[(one + 1) % 3] - triangle_.p[one];
  const double length = norm(along);
  for (const Seen& c : part.corner) {
    const Vec3 q = c.place.s - c.height * triangle_.normal;
    const double x = dot(q - triangle_.p[one], along) / length;
    beside = beside && x >= off && x <= length - off;
    if (std::ranges::any_of(c.beyond, [](double x_) { return x_ > 0; }))
      most = std::max(most, distance_to_triangle(q, triangle_.p[0], triangle_.p[1], triangle_.p[2]));
  }
  return beside ? std::min(beyond[one], most + off) : most + off;
}

// Returns whether the mesh has triangles under the places that are so far beyond.
bool TriangleBound::goes_on_beside(const Part& part, double overshoot) const noexcept {
  double away = 1;  // from corners where the mesh ends
  for (std::size_t i = 0; i < 3; ++i) {
    bool beyond = false;
    double weight = 0;
    const double off = max_off(part.bends[0].across[i], part.bends[1].across[i], part.bends[2].across[i]);
    for (const Seen& c : part.corner) {
      beyond = beyond || c.beyond[i] + off > rounding_of::heights * triangle_.longest;
      weight = std::max(weight, i == 0 ? 1 - c.at.x() - c.at.y() : i == 1 ? c.at.x() : c.at.y());
    }
    if (beyond && triangle_.open_side[i]) return false;
    if (triangle_.open_corner[i]) away = std::min(away, 1 - weight);
  }
  return overshoot <= 0.5 * away * triangle_.reach;
}

double TriangleBound::angle_of(const Part& part) const noexcept {
  constexpr double turned = std::numbers::pi, right = std::numbers::pi / 2;
  if (seen_angle_ >= right) return turned;
  double largest = 0, upright = infinity;
  int singular = 0;
  std::size_t pole = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Seen& c = part.corner[i];
    if (c.singular) {
      ++singular, pole = i;
      continue;
    }
    largest = std::max(largest, c.angle + c.place.lean), upright = std::min(upright, c.upright);
  }
  if (singular > 1) return turned;
  const auto off = [&](double Bend::*of) {
    const auto bend = [&](std::size_t side) { return part.bends[side % 3].*of; };
    // At a pole the lengths of normals, and their errors, are proportional to the distance from it.
    return singular == 0 ? max_off(bend(0), bend(1), bend(2))
                         : 2 * (9. / 16 * std::max(bend(pole), bend(pole + 2)) + 3. / 8 * bend(pole + 1));
  };
  if (largest >= right) return turned;
  // The interpolated normal is in the cone of the normals at the corners.
  const double least = upright - off(&Bend::upright);
  return least > 0 ? std::atan((std::tan(largest) * upright + off(&Bend::leaning)) / least) : turned;
}

// Parts beside each other have a middle in common: weights are sums of powers of 1/2, and equal ones are equal in all bits.
void TriangleBound::want_middles() {
  wanted_.clear(), middle_.clear();
  middle_.reserve(3 * open_.size());
  for (const Part& part : open_)
    for (std::size_t i = 0; i < 3; ++i) {
      const PlaceInTriangle middle = 0.5 * (part.corner[i].at + part.corner[(i + 1) % 3].at);
      const auto known = std::find(wanted_.rbegin(), wanted_.rend(), middle);
      middle_.push_back(known == wanted_.rend() ? wanted_.size() : static_cast<std::size_t>(wanted_.rend() - known) - 1);
      if (known == wanted_.rend()) wanted_.push_back(middle);
    }
}

void TriangleBound::take(std::span<const BoundPlace> places) {
  const std::vector<Part> parts = std::exchange(open_, {});
  std::vector<Seen> seen;
  for (std::size_t k = 0; k < places.size(); ++k) seen.push_back(see(places[k], wanted_[k]));
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const Part& part = parts[k];
    const std::array<Seen, 3> middle{seen[middle_[3 * k]], seen[middle_[3 * k + 1]], seen[middle_[3 * k + 2]]};
    Bends bends;
    for (std::size_t i = 0; i < 3; ++i) {
      bends[i] = bend_of(part.corner[i].place, middle[i].place, part.corner[(i + 1) % 3].place);
      bends[i].raise(part.bends[i].times(min_of_parent / 4));
    }
    if (part.cuts % 2 == 0 && std::ranges::count(part.corner, true, &Seen::singular) == 1)
      cut_at_pole(part, middle, bends);
    else
      cut(part.corner, middle, bends, part.cuts + 1);
  }
  want_middles();
}

}  // namespace carreau
