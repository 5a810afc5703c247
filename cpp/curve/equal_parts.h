// SPDX-License-Identifier: BSD-3-Clause
// Cutting a table of cumulated lengths into equal parts. Private to curve/.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace carreau {

/// Abscissae of n >= 1 edges of equal length in a table of abscissae s and cumulated lengths l; `within(i, length)`
/// finds the distance from s[i] at which `length` is reached in interval i.
template <typename Within>
std::vector<double> equal_parts(std::span<const double> s, std::span<const double> l, int n, const Within& within) {
  std::vector<double> cuts(static_cast<std::size_t>(n) + 1);
  cuts.front() = s.front();
  cuts.back() = s.back();
  std::size_t i = 0;
  for (int j = 1; j < n; ++j) {
    const double target = l.back() * j / n;
    while (i + 2 < l.size() && l[i + 1] < target) ++i;
    const double cut = s[i] + within(i, target - l[i]);
    cuts[static_cast<std::size_t>(j)] = std::clamp(cut, cuts[static_cast<std::size_t>(j) - 1], s.back());
  }
  return cuts;
}

}  // namespace carreau
