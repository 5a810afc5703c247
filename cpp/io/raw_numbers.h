// SPDX-License-Identifier: BSD-3-Clause
// Numbers as they lie in a binary file.
#pragma once

#include <cstddef>
#include <cstring>
#include <utility>

namespace carreau {

/// The number whose bytes start at `bytes`; swapped: in the byte order that is not the machine's.
template <typename T>
T raw_number(const char* bytes, bool swapped) noexcept {
  char copy[sizeof(T)];
  std::memcpy(copy, bytes, sizeof(T));
  if (swapped)
    for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(copy[i], copy[sizeof(T) - 1 - i]);
  T value;
  std::memcpy(&value, copy, sizeof(T));
  return value;
}

}  // namespace carreau
