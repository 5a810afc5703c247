// SPDX-License-Identifier: BSD-3-Clause
// Finds which of many small sets hold a thing.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace carreau {

/// For each of `count` things, the indices of the sets that hold it, among sets of N; ascending, and twice if a set
/// holds it twice.
class Incidence {
 public:
  template <std::size_t N>
  Incidence(std::size_t count, const std::vector<std::array<std::int32_t, N>>& sets) : start_(count + 1, 0) {
    for (const auto& set : sets)
      for (const std::int32_t x : set) ++start_[x + 1];
    for (std::size_t x = 0; x < count; ++x) start_[x + 1] += start_[x];
    of_.resize(N * sets.size());
    std::vector<std::int32_t> fill(start_.begin(), start_.end() - 1);
    for (std::size_t k = 0; k < sets.size(); ++k)
      for (const std::int32_t x : sets[k]) of_[fill[x]++] = static_cast<std::int32_t>(k);
  }
  [[nodiscard]] std::span<const std::int32_t> of(std::int32_t thing) const noexcept {
    return std::span(of_).subspan(static_cast<std::size_t>(start_[thing]),
                                  static_cast<std::size_t>(start_[thing + 1] - start_[thing]));
  }

 private:
  std::vector<std::int32_t> start_, of_;
};

}  // namespace carreau
