// SPDX-License-Identifier: BSD-3-Clause
// Sorting by buckets: as std::sort, whatever the buckets hold.
#include "model/bucket_sort.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>

namespace carreau {
namespace {

using Item = std::array<std::int32_t, 3>;

TEST(BucketSort, OrderMatchesASort) {
  std::mt19937 random(7);
  for (const std::int32_t count : {1, 5, 1000})
    for (const int n : {0, 1, 3000}) {
      std::vector<Item> items;
      for (int k = 0; k < n; ++k)
        items.push_back({static_cast<std::int32_t>(random()) & 0x7fffffff, static_cast<std::int32_t>(random() % 3), k});
      for (Item& item : items) item[0] %= count;
      std::vector<Item> sorted = items;
      std::ranges::sort(sorted);
      bucket_sort(items, static_cast<std::size_t>(count), [](const Item& item) { return item[0]; });
      EXPECT_EQ(items, sorted);
    }
}

}  // namespace
}  // namespace carreau
