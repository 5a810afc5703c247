// SPDX-License-Identifier: BSD-3-Clause
#include "base/heap.h"

#if defined(__linux__)
#include <features.h>
#endif
#if defined(__GLIBC__)
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#endif

namespace command {

#if defined(__GLIBC__)
namespace {
constexpr int ahead = 128 << 20;  // addresses only, until they are used
}

void prepare_heap() {
  constexpr int large = 64 << 20;   // bytes: arrays from here on are mapped one by one, and given back at once
  constexpr std::uintptr_t page = std::uintptr_t{2} << 20;
  mallopt(M_MMAP_THRESHOLD, large);
  mallopt(M_TRIM_THRESHOLD, 8 * ahead - 1);
  mallopt(M_TOP_PAD, ahead);
  void* const first = std::malloc(2 * page);  // makes the heap grow
  if (first == nullptr) return;
  const std::uintptr_t from = (reinterpret_cast<std::uintptr_t>(first) + page - 1) & ~(page - 1);
  const std::uintptr_t to = reinterpret_cast<std::uintptr_t>(sbrk(0)) & ~(page - 1);
  if (from < to) madvise(reinterpret_cast<void*>(from), to - from, MADV_HUGEPAGE);
  std::free(first);
}

void give_back_heap() {
#if __GLIBC_PREREQ(2, 33)
  constexpr std::size_t much = std::size_t{128} << 20;  // bytes: less is soon in use again
  const struct mallinfo2 now = mallinfo2();
  // What lies ahead is free, but has not been used. Giving it back costs as much as a mesh of some hundred triangles.
  if (now.fordblks - std::min<std::size_t>(now.keepcost, ahead) >= much) malloc_trim(0);
#endif
}
#else
void prepare_heap() {}
void give_back_heap() {}
#endif

}  // namespace command
