// What holds for every solution that was read: both forms give it back.
#pragma once

#include "fuzz_check.h"
#include "io/sol_files.h"

namespace carreau {

inline void check_written_and_read(const Solution& solution) {
  FUZZ_CHECK(solution.values.size() % solution.components() == 0);
  FUZZ_CHECK(read_solution_text(solution_text(solution), "again") == solution);
  FUZZ_CHECK(read_solution_binary(solution_bytes(solution), "again") == solution);
}

}  // namespace carreau
