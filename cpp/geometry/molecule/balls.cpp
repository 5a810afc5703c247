// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/molecule/balls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <tuple>

#include "support/error.h"
#include "support/format.h"

namespace carreau::molecule {

namespace {

constexpr double equal_distances = 1e-12;  // of the radii; sums of three numbers are good to some 1e-15

bool holds(const Ball& p, const Ball& q, double distance) {
  return distance <= p.radius - q.radius + equal_distances * p.radius;
}

/// Cells of a grid, coded so that one sort groups the balls of a cell.
class Cells {
 public:
  Cells(std::span<const Ball> balls, std::span<const int> members) {
    for (const int i : members) width_ = std::max(width_, 2 * balls[i].radius);
    if (!members.empty()) low_ = high_ = balls[members[0]].centre;
    for (const int i : members) low_ = low_.cwiseMin(balls[i].centre), high_ = high_.cwiseMax(balls[i].centre);
    const Vec3 size = high_ - low_;
    constexpr double most = 1 << 20;  // cells along an axis: three numbers fit a code
    width_ = std::max({width_, size.x() / most, size.y() / most, size.z() / most});
    for (const int i : members) order_.push_back({code(place(balls[i].centre)), i});
    std::sort(order_.begin(), order_.end());
  }

  /// Calls use(j) for all balls of the 27 cells about a point.
  template <typename Use>
  void around(const Vec3& p, const Use& use) const {
    const std::array<std::int64_t, 3> at = place(p);
    for (std::int64_t x = at[0] - 1; x <= at[0] + 1; ++x)
      for (std::int64_t y = at[1] - 1; y <= at[1] + 1; ++y) {
        const std::uint64_t first = code({x, y, at[2] - 1}), last = code({x, y, at[2] + 1});
        for (auto cell = std::lower_bound(order_.begin(), order_.end(), std::pair{first, -1});
             cell != order_.end() && cell->first <= last; ++cell)
          use(cell->second);
      }
  }

 private:
  [[nodiscard]] std::array<std::int64_t, 3> place(const Vec3& p) const {
    const Vec3 q = (p - low_) / width_;
    return {static_cast<std::int64_t>(q.x()) + 1, static_cast<std::int64_t>(q.y()) + 1,
            static_cast<std::int64_t>(q.z()) + 1};
  }
  static std::uint64_t code(const std::array<std::int64_t, 3>& at) {
    constexpr int bits = 21;
    return (static_cast<std::uint64_t>(at[0]) << 2 * bits) | (static_cast<std::uint64_t>(at[1]) << bits) |
           static_cast<std::uint64_t>(at[2]);
  }

  double width_ = 0;
  Vec3 low_, high_;
  std::vector<std::pair<std::uint64_t, int>> order_;
};

/// Keeps the largest of balls with one centre, the first of equal ones; `held_by` receives it for the others.
std::vector<int> without_concentric(std::span<const Ball> balls, std::vector<int>& held_by) {
  std::vector<int> order(balls.size()), kept;
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int i) {
    const Ball& b = balls[i];
    return std::tuple{b.centre.x(), b.centre.y(), b.centre.z(), -b.radius, i};
  };
  std::sort(order.begin(), order.end(), [&](int i, int j) { return key(i) < key(j); });
  for (const int i : order) {
    if (!kept.empty() && balls[kept.back()].centre == balls[i].centre)
      held_by[i] = kept.back();
    else
      kept.push_back(i);
  }
  return kept;
}

}  // namespace

Vec3 across(const Vec3& n) {
  const Vec3 axis = std::abs(n.x()) <= std::abs(n.y()) && std::abs(n.x()) <= std::abs(n.z()) ? Vec3{1, 0, 0}
                    : std::abs(n.y()) <= std::abs(n.z())                                     ? Vec3{0, 1, 0}
                                                                                             : Vec3{0, 0, 1};
  const Vec3 e = cross(n, axis);
  return e / norm(e);
}

void check_balls(std::span<const Ball> balls) {
  if (balls.empty()) throw InvalidArgument("there is no atom");
  double largest = 0;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const auto [centre, radius] = balls[i];
    const std::string atom = "atom " + std::to_string(i + 1);
    if (!is_finite(centre)) throw InvalidArgument(atom + ": the centre is not finite");
    if (!std::isfinite(radius) || radius <= 0)
      throw InvalidArgument(atom + ": the radius is " + format_number(radius) + "; it must be positive and finite");
    largest = std::max(largest, radius);
  }
  constexpr double least = 1e-9;
  for (std::size_t i = 0; i < balls.size(); ++i)
    if (balls[i].radius < least * largest)
      throw InvalidArgument("atom " + std::to_string(i + 1) + ": the radius " + format_number(balls[i].radius) +
                            " is less than a thousand-millionth of the largest one, " + format_number(largest));
}

bool spheres_meet(const Ball& p, const Ball& q) {
  const double distance = norm(p.centre - q.centre), sum = p.radius + q.radius;
  return distance < sum - equal_distances * sum && !holds(p, q, distance) && !holds(q, p, distance);
}

Neighbours::Neighbours(std::span<const Ball> balls) : start_(balls.size() + 1, 0), held_by_(balls.size(), -1) {
  std::vector<int> members = without_concentric(balls, held_by_);
  {
    const Cells cells(balls, members);
    for (const int i : members)
      cells.around(balls[i].centre, [&](int j) {
        const Ball &p = balls[j], &q = balls[i];
        if (held_by_[i] >= 0 || p.radius < q.radius || (p.radius == q.radius && j >= i)) return;
        if (holds(p, q, norm(p.centre - q.centre))) held_by_[i] = j;
      });
  }
  std::erase_if(members, [&](int i) { return held_by_[i] >= 0; });
  std::sort(members.begin(), members.end());
  const Cells cells(balls, members);
  int next = 0;
  for (const int i : members) {
    for (; next <= i; ++next) start_[next] = static_cast<std::ptrdiff_t>(list_.size());
    cells.around(balls[i].centre, [&](int j) {
      if (j != i && spheres_meet(balls[i], balls[j])) list_.push_back(j);
    });
    std::sort(list_.begin() + start_[i], list_.end());
  }
  for (; next <= static_cast<int>(balls.size()); ++next) start_[next] = static_cast<std::ptrdiff_t>(list_.size());
}

}  // namespace carreau::molecule
