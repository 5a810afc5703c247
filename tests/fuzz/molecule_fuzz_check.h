// SPDX-License-Identifier: BSD-3-Clause
// Checks of every molecule that was read.
#pragma once

#include <cstdint>
#include <type_traits>
#include <unordered_set>

#include "fuzz_check.h"
#include "io/molecule/molecule_files.h"
#include "support/error.h"

namespace carreau {

/// Any bytes are atoms with finite centres, positive radii and different numbers, or a FileError that names the file and
/// a line.
template <typename Read>
int fuzz_molecule(const std::uint8_t* data, std::size_t size, Read&& read) {
  MoleculeFile file;
  try {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    if constexpr (std::is_invocable_v<Read, std::string_view, const char*>)
      file = read(text, "x");
    else
      file = read(text, "x", Radii{});
  } catch (const FileError& error) {
    FUZZ_CHECK(error.where().file == "x" && error.where().line > 0);
    return 0;
  }
  const molecule::Molecule& m = file.molecule;
  FUZZ_CHECK(!m.balls.empty());
  for (const molecule::Ball& ball : m.balls) FUZZ_CHECK(is_finite(ball.centre) && ball.radius > 0);
  for (const std::size_t n : {m.numbers.size(), m.names.size(), m.elements.size()})
    FUZZ_CHECK(n == 0 || n == m.balls.size());
  std::unordered_set<int> seen;
  for (const int number : m.numbers) FUZZ_CHECK(number > 0 && seen.insert(number).second);
  return 0;
}

}  // namespace carreau
