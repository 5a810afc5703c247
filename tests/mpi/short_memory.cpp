// SPDX-License-Identifier: BSD-3-Clause
// Replaces operator new, of libraries, too: they take the program's first.
#include <cstdlib>
#include <new>

#include "waves.h"

namespace mpi_tests {

std::atomic<bool> memory_is_short{false};

}  // namespace mpi_tests

void* operator new(std::size_t size) {
  constexpr std::size_t large = 4096;
  void* const memory = size >= large && mpi_tests::memory_is_short ? nullptr : std::malloc(size != 0 ? size : 1);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
