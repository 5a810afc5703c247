// SPDX-License-Identifier: BSD-3-Clause
// Checks of every solution that was read: both forms restore it.
#pragma once

#include <cstdint>

#include "fuzz_check.h"
#include "io/medit/sol_files.h"
#include "support/error.h"

namespace carreau {

inline void check_written_and_read(const Solution& solution) {
  FUZZ_CHECK(solution.values.size() % solution.components() == 0);
  const auto use = solution.fields.empty() ? SolutionUse::field : SolutionUse::fields;
  FUZZ_CHECK(read_solution_text(solution_text(solution), "again", use) == solution);
  FUZZ_CHECK(read_solution_binary(solution_bytes(solution), "again", use) == solution);
}

/// Any bytes are a solution or a FileError that names the file. `read` is one of the two readers.
template <typename Read>
int fuzz_solution(const std::uint8_t* data, std::size_t size, Read&& read) {
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  // The last byte, which no form needs, chooses the use of the values.
  const auto use = static_cast<SolutionUse>(size > 0 ? data[size - 1] % 3 : 0);
  Solution solution;
  try {
    solution = read(content, "x.sol", use);
  } catch (const FileError& error) {
    FUZZ_CHECK(error.where().file == "x.sol");
    return 0;
  }
  check_written_and_read(solution);
  return 0;
}

}  // namespace carreau
