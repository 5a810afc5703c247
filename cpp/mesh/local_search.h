// SPDX-License-Identifier: BSD-3-Clause
// Local searches for a better mesh: the order of the search, its edits, and its end.
//
// The caller defines "better". Nothing here depends on time, threads or addresses: equal meshes get equal edits.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "metric/metric2.h"
#include "support/monitor.h"
#include "support/vec.h"

namespace carreau {

/// The remaining budget of a search: evaluations of a surface, or edits.
class Budget {
 public:
  Budget() = default;
  explicit Budget(std::int64_t most) : left_(most) {}
  [[nodiscard]] bool is_spent() const noexcept { return left_ <= 0; }
  void spend() noexcept { --left_; }

 private:
  std::int64_t left_ = 0;
};

/// The order of rings: as found, possibly with repetitions; or ascending, each element once, if it is still bad when
/// the ring begins.
struct Rings {
  bool ascending = false;
  int most = std::numeric_limits<int>::max();
};

/// Processes `first` one after another. If `is_bad(x)` and `change(x)` are true, adds `around(x)` to the next ring,
/// which is processed after this one. Ends when a ring is empty, after the most rings, or when the budget is spent.
/// Returns all in these rings that is still bad, ascending, each once.
template <typename IsBad, typename Change, typename Around>
std::vector<std::int32_t> improve_ring_by_ring(std::vector<std::int32_t> first, Rings rings, const Budget& budget,
                                               Monitor& monitor, const IsBad& is_bad, const Change& change,
                                               const Around& around) {
  const auto sort_uniquely = [](std::vector<std::int32_t>& all) {
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
  };
  const auto is_good = [&](std::int32_t x) { return !is_bad(x); };
  std::vector<std::int32_t> met, ring = std::move(first);
  for (int k = 0; k < rings.most && !ring.empty(); ++k) {
    std::vector<std::int32_t> next;
    for (const std::int32_t x : ring) {
      monitor.checkpoint();
      if (budget.is_spent() || is_good(x) || !change(x)) continue;
      const std::vector<std::int32_t> more = around(x);
      next.insert(next.end(), more.begin(), more.end());
    }
    met.insert(met.end(), ring.begin(), ring.end());
    if (rings.ascending) sort_uniquely(next), std::erase_if(next, is_good);
    ring = std::move(next);
  }
  sort_uniquely(met);
  std::erase_if(met, is_good);
  return met;
}

/// Up to `most` times: calls `improve(x)` for each x of `list()`, in its order (worst first, if it is sorted so). Ends
/// when a pass has improved nothing. Returns true if any pass improved something.
template <typename List, typename Improve>
bool improve_in_passes(int most, Monitor& monitor, const List& list, const Improve& improve) {
  bool any = false;
  for (int pass = 0; pass < most; ++pass) {
    bool changed = false;
    for (const std::int32_t x : list()) {
      monitor.checkpoint();
      changed = improve(x) || changed;
    }
    if (!changed) break;
    any = true;
  }
  return any;
}

/// Calls `use(offset)` for the places that are tried for a vertex: six directions at these distances in the metric of
/// `circle`.
template <typename Use>
void for_placements(const UnitCircle& circle, const Use& use) {
  constexpr std::array<double, 5> distances{0.24, 0.12, 0.06, 0.03, 0.015};
  for (const double distance : distances)
    for (const Vec2& direction : six_directions) use(circle.vector(distance * direction));
}

/// Steps of one search, halved ones included. A place that is so far off is no neighbour.
inline constexpr int max_steps_of_compass = 100;

/// Returns the place of the plane with the largest `value(place, best so far)` found from the origin, whose value is
/// `start`. Searches by steps in eight directions: moves to the best, or halves the step when no direction is better,
/// down to `last`. Places that are no better than the best so far may have any value that is not larger. For functions
/// without a derivative, such as the worst of some shapes. Ends after `max_steps_of_compass`, too: a turned triangle
/// improves without end on the way to infinity.
template <typename Value>
Vec2 search_along_compass(double start, double first, double last, const Value& value) {
  static constexpr double d = 0.70710678118654752;
  static constexpr std::array<std::array<double, 2>, 8> directions{
      {{1, 0}, {d, d}, {0, 1}, {-d, d}, {-1, 0}, {-d, -d}, {0, -1}, {d, -d}}};
  Vec2 place{0, 0};
  double best = start;
  int steps = 0;
  for (double step = first; step > last && steps < max_steps_of_compass; ++steps) {
    Vec2 next = place;
    for (const auto& [x, y] : directions) {
      const Vec2 there = place + step * Vec2{x, y};
      const double found = value(there, best);
      if (found > best) best = found, next = there;
    }
    if (next == place) step /= 2;
    place = next;
  }
  return place;
}

}  // namespace carreau
