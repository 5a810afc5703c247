// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/crossings/graphs.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>

#include "mesh/crossings/outline.h"
#include "support/stepped_tasks.h"

namespace carreau {

namespace {

// Triangles that are searched together; smaller sets are not searched. [time only]
constexpr std::size_t triangles_at_once = 32768, min_graph = 24;
// Most removals of triangles at vertices that alone connect parts of a set. [time only]
constexpr int max_repairs = 3;

using Triangle = std::array<std::int32_t, 3>;
constexpr std::int32_t open_edge = -1, no_pair = -2;  // half edges
constexpr std::int32_t unseen = -2, alone = -1;       // graphs

/// Sides of some triangles: side k of triangle t from its corner k is 4 t + k, which is never divided.
class HalfEdges {
 public:
  void set(std::span<const Triangle> triangles, std::span<const std::int32_t> some) {
    corners_.resize(4 * some.size());
    beyond_.assign(4 * some.size(), open_edge);
    slots_.assign(std::bit_ceil(3 * some.size() + 1), open_edge);
    for (std::size_t k = 0; k < some.size(); ++k) {
      const Triangle& t = triangles[static_cast<std::size_t>(some[k])];
      std::int32_t* corners = corners_.data() + 4 * k;
      corners[0] = t[0], corners[1] = t[1], corners[2] = t[2], corners[3] = t[0];
    }
    for (std::int32_t half = 0; half < static_cast<std::int32_t>(4 * some.size()); half += 4)
      for (std::int32_t side = 0; side < 3; ++side) add(half + side);
  }
  [[nodiscard]] std::int32_t from(std::int32_t half) const noexcept { return corners_[static_cast<std::size_t>(half)]; }
  [[nodiscard]] std::int32_t to(std::int32_t half) const noexcept {
    return corners_[static_cast<std::size_t>(half) + 1];
  }
  /// The half edge beyond; negative if the edge does not have two triangles of equal orientation.
  [[nodiscard]] std::int32_t beyond(std::int32_t half) const noexcept {
    return beyond_[static_cast<std::size_t>(half)];
  }

 private:
  void add(std::int32_t half) {
    const std::int32_t a = from(half), b = to(half);
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t k = place_of(a, b) & mask;; k = (k + 1) & mask) {
      const std::int32_t first = slots_[k];
      if (first < 0) {
        slots_[k] = half;
        return;
      }
      if (from(first) == b && to(first) == a) return join(first, half);
      if (from(first) == a && to(first) == b) return part(first);
    }
  }
  void join(std::int32_t first, std::int32_t half) {
    std::int32_t& other = beyond_[static_cast<std::size_t>(first)];
    if (other != open_edge) return part(first);
    other = half;
    beyond_[static_cast<std::size_t>(half)] = first;
  }
  void part(std::int32_t first) {
    std::int32_t& other = beyond_[static_cast<std::size_t>(first)];
    if (other >= 0) beyond_[static_cast<std::size_t>(other)] = open_edge;
    other = no_pair;
  }
  // The slot is equal for both directions.
  static std::size_t place_of(std::int32_t a, std::int32_t b) noexcept {
    const auto low = static_cast<std::uint32_t>(std::min(a, b)), high = static_cast<std::uint32_t>(std::max(a, b));
    return ((std::uint64_t{low} << 32 | high) * 0x9E3779B97F4A7C15U) >> 32;
  }

  std::vector<std::int32_t> corners_, beyond_;  // by half edge
  std::vector<std::int32_t> slots_;             // first half edges by their ends
};

/// The graphs among some triangles at a time.
class Graphs {
 public:
  Graphs(std::span<const Vec3> vertices, std::span<const Triangle> triangles, std::span<const TriangleView> views)
      : vertices_(vertices), triangles_(triangles), views_(views) {}

  /// Puts them graph by graph. `graph`: by triangle of the mesh; the numbers count from 0. Returns their number.
  std::int32_t find(std::span<std::int32_t> some, std::span<std::int32_t> graph, Monitor& monitor) {
    halves_.set(triangles_, some);
    some_ = some;
    of_.assign(some.size(), unseen);
    count_ = 0;
    for (std::size_t t = 0; t < some.size(); ++t) {
      if (of_[t] != unseen) continue;
      if (view(t).good == 0) {
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
    for (std::size_t k = 0; k < some.size(); ++k) graph[static_cast<std::size_t>(some[k])] = of_[k];
    put_graph_by_graph(some);
    return count_;
  }

 private:
  [[nodiscard]] const Vec3& at(std::int32_t v) const noexcept { return vertices_[static_cast<std::size_t>(v)]; }
  [[nodiscard]] const TriangleView& view(std::size_t t) const noexcept {
    return views_[static_cast<std::size_t>(some_[t])];
  }

  [[nodiscard]] bool is_turned(std::int32_t t) const noexcept {
    if (view(static_cast<std::size_t>(t)).side == side_) return true;
    return turn(side_ >> 1, at(halves_.from(4 * t)), at(halves_.from(4 * t + 1)), at(halves_.from(4 * t + 2))) ==
           1 - 2 * (side_ & 1);
  }

  // Collects all triangles that are connected by edges and visible from the best side of this one, and the lines round
  // them.
  void grow(std::int32_t seed) {
    side_ = view(static_cast<std::size_t>(seed)).side;
    members_.assign(1, seed);
    outline_.clear();
    of_[static_cast<std::size_t>(seed)] = count_;
    for (std::size_t k = 0; k < members_.size(); ++k)
      for (std::int32_t h = 4 * members_[k]; h < 4 * members_[k] + 3; ++h) {
        const std::int32_t beyond = halves_.beyond(h);
        const auto u = static_cast<std::size_t>(beyond) >> 2;
        if (beyond >= 0 && of_[u] == count_) continue;
        if (beyond < 0 || of_[u] != unseen || !view(u).is_good(side_)) {
          add_to_outline(h);
          continue;
        }
        of_[u] = count_;
        members_.push_back(beyond >> 2);
      }
  }

  bool is_graph() {
    for (int repair = 0;; ++repair) {
      if (members_.size() < min_graph) return false;
      const std::vector<std::int32_t> pinched = pinched_vertices(outline_);
      if (pinched.empty()) break;
      if (repair == max_repairs) return false;
      leave_out(pinched);
      set_outline();
    }
    return std::all_of(members_.begin(), members_.end(), [this](std::int32_t t) { return is_turned(t); }) &&
           goes_round_once(outline_);
  }

  void set_outline() {
    outline_.clear();
    for (const std::int32_t t : members_)
      for (std::int32_t h = 4 * t; h < 4 * t + 3; ++h)
        if (const std::int32_t beyond = halves_.beyond(h);
            beyond < 0 || of_[static_cast<std::size_t>(beyond) >> 2] != count_)
          add_to_outline(h);
  }
  void add_to_outline(std::int32_t half) {
    std::int32_t a = halves_.from(half), b = halves_.to(half);
    if ((side_ & 1) != 0) std::swap(a, b);
    outline_.push_back({a, b, along(side_ >> 1, at(a)), along(side_ >> 1, at(b))});
  }

  void leave_out(const std::vector<std::int32_t>& pinched) {
    std::erase_if(members_, [&](std::int32_t t) {
      bool out = false;
      for (std::int32_t h = 4 * t; h < 4 * t + 3; ++h)
        out = out || std::binary_search(pinched.begin(), pinched.end(), halves_.from(h));
      if (out) of_[static_cast<std::size_t>(t)] = alone;
      return out;
    });
  }

  // Triangles without a graph come first, the others in their order.
  void put_graph_by_graph(std::span<std::int32_t> some) {
    std::vector<std::size_t> next(static_cast<std::size_t>(count_) + 2, 0);
    for (const std::int32_t g : of_) ++next[static_cast<std::size_t>(g + 2)];
    for (std::size_t g = 1; g < next.size(); ++g) next[g] += next[g - 1];
    members_.resize(some.size());
    for (std::size_t k = 0; k < some.size(); ++k) members_[next[static_cast<std::size_t>(of_[k] + 1)]++] = some[k];
    std::copy(members_.begin(), members_.end(), some.begin());
  }

  std::span<const Vec3> vertices_;
  std::span<const Triangle> triangles_;
  std::span<const TriangleView> views_;
  // State of the current triangles:
  std::span<const std::int32_t> some_;
  HalfEdges halves_;
  std::vector<std::int32_t> of_;
  std::int32_t count_ = 0;
  // State of the current graph:
  std::int8_t side_ = 0;
  std::vector<std::int32_t> members_;
  std::vector<OutlineEdge> outline_;
};

/// Working memory that tasks use one after the other, whatever their threads.
class GraphsAtHand {
 public:
  template <typename Make>
  std::unique_ptr<Graphs> take(const Make& make) {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return make();
    std::unique_ptr<Graphs> one = std::move(free_.back());
    free_.pop_back();
    return one;
  }
  void give_back(std::unique_ptr<Graphs> one) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(one));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Graphs>> free_;
};

}  // namespace

std::vector<std::int32_t> find_graphs(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                                      std::span<const TriangleView> views, std::span<std::int32_t> order, int threads,
                                      Monitor& monitor) {
  std::vector<std::int32_t> graph(triangles.size(), alone);
  find_graphs_of(vertices, triangles, views, order, 0, graph, threads, monitor);
  return graph;
}

void find_graphs_of(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                    std::span<const TriangleView> views, std::span<std::int32_t> order, std::int32_t first,
                    std::span<std::int32_t> graph, int threads, Monitor& monitor) {
  const std::size_t parts = (order.size() + triangles_at_once - 1) / triangles_at_once;
  std::vector<std::int32_t> count(parts, 0);
  GraphsAtHand at_hand;
  run_each(
      parts, false, threads,
      [&](std::size_t part, Monitor& own) {
        const auto some = order.subspan(part * triangles_at_once,
                                        std::min(triangles_at_once, order.size() - part * triangles_at_once));
        std::unique_ptr<Graphs> graphs =
            at_hand.take([&] { return std::make_unique<Graphs>(vertices, triangles, views); });
        count[part] = graphs->find(some, graph, own);
        at_hand.give_back(std::move(graphs));
      },
      monitor);
  std::vector<std::int32_t> before(parts, first);
  for (std::size_t part = 1; part < parts; ++part) before[part] = before[part - 1] + count[part - 1];
  run_each(
      parts, false, threads,
      [&](std::size_t part, Monitor&) {
        for (std::size_t k = part * triangles_at_once; k < std::min((part + 1) * triangles_at_once, order.size()); ++k)
          if (std::int32_t& g = graph[static_cast<std::size_t>(order[k])]; g >= 0) g += before[part];
      },
      monitor);
}

}  // namespace carreau
