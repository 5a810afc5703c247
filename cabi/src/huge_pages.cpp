// SPDX-License-Identifier: BSD-3-Clause
// Large arrays of the library request pages of 2 MiB where Linux gives them on request (transparent_hugepage/enabled is
// madvise). A new array costs a fault for each of its pages, and an old array a miss of the processor's table.
//
// The linker turns the calls of operator new in this library into calls of the function below (--wrap). Memory comes from
// the host's operator new and goes to its operator delete, as before.
#include <sys/mman.h>

#include <cstddef>
#include <cstdint>

namespace {

constexpr std::uintptr_t page = std::uintptr_t{1} << 21;

/// The whole large pages within an array. A kernel without large pages returns an error, and nothing is lost.
void advise(void* begin, std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  const auto from = (reinterpret_cast<std::uintptr_t>(begin) + page - 1) & ~(page - 1);
  const auto to = (reinterpret_cast<std::uintptr_t>(begin) + bytes) & ~(page - 1);
  if (from < to) madvise(reinterpret_cast<void*>(from), to - from, MADV_HUGEPAGE);
#else
  static_cast<void>(begin), static_cast<void>(bytes);
#endif
}

}  // namespace

extern "C" {

void* __real__Znwm(std::size_t bytes);

void* __wrap__Znwm(std::size_t bytes) {
  void* const memory = __real__Znwm(bytes);
  if (bytes >= page) advise(memory, bytes);
  return memory;
}
}
