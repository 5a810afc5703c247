// SPDX-License-Identifier: BSD-3-Clause
// Long ranges a piece at a time.
#pragma once

#include <algorithm>
#include <cstddef>

namespace carreau {

/// Calls use(first, n) for the pieces of 0, 1, … size - 1 that hold `most` items each; the last piece holds the
/// remainder.
template <typename Use>
void for_pieces(std::size_t size, std::size_t most, const Use& use) {
  for (std::size_t first = 0; first < size; first += most) use(first, std::min(most, size - first));
}

}  // namespace carreau
