// SPDX-License-Identifier: BSD-3-Clause
// Checks of arguments, and structs that grow.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>

#include "support/error.h"

namespace carreau::abi {

template <typename T>
T* required(T* pointer, const char* name) {
  if (pointer == nullptr) throw InvalidArgument(std::string("the argument ") + name + " is NULL");
  return pointer;
}

/// A count of the caller as a size; `name` is the member that holds it, such as "domain->point_count".
inline std::size_t count_of(std::int64_t n, const std::string& name) {
  constexpr std::int64_t largest = std::numeric_limits<std::int32_t>::max();
  if (n >= 0 && n <= largest) return static_cast<std::size_t>(n);
  throw InvalidArgument(name + " is " + std::to_string(n) + "; it must lie between 0 and " + std::to_string(largest));
}

inline void check_capacity(std::int64_t capacity, std::size_t rows, const char* what) {
  if (capacity >= 0 && std::uint64_t(capacity) >= rows) return;
  throw InvalidArgument("the array has room for " + std::to_string(capacity) + " rows, there are " +
                        std::to_string(rows) + " " + what);
}

/// The caller's struct as this library knows it: members it does not have are zero; members that this library does not
/// know must be zero.
template <typename Struct>
Struct read_struct(const Struct* given, const char* name) {
  static_assert(std::is_trivially_copyable_v<Struct>);
  const std::size_t size = required(given, name)->struct_size;
  if (size <= sizeof(std::size_t) || size > 64 * sizeof(Struct))
    throw InvalidArgument(std::string(name) + "->struct_size is " + std::to_string(size) + ", not sizeof(" + name +
                          ")");
  Struct known{};
  std::memcpy(&known, given, std::min(size, sizeof(Struct)));
  const auto* bytes = reinterpret_cast<const unsigned char*>(given);
  if (size > sizeof(Struct) &&
      std::any_of(bytes + sizeof(Struct), bytes + size, [](unsigned char b) { return b != 0; }))
    throw InvalidArgument(std::string(name) + " has members set that this version of the library does not know");
  return known;
}

/// Fills as many members as the caller's struct has.
template <typename Struct>
void write_struct(Struct value, Struct* out, const char* name) {
  static_assert(std::is_trivially_copyable_v<Struct>);
  const std::size_t size = required(out, name)->struct_size;
  if (size <= sizeof(std::size_t) || size > 64 * sizeof(Struct))
    throw InvalidArgument(std::string(name) + "->struct_size is " + std::to_string(size) + ", not sizeof *" + name);
  value.struct_size = size;
  std::memcpy(out, &value, std::min(size, sizeof(Struct)));
}

}  // namespace carreau::abi
