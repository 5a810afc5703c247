// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/crossings/graphs.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "mesh/crossings/outline.h"
#include "predicates/predicates.h"
#include "support/stepped_tasks.h"

namespace carreau {

namespace {

// Triangles that are looked at together; smaller sets are not worth it. [time only]
constexpr std::size_t triangles_at_once = 16384, least_graph = 24;
// Share of a normal that lies along the axis of a graph: up to 60 degrees. The largest of three is .577 and more. [time
// only]
constexpr double least_along = 0.5;
// How often triangles at vertices where a set hangs together by a corner only are left out. [time only]
constexpr int most_repairs = 3;

using Triangle = std::array<std::int32_t, 3>;
constexpr std::int32_t open_edge = -1;           // half edges
constexpr std::int32_t unseen = -2, alone = -1;  // graphs

/// Which half edge lies beyond each: side k of triangle t from its corner k is 3 t + k. None where an edge has not two
/// triangles that are turned alike.
class Neighbours {
 public:
  explicit Neighbours(std::span<const Triangle> triangles)
      : triangles_(triangles),
        beyond_(3 * triangles.size(), open_edge),
        slots_(std::bit_ceil(4 * triangles.size() + 1)) {
    for (std::size_t h = 0; h < beyond_.size(); ++h) add(static_cast<std::int32_t>(h));
  }
  [[nodiscard]] std::int32_t of(std::int32_t half) const noexcept { return beyond_[static_cast<std::size_t>(half)]; }

 private:
  struct Slot {
    std::int32_t low = -1, high = -1, half = -1, count = 0;
  };

  [[nodiscard]] std::int32_t from(std::int32_t half) const noexcept {
    return triangles_[static_cast<std::size_t>(half / 3)][static_cast<std::size_t>(half % 3)];
  }
  [[nodiscard]] std::int32_t to(std::int32_t half) const noexcept {
    return triangles_[static_cast<std::size_t>(half / 3)][static_cast<std::size_t>((half + 1) % 3)];
  }

  void add(std::int32_t half) {
    const std::int32_t a = from(half), b = to(half), low = std::min(a, b), high = std::max(a, b);
    Slot& slot = slot_of(low, high);
    if (++slot.count == 1) {
      slot = {low, high, half, 1};
      return;
    }
    const auto first = static_cast<std::size_t>(slot.half);
    if (slot.count == 2 && from(slot.half) == b) {
      beyond_[first] = half, beyond_[static_cast<std::size_t>(half)] = slot.half;
      return;
    }
    if (beyond_[first] >= 0) beyond_[static_cast<std::size_t>(beyond_[first])] = open_edge, beyond_[first] = open_edge;
  }

  Slot& slot_of(std::int32_t low, std::int32_t high) noexcept {
    const std::size_t mask = slots_.size() - 1;
    std::size_t k =
        ((static_cast<std::uint64_t>(static_cast<std::uint32_t>(low)) << 32 | static_cast<std::uint32_t>(high)) *
         0x9E3779B97F4A7C15U) >>
            32 &
        mask;
    while (slots_[k].count > 0 && (slots_[k].low != low || slots_[k].high != high)) k = (k + 1) & mask;
    return slots_[k];
  }

  std::span<const Triangle> triangles_;
  std::vector<std::int32_t> beyond_;
  std::vector<Slot> slots_;
};

/// One of the six ways along an axis.
struct Side {
  int axis = 0, sign = 1;
  [[nodiscard]] int bit() const noexcept { return 1 << (2 * axis + (sign > 0 ? 0 : 1)); }
};

/// The graphs among some triangles.
class Graphs {
 public:
  Graphs(std::span<const Vec3> vertices, std::vector<Triangle> triangles)
      : vertices_(vertices), triangles_(std::move(triangles)), beyond_(triangles_), of_(triangles_.size(), unseen) {
    sides_.reserve(triangles_.size()), normal_.reserve(triangles_.size());
    for (const Triangle& t : triangles_) look_at(t);
  }

  /// By triangle; the numbers count from 0.
  const std::vector<std::int32_t>& find(Monitor& monitor) {
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      if (of_[t] != unseen) continue;
      if (sides_[t] == 0) {
        of_[t] = alone;
        continue;
      }
      monitor.checkpoint();
      grow(static_cast<std::int32_t>(t));
      if (is_graph())
        ++count_;
      else
        for (const std::int32_t u : members_) of_[static_cast<std::size_t>(u)] = alone;
    }
    return of_;
  }
  [[nodiscard]] std::int32_t count() const noexcept { return count_; }

 private:
  [[nodiscard]] const Vec3& at(std::int32_t v) const noexcept { return vertices_[static_cast<std::size_t>(v)]; }

  // From which sides it is well seen, by doubles.
  void look_at(const Triangle& t) {
    const Vec3 n = cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]));
    const double least = least_along * norm(n);
    int sides = 0, best = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(n[axis]) > std::abs(n[best])) best = axis;
      if (std::abs(n[axis]) > least) sides |= Side{axis, n[axis] > 0 ? 1 : -1}.bit();
    }
    sides_.push_back(static_cast<std::uint8_t>(sides));
    normal_.push_back({best, n[best] > 0 ? 1 : -1});
  }

  [[nodiscard]] bool is_turned(const Triangle& t) const noexcept {
    return orientation(along(side_.axis, at(t[0])), along(side_.axis, at(t[1])), along(side_.axis, at(t[2]))) ==
           side_.sign;
  }

  // All that hang together by edges and are seen from the side from which this one is seen best.
  void grow(std::int32_t seed) {
    side_ = normal_[static_cast<std::size_t>(seed)];
    members_.assign(1, seed);
    of_[static_cast<std::size_t>(seed)] = count_;
    for (std::size_t k = 0; k < members_.size(); ++k)
      for (std::int32_t h = 3 * members_[k]; h < 3 * members_[k] + 3; ++h) {
        const std::int32_t beyond = beyond_.of(h);
        if (beyond < 0) continue;
        const auto u = static_cast<std::size_t>(beyond / 3);
        if (of_[u] != unseen || (sides_[u] & side_.bit()) == 0) continue;
        of_[u] = count_;
        members_.push_back(beyond / 3);
      }
  }

  bool is_graph() {
    for (int repair = 0;; ++repair) {
      if (members_.size() < least_graph) return false;
      set_outline();
      const std::vector<std::int32_t> pinched = pinched_vertices(outline_);
      if (pinched.empty()) break;
      if (repair == most_repairs) return false;
      leave_out(pinched);
    }
    return std::all_of(members_.begin(), members_.end(),
                       [this](std::int32_t t) { return is_turned(triangles_[static_cast<std::size_t>(t)]); }) &&
           goes_round_once(outline_);
  }

  void set_outline() {
    outline_.clear();
    for (const std::int32_t t : members_)
      for (std::int32_t k = 0; k < 3; ++k) {
        const std::int32_t beyond = beyond_.of(3 * t + k);
        if (beyond >= 0 && of_[static_cast<std::size_t>(beyond / 3)] == count_) continue;
        const Triangle& corners = triangles_[static_cast<std::size_t>(t)];
        std::int32_t a = corners[static_cast<std::size_t>(k)], b = corners[static_cast<std::size_t>((k + 1) % 3)];
        if (side_.sign < 0) std::swap(a, b);
        outline_.push_back({a, b, along(side_.axis, at(a)), along(side_.axis, at(b))});
      }
  }

  void leave_out(const std::vector<std::int32_t>& pinched) {
    std::erase_if(members_, [&](std::int32_t t) {
      const Triangle& corners = triangles_[static_cast<std::size_t>(t)];
      const bool out = std::any_of(corners.begin(), corners.end(), [&](std::int32_t v) {
        return std::binary_search(pinched.begin(), pinched.end(), v);
      });
      if (out) of_[static_cast<std::size_t>(t)] = alone;
      return out;
    });
  }

  std::span<const Vec3> vertices_;
  std::vector<Triangle> triangles_;
  Neighbours beyond_;
  std::vector<std::int32_t> of_;
  std::vector<std::uint8_t> sides_;  // by triangle: those from which it is well seen
  std::vector<Side> normal_;         // by triangle: from which it is seen best
  std::int32_t count_ = 0;
  // Of the graph at hand:
  Side side_;
  std::vector<std::int32_t> members_;
  std::vector<OutlineEdge> outline_;
};

}  // namespace

std::vector<std::int32_t> find_graphs(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                                      std::span<std::int32_t> order, int threads, Monitor& monitor) {
  std::vector<std::int32_t> graph(triangles.size(), alone);
  const std::size_t parts = (order.size() + triangles_at_once - 1) / triangles_at_once;
  std::vector<std::int32_t> count(parts, 0);
  run_each(
      parts, false, threads,
      [&](std::size_t part, Monitor& own) {
        const auto some = order.subspan(part * triangles_at_once, std::min(triangles_at_once, order.size() - part * triangles_at_once));
        std::vector<Triangle> corners;
        corners.reserve(some.size());
        for (const std::int32_t t : some) corners.push_back(triangles[static_cast<std::size_t>(t)]);
        Graphs graphs(vertices, std::move(corners));
        const std::vector<std::int32_t>& found = graphs.find(own);
        for (std::size_t k = 0; k < some.size(); ++k) graph[static_cast<std::size_t>(some[k])] = found[k];
        count[part] = graphs.count();
        std::stable_sort(some.begin(), some.end(), [&](std::int32_t a, std::int32_t b) {
          return graph[static_cast<std::size_t>(a)] < graph[static_cast<std::size_t>(b)];
        });
      },
      monitor);
  std::int32_t before = 0;
  for (std::size_t part = 0; part < parts; ++part) {
    for (std::size_t k = part * triangles_at_once; k < std::min((part + 1) * triangles_at_once, order.size()); ++k)
      if (std::int32_t& g = graph[static_cast<std::size_t>(order[k])]; g >= 0) g += before;
    before += count[part];
  }
  return graph;
}

}  // namespace carreau
