// Any bytes are a solution or a FileError that names the file (binary form).
#include <cstdint>

#include "sol_fuzz_check.h"
#include "support/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  carreau::Solution solution;
  // The last byte, which no form needs, chooses what the values are read for.
  const auto use =
      size > 0 && data[size - 1] % 2 == 0 ? carreau::SolutionUse::field : carreau::SolutionUse::prescription;
  try {
    solution = carreau::read_solution_binary(content, "x.solb", use);
  } catch (const carreau::FileError& error) {
    FUZZ_CHECK(error.where().file == "x.solb");
    return 0;
  }
  carreau::check_written_and_read(solution);
  return 0;
}
