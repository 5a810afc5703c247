// SPDX-License-Identifier: BSD-3-Clause
// Sorting of many small things by an index of few values that is their leading key.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace carreau {

/// Sorts like std::sort. `index` of an item is its leading key, from 0 to `count` - 1. Sorts into buckets first, which is
/// faster for small buckets, for example edges at vertices.
template <typename T, typename Index>
void bucket_sort(std::vector<T>& items, std::size_t count, const Index& index) {
  std::vector<std::size_t> start(count + 1, 0);
  for (const T& item : items) ++start[static_cast<std::size_t>(index(item)) + 1];
  for (std::size_t k = 0; k < count; ++k) start[k + 1] += start[k];
  std::vector<T> sorted(items.size());
  for (const T& item : items) sorted[start[static_cast<std::size_t>(index(item))]++] = item;
  for (std::size_t k = 0, from = 0; k < count; from = start[k++])
    std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(from), sorted.begin() + static_cast<std::ptrdiff_t>(start[k]));
  items = std::move(sorted);
}

}  // namespace carreau
