// SPDX-License-Identifier: BSD-3-Clause
// A field for tests of adaptation, able to fail or to differ on purpose.
#pragma once

#include <cstdint>

#include "carreau.h"
#include "waves.h"

namespace mpi_tests {

/// A front over the waves. Misbehaves from the call `from` on, by Fault; other_inside: other values everywhere.
struct Field {
  Fault fault = Fault::none;
  int from = 3;  ///< the values on the first mesh take two or more
  carreau_session* session = nullptr;
  std::int64_t calls = 0, points = 0;
};

std::int32_t field_at(std::int64_t n, const double* xyz, double* values, void* user);

}  // namespace mpi_tests
