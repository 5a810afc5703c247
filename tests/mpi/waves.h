// SPDX-License-Identifier: BSD-3-Clause
// A host of many faces for the tests of many processes: z = sin(x) sin(y) / 2 over a square of cells, each a face which may bulge inside, and able
// to fail or to differ on purpose.
#pragma once

#include <atomic>
#include <cstdint>

#include "carreau.h"

namespace mpi_tests {

/// How the host of one process misbehaves.
enum class Fault {
  none,
  other_curves,   ///< its surface differs, borders of faces as well
  other_inside,   ///< its surface differs inside `face` alone
  status,         ///< `surface` fails, from the first call on
  status_inside,  ///< `surface` fails inside `face`
  stop,           ///< carreau_stop, inside `face`
  no_memory,      ///< large allocations fail, from a call inside `face` on
  dies            ///< the process is killed, inside `face`
};

struct Waves {
  int cells = 4;  ///< in each direction; with 1 there is one face
  double bulge = 0;  ///< height in the middle of each cell; nothing on its boundary
  Fault fault = Fault::none;
  std::int32_t face = 6;
  carreau_session* session = nullptr;
  std::atomic<std::int64_t> asked{0};  ///< times
};

/// Large allocations of the program and its libraries throw std::bad_alloc (short_memory.cpp).
extern std::atomic<bool> memory_is_short;

/// Gives geometry and model to the session; `waves` must outlive it.
carreau_status give(carreau_session* session, Waves& waves);

}  // namespace mpi_tests
