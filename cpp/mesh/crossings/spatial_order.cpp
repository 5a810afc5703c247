// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/crossings/spatial_order.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "support/box_tree.h"
#include "support/memory/unfilled.h"
#include "support/stepped_tasks.h"

namespace carreau {

namespace {

using Box = BoxTree::Box;

// Triangles that one thread sorts at once, and triangles of a task that distributes them to cells. [time only]
constexpr std::size_t max_sorted = 1 << 16, max_dealt = 1 << 17;
// Neighbouring cells with fewer triangles are sorted together. [time only]
constexpr std::size_t min_sorted = 1 << 12;
// Triangles with one code that stay unsorted, and triangles that are sorted without digits. [time only]
constexpr std::size_t crowd = 16, few = 128;
// Bits of each coordinate of the cells that triangles are distributed to.
constexpr int cell_bits = 4;
constexpr std::size_t cells = std::size_t{1} << (3 * cell_bits);
// Bits of each coordinate of the codes that triangles are sorted by, and of each of the three digits of a code. Cells
// of the finest grid are smaller than the triangles of a surface meshed with one size. [time only]
constexpr int code_bits = 8, code_bits_of_many = 10;
constexpr std::size_t many = 1 << 14;

/// Some of the list.
struct Range {
  std::size_t begin = 0, end = 0;
  [[nodiscard]] std::size_t size() const noexcept { return end - begin; }
};

// The lowest 10 bits, each followed by two zeros.
std::uint32_t spread_out(std::uint32_t bits) noexcept {
  bits = (bits | bits << 16) & 0x030000ff;
  bits = (bits | bits << 8) & 0x0300f00f;
  bits = (bits | bits << 4) & 0x030c30c3;
  return (bits | bits << 2) & 0x09249249;
}

/// Codes of places in a box, by a grid of cubes.
class Grid {
 public:
  Grid(const Box& box, int bits) : low_(box.low), last_(static_cast<double>((1 << bits) - 1)) {
    const double longest = (box.high - box.low).maxCoeff();
    scale_ = longest > 0 ? (last_ + 1) / longest : 0;
  }
  [[nodiscard]] bool is_a_point() const noexcept { return !(scale_ > 0); }
  [[nodiscard]] std::uint32_t code(const Vec3& p) const noexcept {
    return spread_out(step(p, 0)) << 2 | spread_out(step(p, 1)) << 1 | spread_out(step(p, 2));
  }

 private:
  // Any value at all, if numbers are too large to be subtracted.
  [[nodiscard]] std::uint32_t step(const Vec3& p, int axis) const noexcept {
    const double x = (p[axis] - low_[axis]) * scale_;
    return x > 0 ? static_cast<std::uint32_t>(std::min(x, last_)) : 0;
  }

  Vec3 low_;
  double last_, scale_ = 0;
};

class SpatialSort {
 public:
  SpatialSort(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
              std::vector<std::int32_t> numbers, Monitor& monitor, int threads)
      : vertices_(vertices), triangles_(triangles), list_(std::move(numbers)), monitor_(monitor), threads_(threads) {}

  std::vector<std::int32_t> run() {
    std::vector<Range> large{{0, list_.size()}};
    while (!large.empty()) {
      const Range range = large.back();
      large.pop_back();
      if (range.size() <= max_sorted)
        add_small(range);
      else
        deal_out(range, large);
    }
    buffer_ = {};
    run_each(
        small_.size(), false, threads_, [this](std::size_t r, Monitor&) { sort(small_[r]); }, monitor_);
    return std::move(list_);
  }

 private:
  // Three times the centre.
  [[nodiscard]] Vec3 centre(std::int32_t number) const noexcept {
    const auto& t = triangles_[static_cast<std::size_t>(number)];
    const auto corner = [&](std::size_t i) -> const Vec3& { return vertices_[static_cast<std::size_t>(t[i])]; };
    return corner(0) + corner(1) + corner(2);
  }
  [[nodiscard]] Box box_of(const Range& range) const noexcept {
    Box box;
    for (std::size_t k = range.begin; k < range.end; ++k) box.add(centre(list_[k]));
    return box;
  }
  void add_small(const Range& range) {
    const bool joins =
        !small_.empty() && small_.back().end == range.begin && range.end - small_.back().begin <= min_sorted;
    if (joins)
      small_.back().end = range.end;
    else if (range.size() > 0)
      small_.push_back(range);
  }

  /// Sorts by cells of the range's box: cells with few triangles are small, cells with many large.
  void deal_out(const Range& range, std::vector<Range>& large) {
    const std::size_t tasks = (range.size() + max_dealt - 1) / max_dealt;
    const auto each = [&](const auto& work) {
      const auto of_task = [&](std::size_t task, Monitor&) {
        work(task, Range{range.begin + task * max_dealt, std::min(range.begin + (task + 1) * max_dealt, range.end)});
      };
      run_each(tasks, false, threads_, of_task, monitor_);
    };
    std::vector<Box> boxes(tasks);
    each([&](std::size_t task, const Range& some) { boxes[task] = box_of(some); });
    Box box;
    for (const Box& of_task : boxes) box.add(of_task);
    const Grid grid(box, cell_bits);
    std::vector<std::array<std::size_t, cells>> next(tasks);  // numbers, then places in the list
    UnfilledVector<std::uint16_t> code(range.size());
    each([&](std::size_t task, const Range& some) {
      for (std::size_t k = some.begin; k < some.end; ++k) {
        code[k - range.begin] = static_cast<std::uint16_t>(grid.code(centre(list_[k])));
        ++next[task][code[k - range.begin]];
      }
    });
    std::vector<Range> found;
    std::size_t place = range.begin;
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const std::size_t begin = place;
      for (auto& of_task : next) place += std::exchange(of_task[cell], place);
      if (place > begin) found.push_back({begin, place});
    }
    if (found.size() == 1) return;  // one place, or too large for a grid
    buffer_.resize(list_.size());
    each([&](std::size_t task, const Range& some) {
      for (std::size_t k = some.begin; k < some.end; ++k) buffer_[next[task][code[k - range.begin]]++] = list_[k];
    });
    each([&](std::size_t, const Range& some) {
      std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(some.begin),
                buffer_.begin() + static_cast<std::ptrdiff_t>(some.end),
                list_.begin() + static_cast<std::ptrdiff_t>(some.begin));
    });
    large.insert(large.end(), found.rbegin(), found.rend());  // the first one next
  }

  struct Key {
    std::uint32_t code;
    std::int32_t number;
  };
  using Keys = UnfilledVector<Key>;

  void sort(const Range& range) {
    const int bits = range.size() < many ? code_bits : code_bits_of_many;
    UnfilledVector<std::array<double, 3>> at(range.size());
    Box box;
    for (std::size_t k = 0; k < at.size(); ++k) {
      const Vec3 p = centre(list_[range.begin + k]);
      box.add(p);
      at[k] = {p.x(), p.y(), p.z()};
    }
    const Grid grid(box, bits);
    if (grid.is_a_point()) return;
    Keys keys(range.size());
    for (std::size_t k = 0; k < keys.size(); ++k)
      keys[k] = {grid.code({at[k][0], at[k][1], at[k][2]}), list_[range.begin + k]};
    if (keys.size() < few)
      std::stable_sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) { return a.code < b.code; });
    else
      sort_by_digits(keys, bits);
    for (std::size_t k = 0; k < keys.size(); ++k) list_[range.begin + k] = keys[k].number;
    for (std::size_t k = 0; k < keys.size();) {
      const std::size_t first = k;
      while (k < keys.size() && keys[k].code == keys[first].code) ++k;
      if (k - first > crowd && k - first < keys.size()) sort({range.begin + first, range.begin + k});
    }
  }

  // Sorts by the lowest digit first; equal keys keep their order.
  static void sort_by_digits(Keys& keys, int bits) {
    constexpr std::size_t digits = 3;
    const std::uint32_t last = (1U << bits) - 1;
    std::array<std::array<std::uint32_t, std::size_t{1} << code_bits_of_many>, digits> next{};
    for (const Key& key : keys)
      for (std::size_t d = 0; d < digits; ++d) ++next[d][key.code >> (d * static_cast<std::size_t>(bits)) & last];
    Keys sorted(keys.size());
    for (std::size_t d = 0; d < digits; ++d) {
      std::uint32_t place = 0;
      for (std::uint32_t digit = 0; digit <= last; ++digit) place += std::exchange(next[d][digit], place);
      for (const Key& key : keys) sorted[next[d][key.code >> (d * static_cast<std::size_t>(bits)) & last]++] = key;
      keys.swap(sorted);
    }
  }

  std::span<const Vec3> vertices_;
  std::span<const std::array<std::int32_t, 3>> triangles_;
  std::vector<std::int32_t> list_, buffer_;
  std::vector<Range> small_;
  Monitor& monitor_;
  int threads_;
};

}  // namespace

std::vector<std::int32_t> spatial_order(std::span<const Vec3> vertices,
                                        std::span<const std::array<std::int32_t, 3>> triangles,
                                        std::vector<std::int32_t> numbers, Monitor& monitor, int threads) {
  return SpatialSort(vertices, triangles, std::move(numbers), monitor, threads).run();
}

}  // namespace carreau
