// SPDX-License-Identifier: BSD-3-Clause
// Arrays whose values are written before they are read.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace carreau {

/// Leaves new values uninitialised: the threads that fill an array touch its pages first, not the thread that makes it.
template <typename T>
struct UnfilledAllocator : std::allocator<T> {
  static_assert(std::is_trivially_default_constructible_v<T> && std::is_trivially_destructible_v<T>);

  template <typename U>
  struct rebind {
    using other = UnfilledAllocator<U>;
  };
  template <typename U>
  void construct(U*) noexcept {}
  template <typename U, typename V, typename... More>
  void construct(U* place, V&& value, More&&... more) {
    std::construct_at(place, std::forward<V>(value), std::forward<More>(more)...);
  }
};

template <typename T>
using UnfilledVector = std::vector<T, UnfilledAllocator<T>>;

}  // namespace carreau
