// SPDX-License-Identifier: BSD-3-Clause
// Sets of numbers that grow by merging.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace carreau {

/// The numbers 0 .. n - 1, each at first in a separate set. A set is known by its smallest number.
class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void merge(std::size_t i, std::size_t j) {
    i = find(i), j = find(j);
    parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace carreau
