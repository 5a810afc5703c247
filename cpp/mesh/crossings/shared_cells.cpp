// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/crossings/shared_cells.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>

#include "support/box_tree.h"
#include "support/memory/unfilled.h"
#include "support/stepped_tasks.h"

namespace carreau {

namespace {

// Side of a cell in mean sizes of triangles, places of the table for each triangle, triangles that one task sees, and one of how many gives
// its size. [time only]
constexpr double cell_sides = 4, places_a_triangle = 0.5;
constexpr std::size_t seen_at_once = 16384, sampled = 61;
// Fewer triangles stay as they are. Cells that a triangle may meet. [time only]
constexpr std::size_t few_triangles = 2048;
constexpr std::uint64_t max_cells = 4096;
// Bits of the number of a cell along an axis.
constexpr int cell_bits_along = 20;
constexpr std::uint64_t cell_mask = (std::uint64_t{1} << cell_bits_along) - 1;

constexpr std::int32_t no_set = -2, many_sets = -1;

/// The sets in each cell: none, one, or many. Several cells may share a place in the table: their sets are together.
class CellsOfSets {
 public:
  CellsOfSets(std::span<const Vec3> vertices, double side, std::size_t places, int threads, Monitor& monitor)
      : sets_(std::bit_ceil(places), no_set), one_thread_(threads <= 1) {
    BoxTree::Box all;
    for (const Vec3& p : vertices)
      if (is_finite(p)) all.add(p);
    scale_ = 1 / side, low_ = all.low;
    fits_ = side > 0 && is_finite(all.high - all.low) && (all.high - all.low).maxCoeff() * scale_ < static_cast<double>(cell_mask);
    if (!fits_) return;
    cell_.resize(vertices.size());
    const std::size_t tasks = (vertices.size() + seen_at_once - 1) / seen_at_once;
    run_each(
        tasks, false, threads,
        [&](std::size_t task, Monitor&) {
          for (std::size_t v = task * seen_at_once; v < std::min((task + 1) * seen_at_once, vertices.size()); ++v)
            cell_[v] = is_finite(vertices[v]) ? cell_of(vertices[v]) : 0;
        },
        monitor);
  }
  [[nodiscard]] bool fits() const noexcept { return fits_; }

  /// False: the triangle has too many cells.
  bool add(const std::array<std::int32_t, 3>& triangle, std::int32_t set) {
    return each(triangle, [&](std::size_t place) { return mark(sets_[place], set), true; });
  }
  /// True if one of the cells has several sets.
  [[nodiscard]] bool is_shared(const std::array<std::int32_t, 3>& triangle) const {
    bool shared = false;
    each(triangle, [&](std::size_t place) { return shared = sets_[place] == many_sets, !shared; });
    return shared;
  }

 private:
  [[nodiscard]] std::uint64_t cell_of(const Vec3& p) const noexcept {
    std::uint64_t cell = 0;
    for (int k = 0; k < 3; ++k) cell = cell << cell_bits_along | static_cast<std::uint64_t>((p[k] - low_[k]) * scale_);
    return cell;
  }
  // Cells of the triangle's box. `use` returns false to end.
  template <typename Use>
  bool each(const std::array<std::int32_t, 3>& triangle, const Use& use) const {
    const std::uint64_t a = cell_[static_cast<std::size_t>(triangle[0])], b = cell_[static_cast<std::size_t>(triangle[1])],
                        c = cell_[static_cast<std::size_t>(triangle[2])];
    if (a == b && b == c) {
      use(place_of(a));
      return true;
    }
    std::array<std::uint64_t, 3> from{}, to{};
    std::uint64_t count = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto shift = static_cast<std::uint64_t>(cell_bits_along) * (2 - k);
      const std::uint64_t x = a >> shift & cell_mask, y = b >> shift & cell_mask, z = c >> shift & cell_mask;
      from[k] = std::min({x, y, z}), to[k] = std::max({x, y, z});
      count *= to[k] - from[k] + 1;
      if (count > max_cells) return false;
    }
    for (std::uint64_t x = from[0]; x <= to[0]; ++x)
      for (std::uint64_t y = from[1]; y <= to[1]; ++y)
        for (std::uint64_t z = from[2]; z <= to[2]; ++z)
          if (!use(place_of((x << cell_bits_along | y) << cell_bits_along | z))) return true;
    return true;
  }
  [[nodiscard]] std::size_t place_of(std::uint64_t cell) const noexcept {
    return (cell * 0x9E3779B97F4A7C15U >> 32) & (sets_.size() - 1);
  }
  void mark(std::int32_t& cell, std::int32_t set) const noexcept {
    if (one_thread_) {
      if (cell != set) cell = cell == no_set ? set : many_sets;
      return;
    }
    const std::atomic_ref<std::int32_t> shared(cell);
    std::int32_t now = shared.load(std::memory_order_relaxed);
    if (now == no_set && shared.compare_exchange_strong(now, set, std::memory_order_relaxed)) return;
    if (now != set && now != many_sets) shared.store(many_sets, std::memory_order_relaxed);
  }

  Vec3 low_;
  double scale_ = 0;
  UnfilledVector<std::uint64_t> cell_;  // by vertex; 0 if it is not finite
  std::vector<std::int32_t> sets_;
  bool one_thread_, fits_ = false;
};

double mean_size(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                 std::span<const std::int32_t> numbers) {
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < numbers.size(); k += sampled) {
    BoxTree::Box box;
    for (const std::int32_t v : triangles[static_cast<std::size_t>(numbers[k])]) box.add(vertices[static_cast<std::size_t>(v)]);
    sum += (box.high - box.low).maxCoeff(), ++count;
  }
  return sum / count;
}

}  // namespace

std::vector<std::int32_t> near_other_sets(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                                          std::vector<std::int32_t> numbers, std::span<const std::int32_t> set, int threads,
                                          Monitor& monitor) {
  if (numbers.size() < few_triangles) return numbers;
  CellsOfSets cells(vertices, cell_sides * mean_size(vertices, triangles, numbers),
                    static_cast<std::size_t>(places_a_triangle * static_cast<double>(numbers.size())), threads, monitor);
  if (!cells.fits()) return numbers;
  const std::size_t tasks = (numbers.size() + seen_at_once - 1) / seen_at_once;
  const auto each = [&](const auto& work) {
    run_each(
        tasks, false, threads,
        [&](std::size_t task, Monitor&) {
          work(task, std::span(numbers).subspan(task * seen_at_once, std::min(seen_at_once, numbers.size() - task * seen_at_once)));
        },
        monitor);
  };
  std::vector<char> too_large(tasks, 0);
  each([&](std::size_t task, std::span<const std::int32_t> some) {
    for (const std::int32_t t : some)
      if (const std::int32_t own = set[static_cast<std::size_t>(t)]; !cells.add(triangles[static_cast<std::size_t>(t)], own < 0 ? many_sets : own)) {
        too_large[task] = 1;
        return;
      }
  });
  if (std::find(too_large.begin(), too_large.end(), char{1}) != too_large.end()) return numbers;
  std::vector<std::size_t> kept(tasks, 0);
  each([&](std::size_t task, std::span<std::int32_t> some) {
    for (const std::int32_t t : some)
      if (cells.is_shared(triangles[static_cast<std::size_t>(t)])) some[kept[task]++] = t;
  });
  auto end = numbers.begin();
  for (std::size_t task = 0; task < tasks; ++task) {
    const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(task * seen_at_once);
    end = std::copy(begin, begin + static_cast<std::ptrdiff_t>(kept[task]), end);
  }
  numbers.erase(end, numbers.end());
  return numbers;
}

}  // namespace carreau
