// SPDX-License-Identifier: BSD-3-Clause
#include "field.h"

#include <cmath>
#include <csignal>

namespace mpi_tests {

std::int32_t field_at(std::int64_t n, const double* xyz, double* values, void* user) {
  auto& field = *static_cast<Field*>(user);
  field.points += n;
  const bool wrong = ++field.calls >= field.from;
  if (wrong && (field.fault == Fault::status || field.fault == Fault::status_inside)) return 44;
  if (wrong && field.fault == Fault::stop) carreau_stop(field.session);
  if (wrong && field.fault == Fault::no_memory) memory_is_short = true;
  if (wrong && field.fault == Fault::dies) std::raise(SIGKILL);
  for (std::int64_t i = 0; i < n; ++i) {
    const double x = xyz[3 * i], y = xyz[3 * i + 1];
    values[i] = std::tanh(4 * (y - 1 - x * x / 4)) + (field.fault == Fault::other_inside ? 1e-9 : 0);
  }
  return 0;
}

}  // namespace mpi_tests
